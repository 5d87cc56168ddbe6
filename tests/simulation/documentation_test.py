# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Whether the documentation says what is: its commands can run, its files, parameters, functions
and pages exist, its patches apply. Called with the path of the binary.
"""

import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path

from runs import ROOT, Program, call, main

from common.parameters import parameters_of, read_parameters

DOC = ROOT / "doc"
MADE = ("generated",)  # what Sphinx makes
PAGES = sorted(
    file
    for file in [*ROOT.glob("*.md"), *DOC.rglob("*.md")]
    if not set(MADE) & set(file.relative_to(ROOT).parts)
)
FENCE = re.compile(r"^```(\S*)\n(.*?)^```", re.M | re.S)
INDENTED = re.compile(r"(?:^    \S.*\n)+", re.M)
CODE = re.compile(r"(?<!`)`([^`]+)`(?!`)", re.S)
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]*(?:\([^)]*\)[^)\s]*)*)\)")
FOLDERS = ("prm", "scripts", "tests", "doc", "benchmarks", "include", "source")
PATH = re.compile(rf"(?<![\w/.-])(?:{'|'.join(FOLDERS)})/[\w./-]*[\w/]")
CASE = re.compile(r"(?<![\w/.{-])[\w/-]+\.prm\b")
# Parameter files that the reader is to write.
UNWRITTEN = {"FILE.prm", "NAME.prm", "tests/cases/NAME.prm", "ts.prm", "parameters.prm"}
# Where a package has the examples.
PACKAGED = "/usr/share/graupel/"
# Targets of the build that a command may name.
BUILT = re.compile(r"build/(?:graupel|tests/test_\w+|benchmarks/benchmark_\w+)\b")
SET = re.compile(r'--set (?:"([^"]*)"|(\S+))')
STARTS_FROM = re.compile(r"Filling/start from=(\S+)")


def text_of(page):
    return page.read_text(encoding="utf-8")


def prose(page):
    """A page without its blocks."""
    return INDENTED.sub("", FENCE.sub("", text_of(page)))


def commands(page):
    """The lines of shell of a page, each joined with its continuation."""
    text = text_of(page)
    blocks = [block for kind, block in FENCE.findall(text) if kind in ("sh", "bash")]
    blocks += INDENTED.findall(FENCE.sub("", text))
    lines = "\n".join(blocks).replace("\\\n", " ").splitlines()
    return [line.split("  #")[0].strip() for line in lines]


def run_of(command):
    """The arguments of graupel in a command that runs a parameter file, else None."""
    words = shlex.split(command)
    for number, word in enumerate(words):
        if word in ("build/graupel", "scripts/run"):
            arguments = words[number + 1 :]
            return arguments if arguments and arguments[0].endswith(".prm") else None
    return None


def anchors(page):
    """What a link may name on a page, as GitHub does."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", text_of(page)), re.M)
    words = (re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings)
    return set(words)


@lru_cache
def parameters():
    return {parameter.path for parameter in parameters_of(Program.path)}


