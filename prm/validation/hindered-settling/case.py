# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A suspension that settles in a closed vessel."""

import math

import numpy as np

from common.force_balance import Suspension, wen_yu
from graupel.report.style import BLUE, GREY, new_figure
from validation_parts.case import Comparison, Run

TITLE = "Hindered settling of glass spheres of 1 mm in a closed vessel of water"
SOURCE = "the force balance of the drag law of Wen & Yu (1966) without a net flux; conservation"

LAW = Suspension(wen_yu, 1e-3, 2500.0, 998.0, 1e-3)
NAME = "suspension"
AREA, HEIGHT = math.pi / 4.0 * 0.012**2, 0.06
# The part of the particles that counts as below the front: the highest few run ahead of the
# mean or lag behind it.
BELOW = 0.95
# Seconds after which the front falls steadily, and until which it is far from the sediment.
FROM, UNTIL = 0.06, 0.25
LIMIT = 0.05


def runs(quick):
    """One; a tenth of the time if quick."""
    return [Run(NAME, "settling.prm", {"Flow/duration": 0.12} if quick else {})]


def front(run):
    """Time since the flow began [s] and height of the front [m] of each set of particles."""
    times = [time for time, _ in run.records("particles")]
    heights = [np.quantile(run.particles(n).points[:, 2], BELOW) for n in range(len(times))]
    return np.array(times) - times[0], np.array(heights)


def front_speed(run):
    """The slope of the front's fall, and its error [m/s]."""
    time, height = front(run)
    rows = (time >= FROM) & (time <= UNTIL)
    (slope, _), covariance = np.polyfit(time[rows], height[rows], 1, cov="unscaled")
    residual = height[rows] - np.polyval(np.polyfit(time[rows], height[rows], 1), time[rows])
    scatter = np.sqrt(np.sum(residual**2) / max(1, np.count_nonzero(rows) - 2))
    return -slope, float(scatter * np.sqrt(covariance[0, 0]))


def void_fraction(run):
    """Of the suspension as it was placed [-]."""
    return 1.0 - run.number("bed", "solid_volume") / (AREA * HEIGHT)


def evaluate(results):
    """Speed of the front, and the ledger."""
    if not results.has(NAME):
        return []
    run = results[NAME]
    speed, error = front_speed(run)
    return [
        Comparison("speed of the front", "m/s", LAW.settling_velocity(void_fraction(run)), speed,
                   error, LIMIT, decimals=4, run=NAME),
        Comparison("momentum that fluid and particles exchange, imbalance", "-", 0.0,
                   run.number("ledger", "max_momentum_imbalance"), limit=1e-10, relative=False,
                   decimals=-1, run=NAME),
    ]  # fmt: skip


def figure(results):
    """Height of the front in time."""
    run = results[NAME]
    picture = new_figure()
    axes = picture.subplots()
    time, height = front(run)
    axes.plot(time, height * 1e3, "o", color=BLUE, label=f"{BELOW:.0%} of the particles are below")
    law = LAW.settling_velocity(void_fraction(run))
    middle = np.interp(0.5 * (FROM + UNTIL), time, height)
    axes.plot(time, (middle - law * (time - 0.5 * (FROM + UNTIL))) * 1e3, color=GREY, label="law")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("height [mm]")
    axes.legend()
    return picture
