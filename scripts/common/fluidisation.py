# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Onset of fluidisation and the lifted bed, from the cases of a run."""

import math
from dataclasses import dataclass

import numpy as np

from graupel.report import reference

# Fixed-bed cases: the fluid carries less than this part of the weight. Beyond, the bed
# has begun to loosen.
FIXED = 0.86
# The fluid carries the bed: the bottom has less than this part of its weight in the mean.
LEFT_ON_BOTTOM = 0.05
GRAVITY = 9.81


def fixed_cases(run):
    """The cases in which the bed rests."""
    return [case for case in run.cases if case["fluid_force"] < FIXED * case["weight"]]


def supported_drop(run, area=None):
    """Pressure drop [Pa] at which the fluid carries the bed: weight less buoyancy over the
    cross-section, as reference.weight_per_area has it."""
    density = run.number("fluid", "density")
    solid = run.number("bed", "solid_volume")
    weight = run.cases[0]["weight"]
    return reference.weight_per_area(run, area) * (1.0 - density * GRAVITY * solid / weight)


def velocity_of(drop, of_velocity):
    """The superficial velocity [m/s] at which a rising function reaches @p drop."""
    low, high = 0.0, 5.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if of_velocity(middle) < drop else (low, middle)
    return 0.5 * (low + high)


def onset(run, area=None):
    """Onset of fluidisation as it is measured: where the line of the fixed bed, a V + b V^2
    through its cases, meets the drop that carries the bed [m/s]."""
    fixed = fixed_cases(run)
    v = np.array([case["superficial_velocity"] for case in fixed])
    drop = np.array([case["pressure_drop"] for case in fixed])
    a, b = np.linalg.lstsq(np.stack([np.ones_like(v), v], axis=1), drop / v, rcond=None)[0]
    return velocity_of(supported_drop(run, area), lambda velocity: a * velocity + b * velocity**2)


def ergun_onset(run, area=None):
    """Onset by Ergun's equation for the bed at rest [m/s]."""
    return velocity_of(
        supported_drop(run, area), lambda velocity: reference.ergun_curve(run, velocity)
    )


def later_rows(run, case):
    """Which rows of the monitors belong to the second half of a case; the last one does."""
    rows = (run.monitors["case"] == case["number"]) & (run.monitors["phase"] == "flow")
    time = run.monitors["time"]
    return rows & (time >= 0.5 * (time[rows][0] + time[rows][-1]))


@dataclass
class Plateau:
    """A lifted bed, means over the second half of its case, as it rises and falls as slugs.
    What bottom and wall bear of it, the pressure drop does not."""

    level: float  # pressure drop over the one that carries the bed [-]
    on_bottom: float  # part of the weight [-]
    on_wall: float  # part of the weight [-]
    seconds: float  # simulated time of the means [s]


def plateau(run):
    """The fastest case, if the fluid carries the bed in it; None otherwise. Slower cases just
    above onset may leave a layer on the bottom."""
    case = run.cases[-1]
    rows = later_rows(run, case)

    def part(name):
        return float(np.mean(run.monitors[name][rows])) / case["weight"]

    if np.count_nonzero(rows) < 2 or part("bottom_force") > LEFT_ON_BOTTOM:
        return None  # a resting bed has one row
    level = float(np.mean(run.monitors["pressure_drop"][rows])) / supported_drop(run)
    seconds = float(np.ptp(run.monitors["time"][rows]))
    return Plateau(level, part("bottom_force"), part("wall_force"), seconds)
