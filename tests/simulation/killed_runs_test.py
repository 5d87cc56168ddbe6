"""A run that is killed in any phase and gone on with is the run that was not: bit by bit
on the same number of ranks. Called with the path of the binary.
"""

import os
import shutil
import signal
import subprocess
import time

from runs import ROOT, RunTest, command, environment, main, overrides

CASES = ROOT / "tests" / "cases"
# A checkpoint after each step.
ALWAYS = {"Output/checkpoint interval": 1e-6}
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


class KilledRuns(RunTest):
    """Filling, settling and flow, each killed once."""

    def setUp(self):
        super().setUp()
        shutil.copytree(CASES, self.path, dirs_exist_ok=True)

    def kill_in(self, phase, file, values, ranks):
        """Kills a run when monitors.csv has some rows of the phase and a checkpoint lies
        behind them."""
        output = self.path / "killed"
        words = command(
            file, "--output", "killed", *overrides({**values, **ALWAYS}), ranks=ranks
        )
        # In a group of its own, so that all ranks are killed, with what started them.
        run = subprocess.Popen(
            words, cwd=self.path, env=environment(),
            stdout=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
        monitors = output / "monitors.csv"
        # 100 spheres are in after 20 ms; a flow is well on its way.
        rows_before = {"fill": 1, "settle": 3, "flow": 12}[phase]
        for _ in range(6000):
            rows = monitors.read_text().splitlines() if monitors.exists() else []
            in_phase = [row for row in rows if f",{phase}," in row]
            if len(in_phase) >= rows_before and (output / "checkpoint").is_dir():
                break
            self.assertIsNone(run.poll(), f"it ended before that many rows of {phase}")
            time.sleep(0.001)
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        return output

    def expect_the_same(self, file, values, phases, further=(), ranks=1):
        whole = self.run_file(file, values, output="whole", ranks=ranks)
        self.assertEqual(whole.status, 0, whole)
        for phase in phases:
            shutil.rmtree(self.path / "killed", ignore_errors=True)
            output = self.kill_in(phase, file, values, ranks)
            self.assertFalse((output / "summary.json").exists())
            resumed = self.run_file(
                file, values, "--resume", output="killed", ranks=ranks
            )
            self.assertEqual(resumed.status, 0, resumed)
            self.assertIn("resumed at", resumed.said)
            for name in ("monitors.csv", "wall-forces.csv", *further):
                one, other = (
                    (folder / name).read_text().splitlines()
                    for folder in (whole.directory, output)
                )
                self.assertEqual(len(one), len(other), f"{name}, killed in {phase}")
                for there, here in zip(one, other):
                    self.assertEqual(there, here, f"{name}, killed in {phase}")

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


if __name__ == "__main__":
    main()
