# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Runs of the program that end before their time, for the tests of how they go on."""

import contextlib
import os
import shutil
import signal
import subprocess
import time

from runs import ROOT, RunTest, command, overrides

from common.program import STOPPED, environment, processes_in

CASES = ROOT / "tests" / "cases"
# A checkpoint after each step.
ALWAYS = {"Output/checkpoint interval": 1e-6}


class InterruptedRuns(RunTest):
    """Runs that end before their time."""

    def setUp(self):
        super().setUp()
        shutil.copytree(CASES, self.path, dirs_exist_ok=True)

    def start(self, file, values, ranks, *more):
        """A run that goes on, in a group of its own."""
        words = command(file, "--output", "killed", *overrides(values), *more, ranks=ranks)
        return subprocess.Popen(
            words, cwd=self.path, env=environment(), text=True,
            stdout=subprocess.PIPE, start_new_session=True,
        )  # fmt: skip

    def wait_for(self, phase, run, needs_checkpoint):
        """Until monitors.csv has some rows of the phase."""
        # 100 spheres are in after 20 ms; a flow is well on its way.
        rows_before = {"fill": 1, "settle": 3, "flow": 12}[phase]
        self.wait_for_rows(phase, rows_before, run, needs_checkpoint)

    def wait_for_rows(self, phase, number, run, needs_checkpoint, patience=300):
        """Until monitors.csv has so many rows of the phase, but no longer than so many
        seconds."""
        output = self.path / "killed"
        monitors = output / "monitors.csv"
        end = time.monotonic() + patience
        while time.monotonic() < end:
            rows = monitors.read_text().splitlines() if monitors.exists() else []
            in_phase = [row for row in rows if f",{phase}," in row]
            has_checkpoint = (output / "checkpoint").is_dir()
            if len(in_phase) >= number and (has_checkpoint or not needs_checkpoint):
                return
            self.assertIsNone(run.poll(), f"it ended before that many rows of {phase}")
            time.sleep(0.001)
        self.fail(f"there are not that many rows of {phase} after {patience} s")

    def kill(self, run):
        """Kills all ranks of a run, with what started them, and returns when they are gone.
        mpirun gives each rank a group of its own, and one that outlived it would still write."""

        while left := processes_in(self.path):
            for process in left:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(int(process.name), signal.SIGKILL)
            time.sleep(0.001)
        run.communicate()

    def kill_in(self, phase, file, values, ranks):
        """Kills a run when a checkpoint lies behind the phase's first rows."""
        run = self.start(file, {**values, **ALWAYS}, ranks)
        self.wait_for(phase, run, needs_checkpoint=True)
        self.kill(run)

    def stop_in(self, phase, file, values, ranks):
        """Asks a run to stop: its only checkpoint within a phase is the one that it then
        writes. mpirun hands on SIGUSR1, but kills at SIGTERM."""
        run = self.start(file, values, ranks)
        self.wait_for(phase, run, needs_checkpoint=False)
        run.send_signal(signal.SIGTERM if ranks == 1 else signal.SIGUSR1)
        said, _ = run.communicate(timeout=60)
        self.assertEqual(run.returncode, STOPPED, said)
        self.assertIn("asked to by a signal", said)
        self.assertIn("--resume", said)

    def expect_the_same(self, file, values, phases, further=(), ranks=1, end=None):
        whole = self.run_file(file, values, output="whole", ranks=ranks)
        self.assertEqual(whole.status, 0, whole)
        for phase in phases:
            shutil.rmtree(self.path / "killed", ignore_errors=True)
            (end or self.kill_in)(phase, file, values, ranks)
            output = self.path / "killed"
            self.assertFalse((output / "summary.json").exists())
            resumed = self.run_file(
                file, values, "--resume", output="killed", ranks=ranks
            )
            self.assertEqual(resumed.status, 0, resumed)
            self.assertIn("resumed at", resumed.said)
            self.assert_same(whole.directory, further, f"killed in {phase}")

    def assert_same(self, whole, further, message):
        """The tables of the run that was killed are those of the whole one."""
        for name in ("monitors.csv", "wall-forces.csv", *further):
            one, other = (
                (folder / name).read_text().splitlines() for folder in (whole, self.path / "killed")
            )
            self.assertEqual(len(one), len(other), f"{name}, {message}")
            for there, here in zip(one, other):
                self.assertEqual(there, here, f"{name}, {message}")
