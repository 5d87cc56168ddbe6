#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Tests what scripts/paper.py makes of runs: onset and plateau."""

import math
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))

import numpy as np

from common import fluidisation
from graupel.run import Run

AREA = math.pi * 0.025**2 / 4.0
A, B, WEIGHT = 700.0, 1700.0, 0.48


def fixed_bed(velocity):
    """Pressure drop of the made-up bed [Pa]."""
    return A * velocity + B * velocity**2


def a_run(velocities, buoyancy=0.0):
    """A run whose bed drops a V + b V^2 until the fluid carries it."""
    run = Run(pathlib.Path("nowhere"))
    solid = buoyancy / (fluidisation.GRAVITY * 1.2)
    run.summary = {
        "bed": {"vessel_diameter": 0.025, "solid_volume": solid},
        "fluid": {"density": 1.2},
    }
    rows = []
    for number, velocity in enumerate(velocities, start=1):
        drop = min(fixed_bed(velocity), (WEIGHT - buoyancy) / AREA)
        fluid = drop * AREA + buoyancy
        run.cases.append(
            {
                "number": number,
                "superficial_velocity": velocity,
                "pressure_drop": drop,
                "fluid_force": fluid,
                "weight": WEIGHT,
            }
        )
        bottom = WEIGHT - fluid
        # A lifted bed drops more, and hangs on the wall, in the first half only.
        swing = 0.02 * WEIGHT if bottom < 1e-12 else 0.0
        for step in range(40):
            extra = swing if step < 20 else 0.0
            rows.append(
                (number, 0.01 * step + number, drop + extra / AREA, bottom, 0.01 * WEIGHT - extra)
            )
    columns = list(zip(*rows))
    run.monitors = {
        name: np.array(values, dtype=float)
        for name, values in zip(
            ("case", "time", "pressure_drop", "bottom_force", "wall_force"), columns
        )
    }
    run.monitors["phase"] = np.full(len(rows), "flow")
    return run


class Onset(unittest.TestCase):
    """Of a bed whose onset is known."""

    def test_line_of_the_fixed_bed_meets_the_weight(self):
        for buoyancy in (0.0, 0.01):
            run = a_run((0.2, 0.3, 0.4, 0.9), buoyancy)
            self.assertAlmostEqual(fixed_bed(fluidisation.onset(run)), (WEIGHT - buoyancy) / AREA, places=6)

    def test_plateau(self):
        lifted = fluidisation.plateau(a_run((0.2, 0.9, 1.0)))
        self.assertAlmostEqual(lifted.level, 1.0, places=12)
        self.assertAlmostEqual(lifted.on_bottom, 0.0, places=12)
        self.assertAlmostEqual(lifted.on_wall, 0.01, places=12)
        self.assertAlmostEqual(lifted.seconds, 0.19, places=12)
        self.assertIsNone(fluidisation.plateau(a_run((0.2, 0.3))))


class Scripts(unittest.TestCase):
    """The programs themselves, which the other tests import from."""

    def test_each_tells_how_it_is_called(self):
        for name in ("paper.py", "particles", "report", "validate"):
            done = subprocess.run(
                [sys.executable, SCRIPTS / name, "--help"], capture_output=True, text=True
            )
            self.assertEqual(done.returncode, 0, f"{name}: {done.stderr}")
            self.assertIn("usage", done.stdout)


if __name__ == "__main__":
    unittest.main()
