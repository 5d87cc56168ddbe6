# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A run that is killed, asked to stop or at its time limit in any phase, and gone on with, is the
run that was not: bit by bit on the same number of ranks. Called with the path of the binary.
"""

import itertools
import os
import pathlib
import re
import shlex
import shutil
import subprocess

from interrupted_runs import ALWAYS, InterruptedRuns
from runs import command, main, overrides

from common.program import NOT_WRITTEN, STOPPED, environment

# A window that the run is killed in, and what is averaged over it.
AVERAGES = {
    "Flow/time step": 2e-3,
    "Averages/from": 0.007,
    "Averages/to": 0.15,
    "Averages/interval": 0.008,
    "Averages/lines": "axis: 0 0 0 0 0 0.02 5 0.004 0.004",
    "Averages/planes": "mid: -0.006 0 0 0.006 0 0 -0.006 0 0.02 3 5 0.002",
    "Output/probes": "middle: 0 0 0.01",
}
MEANS = [
    f"{name}-01.csv"
    for name in ("averages", "spectra", "averages-lines", "averages-planes", "averages-midplane")
] + ["snapshots.csv", "probes.csv"]


class KilledRuns(InterruptedRuns):
    """Filling, settling and flow, each killed once."""

    def test_a_bed_that_moves(self):
        self.expect_the_same("restart.prm", {}, ("fill", "settle"))

    def test_averages_of_a_bed_that_moves(self):
        self.expect_the_same("restart.prm", AVERAGES, ("flow",), MEANS)

    def test_a_bed_that_moves_on_two_ranks(self):
        self.expect_the_same("restart.prm", {}, ("settle", "flow"), ranks=2)

    def test_a_liquid_with_all_its_forces(self):
        values = {
            "Flow/duration": 0.03,
            "Flow/time step": 1e-3,
            "Forces/virtual mass": "zuber",
            "Forces/viscous stress": "true",
            "Forces/shear lift": "saffman-mei",
            "Forces/spin lift": "lun-liu",
            "Forces/rotational drag": "dennis",
        }
        self.expect_the_same("water.prm", values, ("flow",))

    def test_a_rain_at_a_rate(self):
        self.expect_the_same("rate.prm", {}, ("fill", "settle"))

    def test_walls_that_move_and_a_feed(self):
        values = {
            "Flow/mode": "particles alone",
            "Flow/duration": 0.3,
            "Flow/time step": 2e-3,
            "Walls/planes": "piston: 0 0 0.003 0 0 -1",
            "Walls/motion": "piston = velocity 0; 0; 0.02*sin(40*t)",
            "Feed/rate": 77,
            "Output/report": "false",
        }
        self.expect_the_same("bed20.prm", values, ("flow",))


class StoppedRuns(InterruptedRuns):
    """Runs that are asked to stop."""

    def test_by_a_signal(self):
        self.expect_the_same("restart.prm", {}, ("fill", "flow"), end=self.stop_in)

    def test_by_a_signal_on_two_ranks(self):
        self.expect_the_same("restart.prm", {}, ("flow",), ranks=2, end=self.stop_in)

    def test_before_a_time_limit(self):
        # A thousandth of a minute is over before the first step.
        def stop(_phase, file, values, _ranks):
            run = self.run_file(file, values, "--time-limit", 1e-3, output="killed")
            self.assertEqual(run.status, STOPPED, run)
            self.assertIn("before its time limit", run.said)

        self.expect_the_same("restart.prm", {}, ("fill",), end=stop)
        far = self.run_file("restart.prm", {}, "--time-limit", 60)
        self.assertEqual(far.status, 0, far)


def cut(file):
    """Leaves the first half."""
    os.truncate(file, file.stat().st_size // 2)


def empty(file):
    """Leaves nothing in it."""
    os.truncate(file, 0)


def flip(file):
    """Turns one bit over."""
    content = bytearray(file.read_bytes())
    content[len(content) * 2 // 3] ^= 16
    file.write_bytes(content)


def overwrite(file):
    """Puts something else there."""
    file.write_text("Not what was written.\n" * 50)


DAMAGES = (cut, empty, flip, overwrite, pathlib.Path.unlink)


class DamagedFiles(InterruptedRuns):
    """Files that are not what was written are named, and not used."""

    def restore(self, kept):
        """The run as it was stopped."""
        shutil.rmtree(self.path / "killed", ignore_errors=True)
        shutil.copytree(self.path / kept, self.path / "killed")

    def test_the_checkpoint_before_is_taken(self):
        whole = self.run_file("restart.prm", {}, output="whole")
        self.stop_in("flow", "restart.prm", {}, 1)
        shutil.copytree(self.path / "killed", self.path / "kept")
        last = self.path / "killed" / "checkpoint"
        names = sorted(file.name for file in last.iterdir())
        self.assertEqual(names, ["fields", "fields.info", "fields_fixed.data", "state.bin"])
        for number, (name, damage) in enumerate(itertools.product(names, DAMAGES)):
            with self.subTest(name=name, damage=damage.__name__):
                self.restore("kept")
                damage(last / name)
                ranks = 1 + number % 2
                # To see that it goes on is enough for most of them.
                more = ["--time-limit", 1e-3] if number % 7 else []
                run = self.run_file("restart.prm", {}, "--resume", *more, output="killed", ranks=ranks)
                self.assertEqual(run.status, STOPPED if more else 0, run)
                self.assertIn(f"warning: killed/checkpoint/{name}", run.said)
                self.assertIn("goes on from the checkpoint before", run.said)
                if not more and ranks == 1:
                    self.assertEqual(
                        (whole.directory / "monitors.csv").read_text(),
                        (self.path / "killed" / "monitors.csv").read_text(),
                    )

    def test_without_a_whole_checkpoint_nothing_goes_on(self):
        self.stop_in("flow", "restart.prm", {}, 1)
        shutil.copytree(self.path / "killed", self.path / "kept")
        for ranks in (1, 2):
            self.restore("kept")
            flip(self.path / "killed" / "checkpoint" / "fields_fixed.data")
            flip(self.path / "killed" / "checkpoint.old" / "state.bin")
            run = self.run_file("restart.prm", {}, "--resume", output="killed", ranks=ranks)
            self.assertEqual(run.status, 1, run)
            self.assertIn("killed/checkpoint/fields_fixed.data is damaged", run.refusal)
            self.assertIn("killed/checkpoint.old/state.bin is cut off or damaged", run.refusal)

    def test_one_that_was_killed_before_it_had_its_name(self):
        whole = self.run_file("restart.prm", {}, output="whole")
        self.stop_in("flow", "restart.prm", {}, 1)
        (self.path / "killed" / "checkpoint").rename(self.path / "killed" / "checkpoint.new")
        run = self.run_file("restart.prm", {}, "--resume", output="killed")
        self.assertEqual(run.status, 0, run)
        self.assertNotIn("warning", run.said)
        self.assertEqual(
            (whole.directory / "monitors.csv").read_text(),
            (run.directory / "monitors.csv").read_text(),
        )

    def test_beds(self):
        bed = self.run_file("restart.prm", {"Flow/superficial velocities": ""}, output="bed")
        self.assertEqual(bed.status, 0, bed)
        file = bed.directory / "bed.bin"
        content = file.read_bytes()
        for damage in DAMAGES:
            damage(file)
            run = self.run_file("restart.prm", {"Filling/start from": "bed"})
            self.assertEqual(run.status, 1, run)
            self.assertIn("Filling/start from", run.refusal)
            self.assertIn("bed/bed.bin", run.refusal)
            file.write_bytes(content)
        run = self.run_file("restart.prm", {"Filling/start from": "bed"})
        self.assertEqual(run.status, 0, run)


class FullDisks(InterruptedRuns):
    """What cannot be written is told, and nothing is left in halves."""

    def run_within(self, size, *more):
        """A run on a disk of so many bytes, whose files are left in the folder "small"."""
        words = shlex.join(command("bed20.prm", "--output", "disk/o", *overrides(AVERAGES), *more))
        script = (
            f"mkdir -p disk && mount -t tmpfs -o size={size} none disk && {words}; status=$?;"
            " rm -rf small; cp -r disk/o small; exit $status"
        )
        return subprocess.run(
            ["unshare", "--mount", "--map-root-user", "sh", "-c", script], cwd=self.path,
            env=environment(), capture_output=True, text=True, timeout=120, check=False,
        )  # fmt: skip

    def test_files_are_whole_or_named(self):
        allowed = subprocess.run(["unshare", "--mount", "--map-root-user", "true"], check=False)
        if allowed.returncode:
            self.skipTest("this machine lets nobody mount a small disk")
        named, size = set(), 16384
        while True:
            run = self.run_within(size)
            if run.returncode == 0:
                break
            self.assertEqual(run.returncode, NOT_WRITTEN, f"{size}: {run.stdout}{run.stderr}")
            told = re.search(r"Cannot write disk/o/(\S+): (.*)", run.stderr)
            self.assertIsNotNone(told, run.stderr)
            named.add(told[1])
            self.assertNotIn("Stacktrace", run.stderr)
            for file in (self.path / "small").rglob("*.csv"):
                text = file.read_text(encoding="utf-8")
                self.assertTrue(text.endswith("\n"), f"{file} is cut on {size} bytes")
            self.assertEqual(list((self.path / "small").rglob("*.part")), [])
            size += 16384
        # The disk was full at many places before there was enough of it.
        print(f"enough: {size} bytes; named before: {', '.join(sorted(named))}")
        self.assertGreater(len(named), 3)

    def test_crashes_leave_no_semaphores(self):
        # On one that Open MPI's shared file pointers leave, every later run would hang.
        def semaphores():
            return {str(file) for file in pathlib.Path("/dev/shm").glob("sem.*")}

        before = semaphores()
        run = self.start("restart.prm", ALWAYS, 2)
        self.wait_for("settle", run, needs_checkpoint=True)
        self.kill(run)
        self.assertEqual(semaphores() - before, set())


if __name__ == "__main__":
    main()
