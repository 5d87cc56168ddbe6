"""The paper's column beyond onset: mean drop against weight."""

import numpy as np

from common.fluidisation import later_rows, supported_drop
from common.statistics import at_equal_steps, mean_with_error
from graupel.report.style import BLUE, GREY, new_figure
from validation_parts.case import Comparison, Run

TITLE = "The paper's column at 1.5 and 2 times the onset of fluidisation"
SOURCE = (
    "weight less buoyancy over the cross-section; with it goes what friction at the wall adds, as"
    " slugs rub along it in so narrow a tube, which the sum of both must balance"
)

VELOCITIES = (0.815, 1.087)
LIMIT = 0.01
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
}


def runs(quick):
    """The variants, all of many minutes; a moment of the first on few cells if quick."""
    if quick:
        short = {"Flow/superficial velocities": 0.815, "Flow/duration": 0.1, "Filling/count": 300,
                 "Settling/target void fraction": 0}  # fmt: skip
        return [Run("scale-2", "gas-bed.prm", short)]
    return [Run(name, "gas-bed.prm", values, is_long=True) for name, values in VARIANTS.items()]


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


def evaluate(results):
    """The mean drop, with what the walls bear beside it, and the rms."""
    rows = []
    for name, run, case in cases(results):
        weight = supported_drop(run)
        drop = series(run, case, "pressure_drop")
        mean, error = mean_with_error(drop)
        friction = series(run, case, "support_force") / case["weight"] * weight
        balance, of_balance = mean_with_error(drop + friction)
        where = f"{name}, {case['superficial_velocity']:.2f} m/s"
        rows += [
            Comparison(f"mean drop, {where}", "Pa", weight, mean, error, LIMIT, decimals=1,
                       run=name),
            Comparison(f"mean drop and friction at the walls, {where}", "Pa", weight, balance,
                       of_balance, LIMIT, decimals=1, run=name),
            Comparison(f"rms of the drop over the weight, {where}", "-", 0.0,
                       float(np.std(drop)) / weight, relative=False, decimals=3, run=name),
        ]  # fmt: skip
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
