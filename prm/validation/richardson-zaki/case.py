# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Expansion of beds of steel spheres in water, Richardson & Zaki (1954)."""

import math

import numpy as np

from common.fluidisation import later_rows
from common.force_balance import Suspension, rong
from common.statistics import at_equal_steps, mean_with_error
from graupel.report.style import BLUE, GREEN, GREY, VERMILLION, new_figure
from validation_parts.case import Comparison, Run, measured

TITLE = "Steel spheres of 3.175 mm in water: void fraction of the fluidised bed"
SOURCE = (
    "the force balance of the drag law of Rong et al. (2013), doi:10.1016/j.ces.2013.05.036;"
    " measured V = V_i eps^n by Richardson & Zaki (1954), reprinted as"
    " doi:10.1016/S0263-8762(97)80006-8, with a scatter of about 10 % in V"
)

TUBES = {"38": (0.0381, 2000), "62": (0.061976, 5300)}
VELOCITIES = (0.10, 0.15, 0.20, 0.25, 0.30, 0.35)
SCALES = (1, 2, 3)
COLOURS = {1: BLUE, 2: GREEN, 3: VERMILLION}
LIMIT = 0.02
BED = Suspension(rong, 3.175e-3, 7730.0, 1000.0, 1e-3)


def name_of(tube, scale):
    """The run's name."""
    return f"tube-{tube}-scale-{scale}"


def runs(quick):
    """Both tubes at each scale; one velocity for a moment if quick."""
    found = []
    for tube, (diameter, count) in TUBES.items():
        for scale in SCALES:
            values = {
                "Geometry/diameter": diameter,
                "Particles/scale": scale,
                "Filling/count": round(count / scale**3),
            }
            found.append(Run(name_of(tube, scale), "bearings.prm", values, is_long=True))
    if quick:
        short = {"Flow/superficial velocities": 0.15, "Flow/duration": 0.3}
        last = found[SCALES.index(3)]
        return [Run(last.name, last.file, {**last.values, **short})]
    return found


def void_fraction(run, case, diameter):
    """By twice the height of the center of mass over the second half of the case, or by the
    expanded height where that is not told; with its error."""
    rows = later_rows(run, case)
    whole = run.monitors.get("center_of_mass")
    height = run.monitors["expanded_height"] if whole is None else 2.0 * whole
    series = at_equal_steps(run.monitors["time"][rows], height[rows])
    solid_height = run.number("bed", "solid_volume") / (math.pi / 4.0 * diameter**2)
    mean, error = mean_with_error(series)
    return 1.0 - solid_height / mean, solid_height / mean**2 * error


def points(results):
    """Tube, scale, velocity, void fraction and its error of all cases."""
    for tube, (diameter, _) in TUBES.items():
        for scale in SCALES:
            if results.has(name_of(tube, scale)):
                run = results[name_of(tube, scale)]
                for case in run.cases:
                    velocity = case["superficial_velocity"]
                    yield tube, scale, velocity, *void_fraction(run, case, diameter)


def of_laboratory(tube, velocity):
    """The measured void fraction."""
    row = min(measured("richardson-zaki"), key=lambda r: abs(r["column_D_m"] - TUBES[tube][0]))
    return (velocity / row["V_i_m_s"]) ** (1.0 / row["n"])


def evaluate(results):
    """Against the law's balance; the measurement is shown."""
    rows = []
    for tube, scale, velocity, void, error in points(results):
        where = f"{tube} mm, scale {scale}, {velocity:.2f} m/s"
        rows += [
            Comparison(f"void fraction, {where}, law", "-", BED.void_fraction(velocity), void, error,
                       LIMIT, decimals=4, run=name_of(tube, scale)),
            Comparison(f"void fraction, {where}, measured", "-", of_laboratory(tube, velocity), void,
                       error, decimals=4, run=name_of(tube, scale)),
        ]  # fmt: skip
    return rows


def figure(results):
    """Void fraction against velocity."""
    picture = new_figure()
    axes = picture.subplots(1, 2, sharey=True)
    velocities = np.linspace(VELOCITIES[0], VELOCITIES[-1], 50)
    for part, tube in zip(axes, TUBES):
        part.plot(velocities, [BED.void_fraction(v) for v in velocities], color=GREY, label="law")
        part.plot(velocities, [of_laboratory(tube, v) for v in velocities], ":", label="measured")
        for own, scale, velocity, void, error in points(results):
            if own == tube:
                part.errorbar(velocity, void, error, fmt="o", color=COLOURS[scale])
        part.set_title(f"tube of {tube} mm; blue, green, red: scale 1, 2, 3")
        part.set_xlabel("superficial velocity [m/s]")
    axes[0].set_ylabel("void fraction [-]")
    axes[0].legend()
    return picture
