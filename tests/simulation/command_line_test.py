# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The program as a user meets it: its options, what bad input gets, and a short
run alone and on two ranks. Called with the path of the binary."""

import json
import pathlib
import tempfile
import unittest

from runs import ROOT, call, main, overrides

from common.program import FAULT

SHORT = ROOT / "tests" / "cases" / "shallow.prm"


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
        values = ("--set", "Particles/density=1100")
        with tempfile.TemporaryDirectory() as folder:
            for form in ("prm", "json", "xml"):
                path = pathlib.Path(folder) / f"all.{form}"
                path.write_text(call(SHORT, *values, f"--print-parameters={form}").stdout)
                self.assertGreater(len(path.read_text()), 2000)
                again = call(path, "--print-parameters")
                self.assertEqual(again.stdout, call(SHORT, *values, "--print-parameters").stdout)
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
            self.assertEqual(finished.returncode, FAULT)
            self.assertIn("alpha", finished.stderr)
            self.assertIn("At the particle at", finished.stderr)
            self.assertFalse((pathlib.Path(folder) / "summary.json").exists())


class AutomaticFlow(unittest.TestCase):
    """The steady flow through a resting bed, and its hand-over to the moving one."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def flow(self, name, mode, velocities, *arguments):
        output = self.path / name
        finished = call(
            SHORT, "--set", "Output/report=false", "--set", f"Flow/mode={mode}", "--set",
            f"Flow/superficial velocities={velocities}", "--output", output, *arguments
        )
        self.assertEqual(finished.returncode, 0, finished.stderr)
        return json.loads((output / "summary.json").read_text())["cases"], finished.stdout

    def test_a_resting_bed_has_the_flow_of_the_moving_one(self):
        still, told = self.flow("still", "automatic", "0.3, 0.5")
        moving, _ = self.flow("moving", "transient", "0.3, 0.5")
        self.assertNotIn("does not rest", told)
        for one, other in zip(still, moving):
            self.assertAlmostEqual(one["pressure_drop"] / other["pressure_drop"], 1.0, delta=2e-3)
            self.assertAlmostEqual(one["bottom_force"] / one["weight"],
                                   other["bottom_force"] / other["weight"], delta=2e-3)

    def test_spheres_that_come_to_rest_late_are_waited_for(self):
        # So short a window that some move still at its end, in a bed that keeps its height.
        strict = {"Settling/interval": 1e-3, "Settling/kinetic energy": 1e-13}
        short = {"Flow/ramp time": 1e-3, "Flow/steady window": 5e-3, "Flow/time step": "auto"}
        late, told = self.flow("late", "automatic", "0.3, 0.6", *overrides({**strict, **short}))
        self.assertNotIn("does not rest", told)
        still, _ = self.flow("calm", "automatic", "0.3, 0.6", *overrides(strict))
        for one, other in zip(late, still):
            self.assertAlmostEqual(one["pressure_drop"] / other["pressure_drop"], 1.0, delta=2e-3)

    def test_a_bed_that_lifts_is_handed_over(self):
        light = ("--set", "Particles/density=300", "--set", "Geometry/height=0.08",
                 "--set", "Flow/maximum time=0.4")
        cases, told = self.flow("lifts", "automatic", "0.1, 0.4", *light)
        self.assertEqual(told.count("does not rest"), 1)
        self.assertFalse(cases[0]["fluidized"])
        self.assertGreater(cases[1]["bed_rise"], 3e-4)
        self.assertAlmostEqual(cases[1]["fluid_force"] / cases[1]["weight"], 1.0, delta=0.1)


class OriginalBed(unittest.TestCase):
    """The drag law at the void fraction of the original particles."""

    def test_it_is_measured_and_used(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder)
            drops = {}
            for choice in ("simulated", "measured", "correlation"):
                finished = call(
                    SHORT, "--set", "Output/report=false", "--set", "Flow/mode=steady", "--set",
                    "Flow/superficial velocities=0.3", "--set",
                    f"Original bed/void fraction={choice}", "--set",
                    "Original bed/measured height=0.02", "--output", output / choice
                )
                self.assertEqual(finished.returncode, 0, finished.stderr)
                summary = json.loads((output / choice / "summary.json").read_text())
                drops[choice] = summary["cases"][0]["pressure_drop"]
                ratio = summary["bed"]["original_solid_ratio"]
                self.assertEqual(ratio > 1.0, choice != "simulated")
                self.assertLess(ratio, 1.1)
            self.assertGreater(drops["measured"], 1.05 * drops["simulated"])
            self.assertGreater(drops["correlation"], 1.05 * drops["simulated"])


