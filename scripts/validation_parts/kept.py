# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The runs of a case, and those files of theirs that the page keeps.

What compares runs with each other needs more of a run than its rows on the page, and runs of hours
are seldom all on one machine: such a case names these files in KEPT.
"""

import shutil

from common.runs import Runs


class RunsWithKept(Runs):
    """Runs in @p directory, by name; what is kept of them in the folder @p kept."""

    def __init__(self, directory, maker, kept):
        super().__init__(directory, maker)
        self.kept = kept

    def keep(self, names, files):
        """Copies these files of the runs that have ended."""
        for name in filter(self.has, names):
            for file in files:
                there = self.kept / name / file
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(self.directory / name / file, there)

    def keeps(self, name):
        """Whether there are files of this run."""
        return (self.kept / name).is_dir()

    def kept_file(self, name, file):
        """The path of a file that is kept of a run."""
        return self.kept / name / file
