# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Means over time, compared with analysis: of a flow that swings, of spheres that fall, of a
bed that rests. Called with the path of the binary.
"""

import math
import shutil

import numpy as np
from runs import ROOT, RunTest, main


CASES = ROOT / "tests" / "cases"
GRAVITY = 9.81
# Cells, numbers are written with ten digits.
WRITTEN = 2e-10


def volume_in_box(center, radius, lower, upper, n=200):
    """Volume of a sphere in a box [m^3], its height summed over its section."""
    x, y = (
        low + (high - low) * (np.arange(n) + 0.5) / n
        for low, high in zip(lower[:2] - center[:2], upper[:2] - center[:2])
    )
    height = np.sqrt(np.maximum(0.0, radius**2 - x[:, None] ** 2 - y[None, :] ** 2))
    above = np.minimum(height, upper[2] - center[2])
    below = np.maximum(-height, lower[2] - center[2])
    cell = (upper[0] - lower[0]) * (upper[1] - lower[1]) / n**2
    return np.maximum(0.0, above - below).sum() * cell


class Averages(RunTest):
    """Each against what must come out."""

    def setUp(self):
        super().setUp()
        shutil.copytree(CASES, self.path, dirs_exist_ok=True)

    def finished(self, *arguments, **options):
        run = self.run_file(*arguments, **options)
        self.assertEqual(run.status, 0, run)
        return run

    def series(self, run):
        """averages-01.csv by quantity."""
        return {row["quantity"]: row for row in run.rows("averages-01.csv")}

    def test_a_flow_that_swings(self):
        # Air in an empty tube with walls that slip moves as one: q = V(t) everywhere, and
        # the pressure accelerates it: dp = rho H dV/dt.
        mean, swing, frequency, step, height = 0.3, 0.1, 20.0, 5e-3, 0.02
        values = {
            "Filling/method": "none",
            "Filling/count": 0,
            "Flow/mode": "transient",
            "Flow/superficial velocities": mean,
            "Flow/duration": 1.0,
            "Flow/time step": step,
            "Flow/ramp time": 0,
            "Averages/from": 0.2,
            "Averages/to": 1.0,
            "Averages/lines": "axis: 0 0 0 0 0 0.02 4 0.004 0.004",
            "Output/probes": "middle: 0 0 0.01",
            "Boundary conditions/bottom": f"velocity 0; 0; {mean}"
            f" + {swing}*sin({2 * math.pi * frequency}*t)",
            "Fluid/density": 1.2,
        }
        run = self.finished("bed20.prm", values)
        found = self.series(run)
        # Whole periods at even steps: to the solver's tolerance.
        for name in ("superficial_velocity", "middle_velocity_z"):
            self.assert_close(found[name]["mean"], mean, 1e-5, f"mean of {name}")
            self.assert_close(found[name]["rms"], swing / math.sqrt(2), 1e-5, f"rms of {name}")
            # A twentieth of the spectrum's step, four over the window of 0.8 s.
            self.assert_within(found[name]["frequency"], frequency, 0.25, name)
        for row in run.rows("averages-lines-01.csv"):
            self.assert_close(row["flux_z"], mean, 1e-5, "flux")
            self.assert_within(row["void_fraction"], 1.0, 1e-12, "void fraction")
            self.assert_within(row["void_fraction_rms"], 0.0, 1e-12, "its rms")
            self.assertEqual(row["samples"], 160)
        for row in run.rows("averages-midplane-01.csv"):
            self.assert_close(row["superficial_velocity"], mean, 1e-5, "flux on the plane")
        # BDF1's difference of a sine is its derivative times sin(x)/x, x = omega step/2.
        half = math.pi * frequency * step
        drop = 1.2 * height * 2 * math.pi * frequency * swing * math.sin(half) / half
        self.assert_close(run.case["pressure_drop_rms"], drop / math.sqrt(2), 0.01, "drop")
        self.assert_within(run.case["pressure_frequency"], frequency, 0.25, "of the drop")
        self.assert_within(run.case["pressure_drop"], 0.0, 0.01 * drop, "mean drop")
        self.assert_close(run.case["averaged_time"], 0.8, 1e-9, "window")
        peak = max(run.rows("spectra-01.csv"), key=lambda row: row["middle_velocity_z"])
        self.assert_within(peak["frequency"], frequency, 2.5, "highest density")
        self.assertEqual(len({row["time"] for row in run.rows("snapshots.csv")}), 6)

    def fall(self, ranks):
        spheres = [(x, 0.0, z, 2e-3, vx) for x, z, vx in ((-2e-3, 0.55, 1e-3), (2e-3, 0.57, 0.0))]
        lines = ["x,y,z,diameter,vx"] + [",".join(map(str, sphere)) for sphere in spheres]
        (self.path / "two.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        values = {
            "Particles/gravity": GRAVITY,
            "Particles/diameter": 2e-3,
            "Geometry/height": 0.6,
            "Mesh/cell size": 6e-3,
            "Flow/mode": "particles alone",
            "Flow/duration": 0.2,
            "Flow/time step": 2e-3,
            "Averages/from": 0.1,
            "Averages/to": 0.2,
            "Averages/lines": "all: 0 0 0.1 0 0 0.6 1 0.008 0.008 | none: 0 0 0 0 0 0.01 2 0.01 0.01",
            "Averages/planes": "outside: 1 0 0 2 0 0 1 1 0 2 1 1",
        }
        return self.finished("list9.prm", values, ranks=ranks)

    def test_spheres_that_fall(self):
        one, two = self.fall(1), self.fall(2)
        for name in ("averages-01.csv", "averages-lines-01.csv", "averages-planes-01.csv"):
            texts = [(run.directory / name).read_text() for run in (one, two)]
            self.assertEqual(*texts, f"{name} on two ranks")
        rows = one.rows("averages-lines-01.csv")
        before = one.rows("monitors.csv")[-1]["time"] - 0.2
        # Looks after n steps: v = -g t at their ends, an arithmetic progression.
        n, step = 50, 2e-3
        mean = -GRAVITY * (before + 0.1 + 0.5 * (n + 1) * step)
        rms = GRAVITY * step * math.sqrt((n**2 - 1) / 12)
        bin = rows[0]
        self.assertEqual((bin["samples"], bin["seen"], bin["particles"]), (n, n, 2.0))
        self.assert_close(bin["velocity_z"], mean, 1e-9, "mean velocity")
        self.assert_close(bin["velocity_rms_z"], rms, 1e-6, "rms of the velocity")
        self.assert_close(bin["velocity_x"], 0.5e-3, 1e-6, "velocity across")
        # The speed drifts: no mean, no error of it; across nothing changes.
        self.assertIsNone(bin["velocity_error_z"])
        self.assert_within(bin["velocity_error_x"], 0.0, 1e-12, "error of the velocity across")
        # Two velocities 1 mm/s apart: half of the square is their variance.
        self.assert_close(bin["granular_temperature"], 0.5e-6 / 3, 1e-4, "temperature")
        volume = 2 * math.pi / 6 * 2e-3**3
        self.assert_close(bin["volume"], 0.5 * 0.008**2, WRITTEN, "volume")
        self.assert_close(bin["solid_fraction"], volume / bin["volume"], 1e-9, "solid")
        self.assert_close(bin["solid_flux_z"], mean * volume / bin["volume"], 1e-9, "flux")
        for empty in rows[1:]:
            self.assertEqual((empty["seen"], empty["particles"]), (0, 0.0))
            self.assertIsNone(empty["velocity_z"])
            self.assertEqual(empty["solid_fraction"], 0.0)
        for outside in one.rows("averages-planes-01.csv"):
            self.assertEqual(outside["volume"], 0.0)
            self.assertIsNone(outside["solid_fraction"])
        # Their middle: a parabola, to the quanta of the sums and the digits of the file.
        row = one.rows("monitors.csv")[-1]
        height = 0.56 - 0.5 * GRAVITY * row["time"] ** 2
        self.assert_within(row["center_of_mass"], height, 1e-8, "center of mass")

    def test_a_bed_that_rests(self):
        n, width = 6, 0.002
        line = f"low: {-n * width / 2} 0 0.003 {n * width / 2} 0 0.003 {n} 0.004 0.003"
        values = {
            "Flow/mode": "particles alone",
            "Flow/duration": 0.02,
            "Averages/to": 0.02,
            "Averages/lines": line,
            "Averages/planes": "all: -0.006 -0.006 0.01 0.006 -0.006 0.01 -0.006 0.006 0.01"
            " 3 4 0.02",
        }
        run = self.finished("bed20.prm", values)
        centers = run.particles(1).points
        self.assertEqual(len(centers), 100)
        for k, row in enumerate(run.rows("averages-lines-01.csv")):
            lower = np.array([(k - n / 2) * width, -0.002, 0.0015])
            upper = lower + [width, 0.004, 0.003]
            solid = sum(volume_in_box(center, 1e-3, lower, upper) for center in centers)
            # The sum over a section errs by 200^-1.5 of a sphere at each rim.
            self.assert_within(
                row["solid_fraction"] * row["volume"], solid, 2e-3 * 4.2e-9, f"bin {k}"
            )
            self.assertLess(row["solid_fraction_rms"], 1e-3)
        # Bins that cover the vessel hold all of the solid, but for what overlaps the walls by
        # some millionths. Those at the wall reach beyond it: all together they have the
        # volume of the vessel, to their points.
        rows = run.rows("averages-planes-01.csv")
        total = sum((row["solid_fraction"] or 0.0) * row["volume"] for row in rows)
        self.assert_close(total, run.bed["solid_volume"], 1e-5, "solid in all bins")
        vessel = math.pi / 4 * 0.012**2 * 0.02
        self.assert_close(sum(row["volume"] for row in rows), vessel, 0.01, "their volume")
        self.assertEqual(sum(row["particles"] for row in rows), 100)

    def test_the_fluid_and_the_spheres_agree_in_bins(self):
        # A bin that is the whole vessel: the filter keeps what it spreads. What is left is
        # that a mean over points is no integral over cells: some hundredths of the solid.
        values = {
            "Flow/superficial velocities": 0.3,
            "Flow/mode": "transient",
            "Flow/duration": 0.2,
            "Averages/from": 0.1,
            "Averages/to": 0.2,
            "Averages/interval": 0.03,
            "Averages/lines": "all: 0 0 0 0 0 0.02 1 0.012 0.012",
        }
        row = self.finished("bed20.prm", values).rows("averages-lines-01.csv")[0]
        self.assert_close(
            1.0 - row["void_fraction"], row["solid_fraction"], 0.02, "solid on the mesh"
        )
        # 0.03, 0.06, 0.09 s, and the end of the window.
        self.assertEqual(row["samples"], 4)

    def test_what_is_refused(self):
        for values, words in (
            ({"Averages/lines": "a: 0 0 0 0 0 1 5 1 1"}, ["Averages/to"]),
            ({"Averages/to": 1, "Averages/lines": "a: 0 0 0"}, ["Averages/lines", "BINS"]),
            ({"Averages/to": 1, "Averages/from": 0.5}, ["Averages/from", "0.1"]),
            ({"Averages/to": 1, "Mesh adaption/interval": 0.1}, ["Mesh adaption/interval"]),
        ):
            run = self.run_file("restart.prm", {"Flow/duration": 0.1, **values}, "--check")
            self.assertEqual(run.status, 1, run)
            for word in words:
                self.assertIn(word, run.refusal)

    def test_a_case_that_ends_early_says_so(self):
        values = {"Flow/duration": 0.05, "Averages/to": 1, "Averages/from": 0.01}
        run = self.finished("restart.prm", values)
        self.assertIn("means are over 0.04 s", run.said)
        self.assert_close(run.case["averaged_time"], 0.04, 1e-6, "window")


if __name__ == "__main__":
    main()
