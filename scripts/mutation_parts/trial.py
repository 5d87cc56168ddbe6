# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A copy of the tree in which mutants are built and tested; the user's own is never touched."""

import hashlib
import os
import shutil
import signal
import subprocess
import time
import uuid
from pathlib import Path

from common.program import environment

# How many times as long as without a mutant the tests of a room may take, and more [s].
PATIENCE, MORE = 5.0, 120.0
# What building may take [s].
BUILD = 7200.0
# What a process may take of memory and write to a file, as a mutant may do so without end [bytes].
MEMORY, FILE = 8 * 2**30, 2 * 2**30
# The first case that fails ends a test.
ENVIRONMENT = {"GTEST_FAIL_FAST": "1"}


def end_all(mark):
    """Kills what a test has started and left, by the mark in its environment."""
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (process / "environ").read_bytes():
                os.kill(int(process.name), signal.SIGKILL)
        except OSError:  # another user's, or gone
            pass


class Trial:
    """The copy of the files of @p root in @p tree, with its own build directory."""

    def __init__(self, root, tree, jobs):
        self.root = root
        self.tree = tree
        self.jobs = jobs
        self.log = tree / "build" / "mutate.log"

    def update(self):
        """Takes over what is new; what is equal keeps its time, so that it is not built again."""
        found = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=self.root, capture_output=True, text=True, check=True,
        ).stdout  # fmt: skip
        listed = {name for name in found.split("\0") if (self.root / name).is_file()}
        for name in sorted(listed):
            here, there = self.root / name, self.tree / name
            if there.is_file() and here.read_bytes() == there.read_bytes():
                continue
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(here, there)
            shutil.copymode(here, there)
        for folder in ("source", "include", "tests"):
            for file in (self.tree / folder).rglob("*"):
                if file.is_file() and str(file.relative_to(self.tree)) not in listed:
                    file.unlink()
        self.log.parent.mkdir(exist_ok=True)
        if not (self.tree / "build" / "build.ninja").exists():
            if self.run(["cmake", "--preset", "release", "-DGRAUPEL_JOINED=OFF"], BUILD) != 0:
                raise RuntimeError(f"it cannot be configured: {self.log}")

    def run(self, command, limit):
        """The exit status of a command; None if it has not ended in time. What it says is
        in the log."""
        mark = f"GRAUPEL_MUTANT={uuid.uuid4()}"
        name, value = mark.split("=")
        with open(self.log, "w", encoding="utf-8") as log:
            process = subprocess.Popen(
                ["prlimit", f"--as={MEMORY}", f"--fsize={FILE}", *command], cwd=self.tree,
                stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                env=environment() | {name: value} | ENVIRONMENT,
            )  # fmt: skip
            try:
                return process.wait(timeout=limit)
            except subprocess.TimeoutExpired:
                return None
            finally:
                end_all(mark)
                process.wait()

    def build(self, targets):
        """Whether the targets can be built."""
        return self.run(["ninja", "-C", "build", "-j", str(self.jobs), *targets], BUILD) == 0

    def programs(self, targets):
        """What the programs of the targets are, byte by byte."""
        sums = []
        for target in targets:
            for file in (self.tree / "build" / target, self.tree / "build" / "tests" / target):
                if file.is_file():
                    sums.append(hashlib.sha256(file.read_bytes()).hexdigest())
        return sums

    def first_failure(self, tests, limits):
        """The first of the tests that fails, or hangs: name and words; None if none does.
        Without limits, one hour."""
        for test in tests:
            command = ["ctest", "--test-dir", "build", "--no-tests=error", "-R", f"^{test}$",
                       "--output-on-failure"]  # fmt: skip
            status = self.run(command, limits.get(test, 3600.0))
            if status is None:
                return test, "hangs"
            if status != 0:
                return test, "fails"
        return None

    def times(self, tests):
        """How long each test may take [s]: measured on the tree as it is, where all must pass."""
        limits = {}
        for test in tests:
            begin = time.monotonic()
            if failure := self.first_failure([test], {}):
                raise RuntimeError(f"without a mutant {failure[0]} {failure[1]}: {self.log}")
            limits[test] = PATIENCE * (time.monotonic() - begin) + MORE
        return limits
