# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Numbers that compare runs of scripts/reproduce-paper with each other."""

import numpy as np

from graupel.report import reference
from common.fluidisation import fixed_cases, later_rows


def drop_at(run, velocity):
    """Pressure drop [Pa] at a superficial velocity between two fixed-bed cases, by a line in
    the ratio to Ergun's value of the resting bed, which hardly changes."""
    fixed = fixed_cases(run)
    v = np.array([case["superficial_velocity"] for case in fixed])
    ratio = np.array([case["pressure_drop"] for case in fixed]) / reference.ergun_curve(run, v)
    return float(np.interp(velocity, v, ratio)) * float(reference.ergun_curve(run, velocity))


def over(reference_run, run):
    """Pressure drop of the fixed-bed cases of @p run over that of another run at the same
    velocities, less 1 [-]."""
    return [
        case["pressure_drop"] / drop_at(reference_run, case["superficial_velocity"]) - 1.0
        for case in fixed_cases(run)
    ]


def rise(run, case):
    """How much higher the bed is than at rest, median over the second half of the case [m]:
    at a single moment a slugging bed may have come apart."""
    height = run.monitors["bed_height"][later_rows(run, case)]
    return float(np.median(height)) - run.number("bed", "height")
