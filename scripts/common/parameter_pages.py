# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The parameter reference, one page a section, from what the program says of its parameters."""

import re

HEADER = """# Parameter reference

Made from what `build/graupel --print-parameters` prints. A parameter is named
`Section/name`, as `--set "Section/name=value"` takes it; in a parameter file it stands in its
section:

```
subsection Section
  set name = value
end
```

All values are in SI units. A relative path is relative to the parameter file.

```{{toctree}}
:maxdepth: 1

{pages}
```
"""


def label_of(path):
    """The target of a parameter's link."""
    return "parameter-" + re.sub(r"[^a-z0-9]+", "-", path.lower()).strip("-")


def file_name(section):
    """The page of a section, without its ending."""
    return section.split("/")[0].lower().replace(" ", "-")


def escaped(text):
    """Text that Markdown must leave as it is."""
    return re.sub(r"([\\`*_{}\[\]<>#|$])", r"\\\1", text)


# "ergun: what it is", at the beginning or after a sentence.
CHOICE = re.compile(
    r"(?:^|(?<=[.;] ))([a-z][\w-]*(?: [a-z][\w-]*){0,2}(?: [A-Z](?:; [A-Z])*)?|[A-Z]): "
)


def with_choices(sentence):
    """A sentence whose choices, two or more, become a list."""
    before, *parts = CHOICE.split(sentence)
    if len(parts) < 4:
        return escaped(sentence)
    lines = [escaped(before.strip()), ""] if before.strip() else []
    for name, text in zip(parts[::2], parts[1::2]):
        lines.append(f"- `{name}`: {escaped(text.strip().rstrip('.;'))}")
    return "\n".join(lines)


def signature(section, entries):
    """What of a section tells whether another one is the same."""
    return [(entry.name, entry.default, entry.meaning) for entry in entries[section]]


def text_of(parameter, level):
    """A parameter's own lines, below a heading of this level."""
    facts = [f"Default: `{parameter.default}`" if parameter.default else "Default: empty"]
    if parameter.unit:
        facts.append(f"unit: {escaped(parameter.unit)}")
    lines = (
        f"({label_of(parameter.path)})=",
        f"{'#' * level} {parameter.name}",
        f"`{parameter.path}`",
        with_choices(parameter.sentence),
        "; ".join(facts) + ".",
    )
    return "\n\n".join(lines).replace(")=\n\n", ")=\n") + "\n"


def pages(parameters):
    """The text of each page by its file name; sections that repeat another one are named only."""
    entries = {}
    for parameter in parameters:
        entries.setdefault(parameter.section, []).append(parameter)
    result, shown = {}, {}
    for section, own in entries.items():
        name = file_name(re.sub(r" \d+$", "", section))
        page = result.setdefault(name, [f"# {section.split('/')[0]}\n"])
        first = shown.setdefault(str(signature(section, entries)), section)
        if "/" in section or first != section:
            page.append(f"## {section}\n")
        if first != section:
            page.append(f"As {first}.\n")
            continue
        level = 3 if "/" in section else 2
        page += [text_of(parameter, level) for parameter in own]
    texts = {name: "\n".join(page) for name, page in result.items()}
    texts["index"] = HEADER.format(pages="\n".join(result))
    return texts
