# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The paper's column beyond onset: mean drop against weight."""

import numpy as np

from common.fluidisation import later_rows, supported_drop
from common.statistics import (
    at_equal_steps,
    crossings_with_error,
    mean_with_error,
    rms_with_error,
)
from graupel.report.style import BLUE, GREY, new_figure
from validation_parts.case import Comparison, Run

TITLE = "The paper's column at 1.5 and 2 times the onset of fluidisation"
SOURCE = (
    "weight less buoyancy over the cross-section; with it goes what friction at the wall adds, as"
    " slugs rub along it in so narrow a tube, which the sum of both must balance; what a variant"
    " shows is expected of the others"
)

VELOCITIES = (0.815, 1.087)
LIMIT = 0.01
# Of the difference of two variants, in its own standard errors: 1 in 370 is beyond by chance.
LIMIT_OF_ERRORS = 3.0
# Name and what differs from gas-bed.prm.
VARIANTS = {
    "scale-2": {},
    "step-2.5ms": {"Flow/time step": 2.5e-3},
    "step-20ms": {"Flow/time step": 2e-2},
    "cells-1.6mm": {"Mesh/cell size": 1.6e-3, "Mesh/cell height": 1.6e-3},
    "scale-1": {
        "Particles/scale": 1,
        "Filling/count": 21000,
        "Coupling/filter length": 0.96e-3,
        "Settling/target void fraction": 0.39,
    },
    "2-ranks": {},
}
# Of MPI, where they are told.
RANKS = {"scale-2": 1, "2-ranks": 2}


def runs(quick):
    """The variants, all of many minutes; a moment of the first on few cells if quick."""
    if quick:
        short = {"Flow/superficial velocities": 0.815, "Flow/duration": 0.1, "Filling/count": 300,
                 "Settling/target void fraction": 0}  # fmt: skip
        return [Run("scale-2", "gas-bed.prm", short)]
    return [
        Run(name, "gas-bed.prm", values, is_long=True, ranks=RANKS.get(name))
        for name, values in VARIANTS.items()
    ]


def series(run, case, name):
    """A monitor over the second half of a case, at equal steps."""
    rows = later_rows(run, case)
    return at_equal_steps(run.monitors["time"][rows], run.monitors[name][rows])


def cases(results):
    """Name, run and case of all that there is."""
    for name in VARIANTS:
        if results.has(name):
            for case in results[name].cases:
                yield name, results[name], case


def statistics(run, case):
    """Quantity, unit, mean and standard error of what is expected to be the same in all."""
    weight = supported_drop(run)
    drop = series(run, case, "pressure_drop") / weight
    time = series(run, case, "time")
    return (
        ("mean of the drop over the weight", "-", *mean_with_error(drop)),
        ("rms of the drop over the weight", "-", *rms_with_error(drop)),
        ("rises of the drop through its mean", "Hz", *crossings_with_error(time, drop)),
        ("height of the center of mass", "mm",
         *mean_with_error(1e3 * series(run, case, "center_of_mass"))),
    )  # fmt: skip


def against_weight(name, run, case):
    """The mean drop, and with it what the walls bear."""
    weight = supported_drop(run)
    drop = series(run, case, "pressure_drop")
    friction = series(run, case, "support_force") / case["weight"] * weight
    return [
        Comparison(f"{what}, {name}, {case['superficial_velocity']:.2f} m/s", "Pa", weight,
                   *mean_with_error(values), LIMIT, decimals=1, run=name)
        for what, values in (("mean drop", drop),
                             ("mean drop and friction at the walls", drop + friction))
    ]  # fmt: skip


def evaluate(results):
    """Each by itself, and the variants against the first of them."""
    rows, first = [], {}
    for name, run, case in cases(results):
        rows += against_weight(name, run, case)
        velocity = f"{case['superficial_velocity']:.2f} m/s"
        for quantity, unit, mean, error in statistics(run, case):
            key = quantity, velocity
            expected, of_expected = first.setdefault(key, (mean, error))
            is_other = name != next(iter(VARIANTS))
            rows.append(Comparison(
                f"{quantity}, {name}, {velocity}", unit, expected, mean, error,
                LIMIT_OF_ERRORS * np.hypot(error, of_expected) if is_other else None,
                relative=False, run=name,
            ))  # fmt: skip
    return rows


def figure(results):
    """Pressure drop over the one that carries the bed, in time."""
    picture = new_figure()
    axes = picture.subplots()
    for name, run, case in cases(results):
        time = series(run, case, "time")
        drop = series(run, case, "pressure_drop") / supported_drop(run)
        first = name == next(iter(VARIANTS))
        axes.plot(time - time[0], drop, color=BLUE if first else GREY, linewidth=0.8)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("pressure drop over weight [-]")
    return picture