class Checkpoints(unittest.TestCase):
    """A run that stops goes on where it was, and its bed serves another."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        cls.whole = cls.run_short(cls.path / "whole")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def run_short(output, *arguments, ranks=1):
        finished = call(
            SHORT, "--set", "Output/report=false", "--output", output, *arguments, ranks=ranks
        )
        assert finished.returncode == 0, finished.stderr
        return json.loads((output / "summary.json").read_text())

    def expect_same_cases(self, summary, delta):
        self.assertEqual(len(summary["cases"]), len(self.whole["cases"]))
        for there, here in zip(summary["cases"], self.whole["cases"]):
            for key in ("pressure_drop", "bottom_force", "fluid_force", "simulated_time"):
                self.assertAlmostEqual(there[key] / here[key], 1.0, delta=delta, msg=key)

    def stop(self, output, *overrides):
        arguments = [part for override in overrides for part in ("--set", override)]
        finished = call(SHORT, "--output", output, *arguments)
        self.assertEqual(finished.returncode, FAULT, finished.stdout)
        self.assertIn("--resume", finished.stderr)
        self.assertIn(str(output / "checkpoint"), finished.stderr)
        self.assertFalse((output / "summary.json").exists())

    def test_a_failed_first_step_is_resumed_on_another_number_of_ranks(self):
        output = self.path / "first-step"
        self.stop(output, "Flow solver/maximum iterations=1")
        summary = self.run_short(output, "--resume", ranks=2)
        self.assertEqual(summary["bed"], self.whole["bed"])
        self.expect_same_cases(summary, 1e-9)

    def test_a_failure_within_a_case_is_resumed(self):
        output = self.path / "within"
        # Behind t = 0.05 s, the end of the fifth step, no step can be solved.
        self.stop(
            output, "Boundary conditions/bottom=velocity 0; 0; V*(t > 0.05001 ? 1e300 : 1)"
        )
        # The first step behind the checkpoint has no history of the subscales.
        self.expect_same_cases(self.run_short(output, "--resume"), 1e-4)
        whole, resumed = (
            (self.path / name / "monitors.csv").read_text().splitlines()
            for name in ("whole", "within")
        )
        times = [[line.split(",")[0] for line in lines] for lines in (whole, resumed)]
        self.assertEqual(times[0], times[1], "each step once, in order")

    def test_a_finished_run_is_resumed_for_a_further_case(self):
        output = self.path / "further"
        self.run_short(output, "--set", "Flow/superficial velocities=0.3")
        self.expect_same_cases(self.run_short(output, "--resume"), 1e-4)

    def test_a_settled_bed_serves_another_run(self):
        summary = self.run_short(
            self.path / "second",
            "--set",
            f"Filling/start from={self.path / 'whole'}",
            "--set",
            "Particles/density=1100",
            ranks=2,
        )
        self.assertNotIn("fill:", (self.path / "second" / "log.txt").read_text())
        # The lighter spheres overlap less.
        for key in ("mean_void_fraction", "height"):
            self.assertAlmostEqual(summary["bed"][key] / self.whole["bed"][key], 1.0, delta=3e-3)
        ratio = summary["cases"][0]["weight"] / self.whole["cases"][0]["weight"]
        self.assertAlmostEqual(ratio, 1100 / 2700, delta=1e-9)

    def refused(self, *arguments, says):
        finished = call(SHORT, *arguments)
        self.assertEqual(finished.returncode, 1, finished.stdout)
        for word in says:
            self.assertIn(word, finished.stderr)

    def test_what_is_not_there_or_another_is_refused(self):
        nowhere, whole = self.path / "nowhere", self.path / "whole"
        self.refused("--resume", "--output", nowhere, says=["no checkpoint", "--resume"])
        self.refused(
            "--resume", "--output", whole, "--set", "Particles/density=1100",
            says=["Particles/density", "2700", "1100"],
        )  # fmt: skip
        other = self.path / "other"
        self.refused(
            "--output", other, "--set", f"Filling/start from={nowhere}",
            says=["Filling/start from", "no settled bed"],
        )  # fmt: skip
        self.refused(
            "--output", other, "--set", f"Filling/start from={whole}",
            "--set", "Particles/scale=1", says=["Particles/scale"],
        )  # fmt: skip


if __name__ == "__main__":
    main()