class Commands(unittest.TestCase):
    """Each line of shell that runs a case."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name in ("prm", "tests"):
            (self.folder / name).symlink_to(ROOT / name)

    def make_bed(self, output, runs):
        """The settled bed that one of the runs leaves in its directory of results."""
        for arguments in runs:
            by_file = output == f"output-{Path(arguments[0]).stem}" and "--output" not in arguments
            if (by_file or output in arguments) and "--resume" not in arguments:
                made = call(*arguments, "--set", "Flow/superficial velocities=",
                            "--set", "Output/report=false", cwd=self.folder)  # fmt: skip
                self.assertEqual(made.returncode, 0, made.stderr)
                return
        self.fail(f"no command makes {output}")

    def test_they_are_free_of_contradictions(self):
        runs = {}
        for page in PAGES:
            for command in commands(page):
                # Placeholders are for the reader.
                if (arguments := run_of(command)) and "FILE.prm" not in command:
                    runs.setdefault(tuple(arguments), page)
        self.assertGreater(len(runs), 20)
        beds = {bed for run in runs for word in run for bed in STARTS_FROM.findall(word)}
        for bed in beds:
            self.make_bed(bed, runs)

        def check(arguments):
            return arguments, call(*arguments, "--check", cwd=self.folder)

        with ThreadPoolExecutor(2) as pool:
            for arguments, checked in pool.map(check, runs):
                with self.subTest(page=runs[arguments].name, run=" ".join(arguments)):
                    self.assertEqual(checked.returncode, 0, checked.stderr)
                    self.assertIn("No contradictions", checked.stdout)


class Names(unittest.TestCase):
    """What the text calls by name."""

    def test_files_exist(self):
        named = 0
        for page in PAGES:
            for path in PATH.findall(text_of(page)):
                # A pattern or a link relative to the page; those are looked at elsewhere.
                if "..." in path or "NAME" in path or "<" in path:
                    continue
                named += 1
                with self.subTest(page=page.name, path=path):
                    # The ending may be missing.
                    self.assertTrue((ROOT / path).exists() or list(ROOT.glob(path + ".*")))
        self.assertGreater(named, 100)

    def test_parameter_files_exist(self):
        folders = [ROOT / name for name in ("prm", "tests", "benchmarks")]
        there = [str(file) for folder in folders for file in folder.rglob("*.prm")]
        for page in PAGES:
            for name in set(CASE.findall(text_of(page))) - UNWRITTEN:
                name = name.removeprefix(PACKAGED)
                with self.subTest(page=page.name, file=name):
                    self.assertTrue(any(file.endswith(f"/{name}") for file in there))

    def test_programs_are_targets(self):
        targets = " ".join(
            text_of(file) for file in (ROOT / "tests/CMakeLists.txt", ROOT / "CMakeLists.txt",
                                       ROOT / "benchmarks/CMakeLists.txt")
        )  # fmt: skip
        for page in PAGES:
            for name in set(BUILT.findall(text_of(page))):
                room = name.split("_", 1)[-1] if "_" in name else name.split("/")[-1]
                with self.subTest(page=page.name, program=name):
                    self.assertIn(room, targets)

    def test_parameters_exist(self):
        sections = {path.rsplit("/", 1)[0] for path in parameters()}
        named = 0
        for page in PAGES:
            if page.name == "CHANGELOG.md":
                continue  # speaks of what has been
            for code in CODE.findall(text_of(page)):
                code = " ".join(code.split())
                words = ["".join(pair) for pair in SET.findall(code)]
                for word in words or [code]:
                    path = re.split(r"\s*=", word)[0].strip()
                    section, _, name = path.rpartition("/")
                    if section not in sections or not name:
                        continue
                    named += 1
                    with self.subTest(page=page.name, parameter=path):
                        self.assertIn(path, parameters())
        self.assertGreater(named, 100)

    def test_parameters_of_lines_that_set_them_exist(self):
        names = {path.rsplit("/", 1)[1] for path in parameters()}
        for page in PAGES:
            for name in re.findall(r"^ *set ([^=\n]+?) *=", text_of(page), re.M):
                with self.subTest(page=page.name, name=name):
                    self.assertIn(name, names | {"name"})

    def test_functions_exist(self):
        headers = "".join(map(text_of, (ROOT / "include/graupel").rglob("*.h")))
        pages = [DOC / name for name in ("theory.md", "design.md", "extending.md", "tour.md")]
        named = 0
        for page in pages:
            for code in CODE.findall(prose(page)):
                if re.fullmatch(r"[A-Z]\w+(::\w+)?(\(\))?|\w+\(\)|\w+::\w+(\(\))?", code):
                    for name in code.removesuffix("()").split("::"):
                        named += 1
                        with self.subTest(page=page.name, name=code):
                            self.assertRegex(headers, rf"\b{name}\b")
        self.assertGreater(named, 50)

    def test_a_misspelt_parameter_is_seen(self):
        entry = {"value": "1", "default_value": "1", "documentation": "What it is [m]."}
        read = read_parameters({"A": {"b c": entry}})
        self.assertEqual([(one.path, one.unit, one.default) for one in read], [("A/b c", "m", "1")])


class Links(unittest.TestCase):
    """From page to page."""

    def test_they_lead_somewhere(self):
        followed = 0
        for page in PAGES:
            for target in LINK.findall(FENCE.sub("", text_of(page))):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, anchor = target.partition("#")
                place = (page.parent / path).resolve() if path else page
                followed += 1
                with self.subTest(page=page.name, link=target):
                    self.assertTrue(place.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(place))
        self.assertGreater(followed, 50)

    def test_every_page_is_in_a_contents(self):
        listed = set()
        for page in PAGES:
            for kind, block in FENCE.findall(text_of(page)):
                if kind == "{toctree}":
                    lines = [line for line in block.splitlines() if line and line[0] != ":"]
                    listed |= {(page.parent / f"{line}.md").resolve() for line in lines}
        for page in DOC.rglob("*.md"):
            if not set(MADE) & set(page.relative_to(DOC).parts) and page.name != "index.md":
                with self.subTest(page=page.name):
                    self.assertIn(page.resolve(), listed)


class Licence(unittest.TestCase):
    """Each file of code says under which licence it is."""

    SUFFIXES = (".h", ".cc", ".py", ".js", ".css", ".cmake", ".in")

    def is_code(self, file):
        if file.suffix in self.SUFFIXES or file.name == "CMakeLists.txt":
            return True
        with file.open("rb") as stream:
            return stream.read(2) == b"#!"

    def test_each_file_names_it(self):
        folders = ("benchmarks", "cmake", "doc", "include", "prm", "python", "scripts", "source", "tests")
        files = [file for folder in folders for file in (ROOT / folder).rglob("*")]
        looked = 0
        for file in [ROOT / "CMakeLists.txt", *files]:
            if "__pycache__" in file.parts or not file.is_file() or not self.is_code(file):
                continue
            looked += 1
            top = file.read_text(encoding="utf-8").splitlines()[:3]
            with self.subTest(file=file.relative_to(ROOT)):
                self.assertIn("SPDX-License-Identifier: LGPL-2.1-or-later", " ".join(top))
                self.assertRegex(" ".join(top), r"Copyright \(C\) 20\d\d ")
        self.assertGreater(looked, 450)


class Patches(unittest.TestCase):
    """The worked examples of doc/extending.md."""

    def test_they_apply(self):
        blocks = FENCE.findall(text_of(DOC / "extending.md"))
        patches = [block for kind, block in blocks if kind == "diff"]
        self.assertEqual(len(patches), 5)
        if not shutil.which("git"):
            self.fail("this needs git")
        for patch in patches:
            with self.subTest(patch=patch.splitlines()[0]):
                done = subprocess.run(["git", "apply", "--check", "-"], input=patch, text=True,
                                      cwd=ROOT, capture_output=True)  # fmt: skip
                self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    main()
