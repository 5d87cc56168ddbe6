# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Several runs in one directory, by name."""

import math
from pathlib import Path

from graupel.run import read_run
from graupel.study import read_study


class Runs:
    """Runs by name, read when asked for."""

    def __init__(self, directory, maker):
        """@p maker is the command that a message names where a run is missing."""
        self.directory = Path(directory)
        self.maker = maker
        self.read = {}

    def has(self, name):
        """Whether this run has ended."""
        return (self.directory / name / "summary.json").exists()

    def __getitem__(self, name):
        if name not in self.read:
            if not self.has(name):
                raise FileNotFoundError(
                    f"{self.directory / name}: not there; {self.maker} makes it"
                )
            self.read[name] = read_run(self.directory / name)
        return self.read[name]

    def study(self, name):
        """The rows of a study.csv, numbers as floats or None."""
        return read_study(self.directory / name / "study.csv")


def case_at(run, velocity):
    """The case of @p run at this superficial velocity [m/s]."""
    for case in run.cases:
        if math.isclose(case["superficial_velocity"], velocity, rel_tol=1e-6):
            return case
    raise KeyError(f"{run.directory}: no case at {velocity} m/s")
