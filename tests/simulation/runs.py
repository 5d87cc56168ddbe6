# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Runs of the program from outside, for the tests that are called with its path."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

# For the reader of ParaView's files and for the project's own tables.
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))

from common.program import environment  # noqa: E402
from graupel import Run as Output  # noqa: E402


class Program:
    """The binary under test; set once by the test's main()."""

    path = None


def command(*arguments, ranks=1):
    """The words that call graupel with these arguments."""
    words = [Program.path, *map(str, arguments)]
    return words if ranks == 1 else ["mpirun", "--oversubscribe", "-np", str(ranks)] + words


def call(*arguments, ranks=1, cwd=None, timeout=600):
    """The finished process of graupel with these arguments."""
    return subprocess.run(
        command(*arguments, ranks=ranks),
        env=environment(), capture_output=True, text=True, timeout=timeout, cwd=cwd,
    )  # fmt: skip


def overrides(values):
    """A dictionary of parameters as options of the command line."""
    return [part for name, value in values.items() for part in ("--set", f"{name}={value}")]


def value_of(text):
    """A cell of a table as a number, a flag or a word; None if it is empty."""
    if text in ("", "nan", "true", "false"):
        return {"": None, "nan": None, "true": True, "false": False}[text]
    try:
        return float(text)
    except ValueError:
        return text


def rows_of(file):
    """The rows of a CSV file, each a dictionary."""
    with open(file, newline="", encoding="utf-8") as stream:
        return [{k: value_of(v) for k, v in row.items()} for row in csv.DictReader(stream)]


class Run:
    """What one call left: its exit status, what it said, and its output directory."""

    def __init__(self, process, directory):
        self.status = process.returncode
        self.said = process.stdout + process.stderr
        self.refusal = process.stderr
        self.directory = directory

    def __str__(self):
        return f"status {self.status}: {self.said[-2000:]}"

    def rows(self, name):
        """The rows of one of its tables."""
        return rows_of(self.directory / name)

    def particles(self, number):
        """What the set @p number of its files of particles holds."""
        return Output(self.directory).particles(number)

    @property
    def summary(self):
        """summary.json."""
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    @property
    def bed(self):
        """The bed before the flow."""
        return self.summary["bed"]

    @property
    def case(self):
        """The last flow case."""
        return self.summary["cases"][-1]

    def middle_of_solids(self, name="bed-axial.csv"):
        """Mean height of the solids [m], from a profile along the axis."""
        rows = self.rows(name)
        solid = [1.0 - row["void_fraction"] for row in rows]
        return sum(s * row["z"] for s, row in zip(solid, rows)) / sum(solid)


class RunTest(unittest.TestCase):
    """Each test runs the program in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.runs = 0

    def run_file(self, file, values=None, *more, output=None, ranks=1, timeout=300):
        """The run of a parameter file with the overridden @p values; in a directory of its
        own unless one is named."""
        self.runs += 1
        output = output or f"o{self.runs}"
        process = call(
            file, *overrides(values or {}), "--output", output, *more,
            ranks=ranks, cwd=self.path, timeout=timeout,
        )  # fmt: skip
        return Run(process, self.path / output)

    def assert_close(self, value, right, relative, message=None):
        """Both are numbers that differ by at most the relative tolerance."""
        self.assert_within(value, right, relative * abs(right), message)

    def assert_within(self, value, right, absolute, message=None):
        """The same with an absolute tolerance."""
        self.assertIsNotNone(value, message)
        self.assertIsNotNone(right, message)
        # Written so that a NaN fails.
        self.assertTrue(abs(value - right) <= absolute, f"{message}: {value}, not {right}")

    def assert_balanced(self, run):
        """The ledger of mass holds to the tolerance that the design promises."""
        self.assertLessEqual(run.summary["ledger"]["max_mass_imbalance"], 1e-8)


def main():
    """Runs the tests of the script that is called with the path of the binary."""
    Program.path = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(module="__main__")
