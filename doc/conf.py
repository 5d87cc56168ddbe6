# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""How Sphinx makes the pages: scripts/doc calls it."""

import sys
from pathlib import Path

from docutils import nodes
from sphinx import addnodes

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))

from common import parameter_pages  # noqa: E402
from common.parameters import parameters_of  # noqa: E402

project = "Graupel"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
exclude_patterns = []
highlight_language = "none"
html_theme = "furo"
html_title = "Graupel"
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False

# KaTeX in the place of MathJax, from Debian's package: pages read without a network.
html_static_path = ["/usr/share/javascript/katex", "pages.css"]
html_css_files = ["katex.min.css", "pages.css"]
html_js_files = ["katex.min.js"]
mathjax_path = "contrib/auto-render.js"
mathjax_options = {"defer": "defer", "onload": "renderMathInElement(document.body)"}

GENERATED = ROOT / "doc" / "generated"
HEADERS = """# Public headers

What each class and function is and promises, made by Doxygen from the comments of
`include/graupel/`:

<p><a href="../headers/index.html">Open the pages of the headers</a></p>
"""


def write_if_new(file, text):
    """Leaves a file alone that has this text already, so that its page is not made anew."""
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def make_pages(app):
    """The pages that the program and the headers make; takes away those of older programs."""
    parameters = parameters_of(ROOT / "build" / "graupel")
    app.parameter_labels = {
        parameter.path: parameter_pages.label_of(parameter.path) for parameter in parameters
    }
    texts = {GENERATED / "headers.md": HEADERS}
    for name, text in parameter_pages.pages(parameters).items():
        texts[GENERATED / "parameters" / f"{name}.md"] = text
    for file in set(GENERATED.rglob("*.md")) - set(texts):
        file.unlink()
    for file, text in texts.items():
        write_if_new(file, text)


def link_parameters(app, doctree):
    """Makes a link of each `Section/name` that is a parameter, also with "=value" behind it."""
    if app.env.docname.startswith("generated/"):
        return
    for literal in list(doctree.findall(nodes.literal)):
        path = literal.astext().split("=")[0].strip()
        label = app.parameter_labels.get(path)
        if label is None or isinstance(literal.parent, (nodes.reference, nodes.title)):
            continue
        link = addnodes.pending_xref(
            "", refdomain="std", reftype="ref", reftarget=label, refexplicit=True,
            refdoc=app.env.docname, refwarn=False,
        )  # fmt: skip
        literal.parent.replace(literal, link)
        link += literal


def setup(app):
    """Called by Sphinx."""
    app.connect("builder-inited", make_pages)
    app.connect("doctree-read", link_parameters)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
