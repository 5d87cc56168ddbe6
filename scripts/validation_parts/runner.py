# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Runs the program for a case, and checks its files."""

import subprocess
import time

from common.program import environment

from .case import FOLDER, ROOT


class Runner:
    """Runs go below @p results; with the binary @p program, or else by scripts/run, which
    builds it first and runs on all cores."""

    def __init__(self, results, program=None):
        self.results = results
        self.program = program

    def directory(self, case, run):
        """Where the results of a run go."""
        return self.results / case / run.name

    def has(self, case, run):
        """Whether it has ended."""
        return (self.directory(case, run) / "summary.json").exists()

    def command(self, case, run, *more):
        """The command line of a run."""
        program = [str(self.program or ROOT / "scripts" / "run")]
        if run.ranks and self.program:
            program = ["mpirun", "--oversubscribe", "-np", str(run.ranks), *program]
        command = [*program, str(FOLDER / case / run.file)]
        for name, value in run.values.items():
            command += ["--set", f"{name}={value}"]
        return command + list(more)

    def check(self, case, run):
        """What --check says against a run; empty if nothing."""
        done = subprocess.run(
            self.command(case, run, "--check"), env=environment(), capture_output=True, text=True,
            check=False,
        )
        return "" if done.returncode == 0 else (done.stdout + done.stderr).strip()

    def do(self, case, run):
        """Runs it, unless it has been, or goes on with it; returns whether its results are
        there."""
        if self.has(case, run):
            print(f"== {case}/{run.name}: done before", flush=True)
            return True
        print(f"== {case}/{run.name}", flush=True)
        directory = self.directory(case, run)
        directory.parent.mkdir(parents=True, exist_ok=True)
        begin = time.monotonic()
        more = ["--output", str(directory), "--set", "Output/report=false"]
        if any(directory.glob("checkpoint*")):
            more.append("--resume")
        told = {"GRAUPEL_RANKS": str(run.ranks)} if run.ranks else {}
        status = subprocess.run(
            self.command(case, run, *more), env={**environment(), **told}, check=False
        ).returncode
        took = f"{time.monotonic() - begin:.0f} s"
        if status:
            print(f"== {case}/{run.name} has failed with status {status} after {took}", flush=True)
        else:
            print(f"== {case}/{run.name}: {took}", flush=True)
        return status == 0
