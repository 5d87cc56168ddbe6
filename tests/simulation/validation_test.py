# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Whether the frame of scripts/validate works: every case can run, a short one runs and makes its
page, and its arithmetic is right. Called with the path of the binary.
"""

import csv
import math
import subprocess
import sys
import unittest

from runs import ROOT, Program, RunTest, call, main

import numpy as np

from common.force_balance import Suspension, dallavalle, ergun, rong, wen_yu
from graupel.report.reference import ergun_pressure_drop
from graupel.run import Run
from common.statistics import crossings_with_error, mean_with_error, rms_with_error
from validation_parts import page
from validation_parts.case import Comparison, load, names
from validation_parts.kept import RunsWithKept

VALIDATE = ROOT / "scripts" / "validate"
PARTS = ("TITLE", "SOURCE", "runs", "evaluate", "figure")
NEEDS_AVERAGES = ("mueller",)


def validate(*arguments):
    """The finished process of scripts/validate."""
    command = [sys.executable, str(VALIDATE), "--program", Program.path, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)


class Cases(RunTest):
    """prm/validation."""

    def test_each_has_its_parts_and_can_run(self):
        averages = "subsection Averages" in call("--print-parameters").stdout
        for name in names():
            for part in PARTS:
                self.assertTrue(hasattr(load(name), part), f"{name}: {part}")
            if averages or name not in NEEDS_AVERAGES:
                done = validate("--check", "--quick", name)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn("can run", done.stdout)

    def test_one_that_is_not_there(self):
        done = validate("nonsense")
        self.assertEqual(done.returncode, 2)
        self.assertIn("shallow-onset", done.stderr)

    def test_a_short_one_makes_its_page_and_is_not_repeated(self):
        where = ("--quick", "--results", self.path / "runs", "--page", self.path / "page")
        first = validate("shallow-onset", *where)
        # So small a bed need not meet the limit; a run that failed would be 2.
        self.assertIn(first.returncode, (0, 1), first.stdout + first.stderr)
        with open(self.path / "page" / "shallow-onset.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual(len(rows), 1)
        ratio = float(rows[0]["ours"]) / float(rows[0]["expected"])
        self.assertAlmostEqual(ratio - 1.0, float(rows[0]["deviation"]), places=12)
        # A bed of six diameters loses a good part of its drop at wall and ends.
        self.assertTrue(0.7 < ratio < 1.4, ratio)
        text = (self.path / "page" / "README.md").read_text(encoding="utf-8")
        self.assertIn("onset, glass-in-air [m/s]", text)
        self.assertIn("shallow-onset.png", text)
        self.assertGreater((self.path / "page" / "shallow-onset.png").stat().st_size, 1000)
        self.assertIn("done before", validate("shallow-onset", *where).stdout)


class Page(unittest.TestCase):
    """What becomes of a comparison."""

    def test_limits(self):
        def of(ours, limit, relative=True):
            return Comparison("a", "m", -2.0, ours, limit=limit, relative=relative)

        self.assertTrue(of(-2.05, 0.03).is_met)
        self.assertAlmostEqual(of(-2.05, 0.03).deviation, -0.025)
        self.assertFalse(of(-2.07, 0.03).is_met)
        self.assertTrue(of(-2.07, 0.08, relative=False).is_met)
        self.assertFalse(of(math.nan, 0.03).is_met)
        self.assertIsNone(of(-9.0, None).is_met)

    def test_a_line(self):
        row = {"quantity": "drop", "unit": "Pa", "expected": "100.0", "ours": "99.0",
               "error": "0.5", "deviation": "-0.01", "limit": "0.02", "relative": "True",
               "met": "True", "decimals": "1", "run": "a", "cpu_seconds": "12"}  # fmt: skip
        small = {**row, "ours": "1.23e-14", "deviation": "1.23e-14", "relative": "False",
                 "limit": "1e-10", "decimals": "-1", "error": ""}  # fmt: skip
        (line,) = page.case_rows("gas", [small])
        self.assertEqual(line[3:6], ["1.2e-14", "+1.2e-14", "1e-10"])
        first, second, other = page.case_rows("gas", [row, row, {**row, "run": "b"}])
        self.assertEqual(
            first,
            ["[gas](#gas)", "drop [Pa]", "100.0", "99.0 ± 0.5", "-1.0 %", "2.0 %", "yes", "12 s"],
        )
        self.assertEqual((second[-1], other[-1]), ("", "12 s"))

    def test_what_other_runs_came_to_stays(self):
        before = [{"run": "a", "ours": 1}, {"run": "b", "ours": 2}, {"run": "gone", "ours": 3}]
        now = [{"run": "c", "ours": 4}, {"run": "a", "ours": 5}]
        self.assertEqual(
            page.merged(before, now, ["a", "b", "c"]),
            [{"run": "a", "ours": 5}, {"run": "b", "ours": 2}, {"run": "c", "ours": 4}],
        )


class Evaluations(RunTest):
    """What cases make of files whose content is known."""

    def test_mueller_tells_by_how_much_a_line_is_off(self):
        mueller = load("mueller")
        # A void fraction that falls by 0.1 across the box, and what was measured.
        at, value = mueller.points(0.6, 0.0164, "void_fraction")
        self.assertEqual(len(at), 22, "points seen by magnetic resonance, without simulations")
        expected = math.sqrt(np.mean((0.6 - at / 0.44 - value) ** 2))
        profiles = self.profiles("output", "0.6-coarse", 0.4)
        off = mueller.difference(
            mueller.lines_of(profiles)["void-16"], 0.6, 0.0164, "void_fraction"
        )
        self.assertAlmostEqual(off, expected, places=9)

    def profiles(self, folder, run, at_wall):
        """The file of a run with a line for each of those that are compared."""
        file = self.path / folder / run / "averages-lines-01.csv"
        file.parent.mkdir(parents=True)
        rows = ["name,x,solid_fraction,solid_fraction_error,velocity_z,velocity_error_z"]
        rows += ["elsewhere,0.0,0.9,,,"]
        for name, *_ in load("mueller").LINES:
            rows += [
                f"{name},{x - 0.022},{at_wall + x / 0.44},0.003,{x},0.004"
                for x in np.linspace(0.0, 0.044, 12)
            ]
        file.write_text("\n".join(rows) + "\n", encoding="utf-8")
        (file.parent / "summary.json").write_text("{}", encoding="utf-8")
        return file

    def test_runs_that_the_page_keeps_are_compared_with_those_that_are_there(self):
        mueller = load("mueller")
        self.profiles("page/kept", "0.6-coarse", 0.4)
        self.profiles("output", "0.6-fine", 0.41)
        results = RunsWithKept(self.path / "output", "", self.path / "page" / "kept")
        results.keep(["0.6-coarse", "0.6-fine"], mueller.KEPT)
        rows = {one.quantity: one for one in mueller.evaluate(results)}
        one = rows["void-16, 0.6 m/s, fine against coarse"]
        self.assertAlmostEqual(one.ours, 0.01, places=12)
        self.assertAlmostEqual(one.limit, 3.0 * math.hypot(0.003, 0.003), places=12)
        self.assertTrue(one.is_met)
        self.assertIn("rms difference, void-16, 0.6 m/s, coarse mesh", rows)
        self.assertNotIn("rms difference, void-16, 0.9 m/s, coarse mesh", rows)

    def test_van_wachem_finds_the_frequency_of_a_sine(self):
        time = np.linspace(0.0, 8.0, 4096)
        wave = 3.0 + np.sin(2.0 * np.pi * 2.4 * time)
        # Windows of 4 s tell 0.25 Hz apart.
        found = load("van-wachem").dominant(time, wave)
        self.assertAlmostEqual(found, 2.4, delta=0.125)

    def test_richardson_and_zaki_by_the_height_of_the_solids(self):
        case = load("richardson-zaki")
        diameter, void, count = 0.04, 0.6, 500
        area = math.pi / 4.0 * diameter**2
        run = Run(self.path, summary={"bed": {"solid_volume": 0.4 * area * 0.1}})
        run.monitors = {
            "case": np.ones(count),
            "phase": np.full(count, "flow"),
            "time": np.linspace(0.0, 5.0, count),
            "center_of_mass": np.full(count, 0.05),
        }
        found, error = case.void_fraction(run, {"number": 1}, diameter)
        self.assertAlmostEqual(found, void, places=9)
        self.assertAlmostEqual(error, 0.0, places=12)


class Laws(unittest.TestCase):
    """The force balance of a homogeneous bed."""

    GLASS = (2e-3, 2500.0, 998.0, 1e-3)

    def test_ergun_carries_the_weight(self):
        # By his equation for a fixed bed, which is written elsewhere.
        bed = Suspension(ergun, *self.GLASS)
        for alpha in (0.38, 0.5):
            velocity = bed.superficial_velocity(alpha)
            drop = ergun_pressure_drop(velocity, 1.0, alpha, 2e-3, 998.0, 1e-3)
            self.assertAlmostEqual(drop / ((1.0 - alpha) * 1502.0 * 9.81), 1.0, places=9)

    def test_one_sphere_falls_at_its_terminal_velocity(self):
        # In clear fluid both laws are those of one sphere; in slow flow that is Stokes'.
        slow = Suspension(wen_yu, 10e-6, 2500.0, 998.0, 1e-3)
        stokes = 1502.0 * 9.81 * 1e-10 / 18e-3
        self.assertAlmostEqual(slow.settling_velocity(1.0) / stokes, 1.0, delta=1e-2)
        self.assertAlmostEqual(rong(1.0, 50.0), dallavalle(50.0), places=9)

    def test_void_fraction_inverts_the_velocity(self):
        bed = Suspension(rong, *self.GLASS)
        self.assertAlmostEqual(bed.void_fraction(bed.superficial_velocity(0.63)), 0.63, places=9)


class Statistics(unittest.TestCase):
    """Errors of means."""

    def test_independent_values(self):
        values = np.random.default_rng(1).normal(3.0, 0.5, 4096)
        mean, error = mean_with_error(values)
        expected = 0.5 / 64.0
        self.assertAlmostEqual(mean, 3.0, delta=4.0 * expected)
        self.assertTrue(0.9 * expected < error < 1.2 * expected, error)

    def test_values_that_come_in_runs(self):
        # Each value sixteen times over tells no more than once.
        values = np.repeat(np.random.default_rng(2).normal(0.0, 1.0, 512), 16)
        _, error = mean_with_error(values)
        self.assertTrue(0.85 / math.sqrt(512) < error < 1.2 / math.sqrt(512), error)

    def test_values_that_swing(self):
        # Blocks of half a period scatter four times as much as tells of the mean: x follows
        # x_k = a x_{k-1} + b x_{k-2} + e, whose spectrum at 0 is that of e over (1 - a - b)^2.
        a, b = 2.0 * 0.95 * math.cos(2.0 * math.pi / 20.0), -(0.95**2)
        x = np.random.default_rng(4).normal(0.0, 1.0, 16384)
        for k in range(2, len(x)):
            x[k] += a * x[k - 1] + b * x[k - 2]
        expected = 1.0 / (1.0 - a - b) / 128.0
        _, error = mean_with_error(x)
        self.assertTrue(0.8 * expected < error < 1.25 * expected, error)

    def test_values_that_drift(self):
        # No blocks are independent: the longest, an eighth of the range each.
        _, error = mean_with_error(np.arange(256.0))
        self.assertAlmostEqual(error, 32.0 * math.sqrt(6.0 / 8.0), delta=1e-9)

    def test_the_rms_of_independent_values(self):
        values = np.random.default_rng(3).normal(3.0, 0.5, 4096)
        rms, error = rms_with_error(values)
        expected = 0.5 / math.sqrt(2.0 * 4096)
        self.assertAlmostEqual(rms, 0.5, delta=4.0 * expected)
        self.assertTrue(0.9 * expected < error < 1.2 * expected, error)

    def test_how_often_a_wave_rises(self):
        time = np.linspace(0.0, 8.0, 4001)
        frequency, error = crossings_with_error(time, 2.0 + np.sin(2.0 * math.pi * 3.0 * time - 0.1))
        self.assertAlmostEqual(frequency, 3.0, delta=1e-9)
        # What comes at equal times is known better than what comes at random, sqrt(3 / 8).
        self.assertLess(error, 0.7)


if __name__ == "__main__":
    main()
