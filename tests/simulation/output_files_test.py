# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Whether doc/output-files.md and what runs write are the same, in both directions: files, columns,
fields, keys and figures. Called with the path of the binary.
"""

import csv
import json
import re
from functools import lru_cache
from xml.etree import ElementTree

from runs import ROOT, RunTest, main

PAGE = ROOT / "doc" / "output-files.md"
SHORT = ROOT / "tests" / "cases" / "shallow.prm"
STUDY = ROOT / "prm" / "studies" / "manufactured-solution.prm"
# Of everything something; 64 steps of a window make a spectrum.
EVERYTHING = {
    "Filling/count": 60,
    "Flow/superficial velocities": 0.3,
    "Flow/mode": "transient",
    "Flow/stop when": "flow-throughs",
    "Flow/duration": 0.066,
    "Flow/time step": 1e-3,
    "Flow/ramp time": 0,
    "Output/mid-plane points": 5,
    "Output/probes": "low: 0 0 0.002",
    "Averages/to": 0.066,
    "Averages/lines": "low: -0.01 0 0.002 0.01 0 0.002 2 0.002 0.002",
    "Averages/planes": "mid: -0.01 0 0 0.01 0 0 -0.01 0 0.02 2 2 0.002",
}
# What a study writes.
OF_STUDIES = {"study.csv", "level-N/"}
# Figures that need a wall that moves, or particles that come or go.
FIGURES_ELSEWHERE = {"particle-number.png"}
CODE = re.compile(r"`([^`]+)`")


@lru_cache
def sections():
    """The text below each heading of the second level, by each name in the heading."""
    parts = re.split(r"^## (.*)$", PAGE.read_text(encoding="utf-8"), flags=re.M)
    result = {"": parts[0]}
    for heading, text in zip(parts[1::2], parts[2::2]):
        for name in heading.split(", "):
            result[name] = text
    return result


def first_cells(text):
    """The names in the first column of all tables of a text."""
    rows = re.findall(r"^\| (`[^|]*) \|", text, re.M)
    return [name for cell in rows for name in CODE.findall(cell)]


def pattern(name):
    """A documented name as a regular expression."""
    return re.sub(r"NN|N$", r"\\d+", re.escape(name.rstrip("/")).replace("NAME", r"\w+"))


def general(name):
    """The name of a file with NN in the place of its number."""
    return re.sub(r"-\d+\.csv$", "-NN.csv", name)


class Documented(RunTest):
    """Each against the page."""

    def same(self, what, documented, written):
        """Every name on one side has one on the other."""
        self.assertTrue(written, f"{what}: nothing is written")
        for name in written:
            fitting = [one for one in documented if re.fullmatch(pattern(one), name)]
            self.assertTrue(fitting, f"{what}: {name} is written and not documented")
        for one in documented:
            fitting = [name for name in written if re.fullmatch(pattern(one), name)]
            self.assertTrue(fitting, f"{what}: {one} is documented and not written")

    def columns_of(self, file):
        with open(file, newline="", encoding="utf-8") as stream:
            return next(csv.reader(stream))

    def fields_of(self, directory, stem):
        """Names of the data at the points of the last file for ParaView."""
        text = sorted((directory / "vtu").glob(f"{stem}_*.vtu"))[-1].read_text(encoding="ascii")
        root = ElementTree.fromstring(re.sub(r"<!--.*?-->", "", text, flags=re.S).strip())
        return {array.get("Name") for array in root.findall(".//PointData/DataArray")}

    def keys_of(self, value, path=()):
        """Paths of the values in summary.json, the cases as one."""
        if isinstance(value, dict):
            parts = (self.keys_of(part, (*path, name)) for name, part in value.items())
            return [key for keys in parts for key in keys]
        return [".".join(path)]

    def documented_keys(self):
        """Of summary.json; a name that begins with a dot has the parent of the one before."""
        result = []
        for name in first_cells(sections()["summary.json"]):
            parent = result[-1].rsplit(".", 1)[0] if result else ""
            result.append(parent + name if name.startswith(".") else name)
        result.remove("cost.seconds_in.*")
        row = re.search(r"^\| `cost\.seconds_in\.\*` .*$", sections()["summary.json"], re.M).group()
        return result + [f"cost.seconds_in.{name}" for name in CODE.findall(row)[1:]]

    def test_a_run(self):
        run = self.run_file(SHORT, EVERYTHING)
        self.assertEqual(run.status, 0, run)

        files = [name for name in first_cells(sections()[""]) if name not in OF_STUDIES]
        files = [name.rstrip("/") for name in files if not name.isdigit()]
        written = [entry.name for entry in run.directory.iterdir() if entry.name != "vtu"]
        self.same("files", files, written)

        tables = sorted(run.directory.glob("*.csv"))
        for file in tables:
            with self.subTest(file=file.name):
                name = general(file.name).replace("averages-midplane", "midplane")
                self.same(file.name, first_cells(sections()[name]), self.columns_of(file))
        for name in sections():
            if name.endswith(".csv") and name != "study.csv":
                self.assertIn(name, {general(file.name) for file in tables})

        for file in run.directory.glob("*.pvd"):
            with self.subTest(file=file.name):
                self.same(file.name, first_cells(sections()[file.name]),
                          self.fields_of(run.directory, file.stem))  # fmt: skip

        summary = run.summary
        self.same("summary.json", self.documented_keys(), self.keys_of(summary))
        for case in summary["cases"]:
            self.same("cases", first_cells(sections()["cases.csv"]), list(case))

        figures = set(first_cells(sections()["report.html"])) - FIGURES_ELSEWHERE
        self.same("figures", figures, [file.name for file in (run.directory / "figures").iterdir()])

    def test_a_study(self):
        values = {"Refinement study/values": "0.3333, 0.1667", "Output/report": "false"}
        run = self.run_file(STUDY, values)
        self.assertEqual(run.status, 0, run)
        self.same("study.csv", first_cells(sections()["study.csv"]),
                  self.columns_of(run.directory / "study.csv"))  # fmt: skip
        written = {entry.name for entry in run.directory.iterdir()} - {"vtu"}
        for name in OF_STUDIES:
            self.assertTrue([one for one in written if re.fullmatch(pattern(name), one)], name)


if __name__ == "__main__":
    main()
