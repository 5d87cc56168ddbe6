# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A case of the validation: its runs, and what is compared.

A folder prm/validation/NAME holds the parameter files, measured.csv where something was
measured, and case.py with

    TITLE, SOURCE         what it is, and where the expected values are from
    runs(quick)           the list of its Runs; shortened ones if quick
    evaluate(results)     the list of its Comparisons, from the runs (kept.RunsWithKept),
                          each with the name of its run
    figure(results)       its picture
    KEPT                  optional: files of a run that the page keeps; the case evaluates and
                          draws all runs of which they are kept

A case whose runs are not all there is evaluated from those that are; what the page has of
the others stays.
"""

import csv
import importlib.util
from dataclasses import dataclass, field
from pathlib import Path

from graupel.run import as_number

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "prm" / "validation"


@dataclass
class Run:
    """A run of the program."""

    name: str  # of its directory of results
    file: str  # parameter file, in the folder of the case
    values: dict = field(default_factory=dict)  # overridden parameters
    is_long: bool = False  # more than some minutes: only when asked for by --long
    ranks: int = None  # where the case is about them; else as many as the program is given


@dataclass
class Comparison:
    """A number of ours beside the one expected."""

    quantity: str
    unit: str
    expected: float
    ours: float
    error: float = None  # of ours, one standard deviation; None if there is none to speak of
    limit: float = None  # on the distance of both; None if it is only shown
    relative: bool = True  # the limit is a part of the expected value
    decimals: int = 3  # -1: two digits, however small
    run: str = ""  # that it is of

    @property
    def deviation(self):
        """Ours less the expected value, relative if the limit is."""
        difference = self.ours - self.expected
        return difference / abs(self.expected) if self.relative else difference

    @property
    def is_met(self):
        """Whether it is within the limit; None without one. False for a NaN."""
        return None if self.limit is None else bool(abs(self.deviation) <= self.limit)


def names():
    """The cases there are."""
    return sorted(file.parent.name for file in FOLDER.glob("*/case.py"))


def load(name):
    """The module of a case; throws KeyError with those there are."""
    file = FOLDER / name / "case.py"
    if not file.exists():
        raise KeyError(f"no case {name}; there are {', '.join(names())}")
    spec = importlib.util.spec_from_file_location(f"validation_{name.replace('-', '_')}", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def measured(name, file="measured.csv"):
    """The rows of a case's table of measurements, cells as numbers where they are."""
    with open(FOLDER / name / file, newline="", encoding="utf-8") as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        return [
            {key: cell if as_number(cell) is None else as_number(cell) for key, cell in row.items()}
            for row in rows
        ]
