"""The program as a user meets it: its options, what bad input gets, and a short
run alone and on two ranks. Called with the path of the binary."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BINARY = None
ROOT = pathlib.Path(__file__).resolve().parents[2]
SHORT = ROOT / "prm" / "packed-bed" / "short.prm"


def call(*arguments, ranks=1):
    """The finished process of graupel with these arguments."""
    environment = dict(
        os.environ,
        OMPI_ALLOW_RUN_AS_ROOT="1",
        OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
        OMP_NUM_THREADS="1",
    )
    command = [BINARY, *map(str, arguments)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks)] + command
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600)


class Options(unittest.TestCase):
    def test_help_and_version(self):
        self.assertEqual(call("--help").returncode, 0)
        self.assertIn("--print-parameters", call("--help").stdout)
        self.assertIn("graupel", call("--version").stdout)

    def test_without_a_file_it_tells_the_usage(self):
        finished = call()
        self.assertEqual(finished.returncode, 1)
        self.assertIn("prm/packed-bed", finished.stderr)

    def test_check_tells_groups_and_steps(self):
        finished = call(SHORT, "--check")
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertIn("substep", finished.stdout)
        self.assertIn("onset of fluidisation", finished.stdout)

    def test_printed_parameters_can_be_read_again(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "all.prm"
            path.write_text(call("--print-parameters").stdout)
            self.assertGreater(len(path.read_text()), 2000)
            finished = call(path, "--check")
            self.assertEqual(finished.returncode, 0, finished.stderr)


class BadInput(unittest.TestCase):
    def refused(self, *arguments, says):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "results"
            finished = call(*arguments, "--output", output)
            self.assertEqual(finished.returncode, 1, finished.stdout)
            for word in says:
                self.assertIn(word, finished.stderr)
            self.assertLessEqual(len(finished.stderr.splitlines()), 4, finished.stderr)
            self.assertFalse(output.exists(), "half-written output")

    def test_missing_file(self):
        self.refused("no-such-file.prm", says=["no-such-file.prm"])

    def test_misspelt_parameter_names_line_and_nearest(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bad.prm"
            path.write_text("subsection Geometry\n  set diametre = 0.025\nend\n")
            self.refused(path, says=["bad.prm:2", "Geometry/diameter"])

    def test_line_of_an_impossible_value(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bad.prm"
            path.write_text("subsection Particles\n  set scale = 0.5\nend\n")
            self.refused(path, says=["bad.prm:2", "Particles/scale", "0.5"])

    def test_impossible_overrides(self):
        for value in ("Geometry/diameter=-1", "Coupling/filter length=-1", "Flow/time step=0"):
            self.refused(SHORT, "--set", value, says=[value.split("=")[0], "--set"])

    def test_directory_that_cannot_be_written(self):
        finished = call(SHORT, "--output", "/proc/nowhere")
        self.assertEqual(finished.returncode, 1)
        self.assertIn("Output/directory", finished.stderr)


class ShortRun(unittest.TestCase):
    """Runs the short example once a rank count and looks at all that it wrote."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.summary = {}
        for ranks in (1, 2):
            output = pathlib.Path(cls.folder.name) / str(ranks)
            finished = call(SHORT, "--output", output, ranks=ranks)
            assert finished.returncode == 0, finished.stderr
            cls.summary[ranks] = json.loads((output / "summary.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_bed_is_the_same_on_two_ranks_bit_by_bit(self):
        self.assertEqual(self.summary[1]["bed"], self.summary[2]["bed"])
        self.assertEqual(self.summary[1]["bed"]["particle_count"], 150)

    def test_pressure_drop_is_the_same_on_two_ranks(self):
        for alone, together in zip(self.summary[1]["cases"], self.summary[2]["cases"]):
            self.assertGreater(alone["pressure_drop"], 1.0)
            # The linear solver's tolerance, 1e-8, through some dozens of steps.
            self.assertAlmostEqual(together["pressure_drop"] / alone["pressure_drop"], 1.0, delta=1e-5)

    def test_ledger(self):
        for summary in self.summary.values():
            self.assertLessEqual(summary["ledger"]["max_mass_imbalance"], 1e-8)
            self.assertLessEqual(summary["ledger"]["max_momentum_imbalance"], 1e-10)
            self.assertLessEqual(summary["ledger"]["max_solid_volume_error"], 1e-12)

    def test_forces_balance(self):
        for case in self.summary[1]["cases"]:
            carried = case["bottom_force"] + case["wall_force"]
            self.assertAlmostEqual(carried / (case["weight"] - case["fluid_force"]), 1.0, delta=0.01)

    def test_promised_keys(self):
        summary = self.summary[1]
        self.assertEqual(
            set(summary["program"]) & {"name", "version", "deal_ii_version", "mpi_ranks"},
            {"name", "version", "deal_ii_version", "mpi_ranks"},
        )
        promised = (
            "superficial_velocity pressure_drop ergun_pressure_drop deviation_from_ergun "
            "gradient_deviation_from_ergun bed_height mean_void_fraction bottom_force wall_force "
            "fluidized steady simulated_time wall_seconds cpu_seconds"
        ).split()
        for key in promised:
            self.assertIn(key, summary["cases"][0])
        for key in "wall_seconds cpu_seconds particle_steps contact_steps fluid_steps".split():
            self.assertGreater(summary["cost"][key], 0)

    def test_promised_files(self):
        output = pathlib.Path(self.folder.name) / "2"
        for name in (
            "parameters.prm log.txt summary.json cases.csv monitors.csv profiles-01.csv "
            "radial-02.csv midplane-02.csv solution.pvd particles.pvd report.html"
        ).split():
            self.assertGreater((output / name).stat().st_size, 50, name)
        finished = call(output / "parameters.prm", "--check")
        self.assertEqual(finished.returncode, 0, finished.stderr)

    def test_a_failure_during_the_run_is_told_in_a_sentence(self):
        # The expression passes the checks, at void fractions of 0.3, 0.4 to 0.7, but
        # is negative between the last two, where the particles at the surface are.
        with tempfile.TemporaryDirectory() as folder:
            finished = call(
                SHORT,
                "--set",
                "Coupling/scaling=expression",
                "--set",
                "Coupling/scaling expression=Cd*(abs(alpha-0.65)-0.045)",
                "--output",
                folder,
            )
            self.assertEqual(finished.returncode, 1)
            self.assertIn("alpha", finished.stderr)
            self.assertIn("At the particle at", finished.stderr)
            self.assertFalse((pathlib.Path(folder) / "summary.json").exists())


if __name__ == "__main__":
    BINARY = sys.argv.pop(1)
    unittest.main()
