# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Onset of fluidisation in shallow beds of five materials, in air and in water."""

from common.fluidisation import ergun_onset, onset
from common.force_balance import Suspension, ergun
from graupel.report.style import BLUE, GREY, new_figure
from validation_parts.case import Comparison, Run

TITLE = "Onset of fluidisation in beds of a dozen diameters"
SOURCE = "Ergun, Chem. Eng. Prog. 48 (1952) 89, at each bed's own void fraction"

AIR = {"Fluid/density": 1.2, "Fluid/viscosity": 1.8e-5}
WATER = {"Fluid/density": 998.0, "Fluid/viscosity": 1e-3}
# Name, diameter [m], density [kg/m^3], fluid.
BEDS = (
    ("glass-in-air", 0.5e-3, 2500.0, AIR),
    ("polystyrene-in-air", 1.5e-3, 1050.0, AIR),
    ("alumina-in-air", 1.0e-3, 3900.0, AIR),
    ("glass-in-water", 2.0e-3, 2500.0, WATER),
    ("steel-in-water", 3.0e-3, 7800.0, WATER),
)
# Parts of the velocity that Ergun has for the guessed void fraction.
GUESS, PARTS = 0.40, (0.4, 0.55, 0.7)
LIMIT = 0.03


def expected(diameter, density, fluid):
    """Ergun's onset at the guessed void fraction [m/s]."""
    bed = Suspension(ergun, diameter, density, fluid["Fluid/density"], fluid["Fluid/viscosity"])
    return bed.superficial_velocity(GUESS)


def values(diameter, density, fluid):
    """Everything in diameters of the particles."""
    at = expected(diameter, density, fluid)
    return {
        **fluid,
        "Particles/diameter": diameter,
        "Particles/density": density,
        "Geometry/diameter": 12.0 * diameter,
        "Geometry/height": 20.0 * diameter,
        "Mesh/cell size": 0.375 * diameter,
        "Flow/superficial velocities": ", ".join(f"{part * at:.6g}" for part in PARTS),
    }


def runs(quick):
    """One a material; the first alone on a coarse mesh if quick."""
    if not quick:
        return [Run(name, "shallow.prm", values(*bed)) for name, *bed in BEDS]
    name, *bed = BEDS[0]
    coarse = {"Filling/count": 300, "Geometry/diameter": 6.0 * bed[0], "Mesh/cell size": 1.5 * bed[0]}
    return [Run(name, "shallow.prm", {**values(*bed), **coarse})]


def evaluate(results):
    """Onset of each bed against Ergun's."""
    return [
        Comparison(f"onset, {name}", "m/s", ergun_onset(results[name]), onset(results[name]),
                   limit=LIMIT, decimals=4, run=name)
        for name, *_ in BEDS
        if results.has(name)
    ]  # fmt: skip


def figure(results):
    """Pressure drop over Ergun's of the fixed beds."""
    picture = new_figure()
    axes = picture.subplots()
    for name, *_ in BEDS:
        if results.has(name):
            run = results[name]
            part = [c["superficial_velocity"] / ergun_onset(run) for c in run.cases]
            drop = [1.0 + c["deviation_from_ergun"] for c in run.cases]
            axes.plot(part, drop, "o-", label=name)
    axes.axhline(1.0, color=GREY)
    axes.axhspan(1.0 - LIMIT, 1.0 + LIMIT, color=BLUE, alpha=0.08)
    axes.set_xlabel("superficial velocity over Ergun's onset [-]")
    axes.set_ylabel("pressure drop over Ergun's [-]")
    axes.legend()
    return picture
