# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What a run is compared with: Ergun's equation, and the paper that it reproduces.

Paper: M. Ricklick, O. Baran, Analytical scaling of DEM particles for efficient
packed-bed simulations (2014); its Table 1 is ricklick-baran-2014-table1.csv beside this file.
"""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

TABLE_1 = Path(__file__).with_name("ricklick-baran-2014-table1.csv")

# Its name in Output/reference.
PAPER = "ricklick-baran-2014"
PAPER_DIAMETER = 1.6e-3
PAPER_VESSEL = 25e-3


@dataclass
class Paper:
    """The paper's findings at one scale; SI units, deviations relative.

    Forces have this project's sign: positive presses on the bottom. The density
    is the one [kg/m^3] at which the bed weighs what Ergun's pressure drop carries
    at the paper's onset; the paper names aluminium, which would lift later.
    """

    scale: int
    band: tuple
    band_in_words: str
    onset_deviation: float
    onset_bottom_force: float
    onset_rise: float
    cpu_hours: str
    density_at_onset: float
    names: list = None
    velocity: np.ndarray = None
    void_fraction: np.ndarray = None
    ergun: np.ndarray = None

    @property
    def onset_velocity(self):
        """Superficial velocity of the case in which the bed lifted [m/s]."""
        return float(self.velocity[-1])


FINDINGS = {
    1: ((-0.02, 0.0), "less than 2 % under Ergun", -0.12, 0.016, 2.2e-3, "36 to 48 h", 1160.0),
    2: ((0.0, 0.06), "less than 6 % over Ergun", None, 0.028, 3e-3, "1.5 to 2 h", 1060.0),
}


def ergun_pressure_drop(velocity, height, void_fraction, diameter, density, viscosity):
    """Pressure drop [Pa] of a packed bed at a superficial velocity [m/s] (the paper's eqs. 6, 7).

    dp / L = (150 (1 - alpha) mu / (rho V_s d) + 1.75) rho V_s^2 (1 - alpha) / (d alpha^3)
    Source: S. Ergun, Chem. Eng. Prog. 48 (1952) 89-94.
    """
    solid = 1.0 - void_fraction
    viscous = 150.0 * viscosity * solid**2 / (diameter**2 * void_fraction**3) * velocity
    inertial = 1.75 * density * solid / (diameter * void_fraction**3) * velocity**2
    return height * (viscous + inertial)


def ergun_curve(run, velocity):
    """Ergun's pressure drop [Pa] for the bed at rest of @p run; None if a value is missing."""
    values = [
        run.number("bed", "height"),
        run.number("bed", "mean_void_fraction"),
        run.number("bed", "original_diameter"),
        run.number("fluid", "density"),
        run.number("fluid", "viscosity"),
    ]
    if any(value is None or value <= 0.0 for value in values):
        return None
    return ergun_pressure_drop(velocity, *values)


def paper_for(run, table=TABLE_1):
    """The paper's findings at the scale of @p run, or None where it is another bed."""
    scale = run.number("bed", "scale")
    original = run.number("bed", "original_diameter")
    vessel = run.number("bed", "vessel_diameter")
    if None in (scale, original, vessel):
        return None
    same_bed = math.isclose(original, PAPER_DIAMETER, rel_tol=1e-3)
    same_vessel = math.isclose(vessel, PAPER_VESSEL, rel_tol=1e-3)
    nearest = round(scale)
    if not (
        same_bed
        and same_vessel
        and nearest in FINDINGS
        and math.isclose(scale, nearest, rel_tol=1e-3)
    ):
        return None
    try:
        with open(table, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        run.notices.append(f"The paper's values cannot be read: {error}.")
        return None
    rows = [row for row in rows if int(row["scale"]) == nearest]
    paper = Paper(nearest, *FINDINGS[nearest])
    paper.names = [row["case"].split("_")[0] for row in rows]
    paper.velocity = np.array([float(row["V_s"]) for row in rows])
    paper.void_fraction = np.array([float(row["alpha"]) for row in rows])
    paper.ergun = np.array([float(row["dp_ergun"]) for row in rows])
    return paper


def chosen_paper(run):
    """The paper's findings if the run names them as its reference (Output/reference)."""
    return paper_for(run) if run.get("reference") == PAPER else None


def cross_section_of_bed(run):
    """The cross-section of the vessel where the settled bed stands [m^2], by the loads and
    stresses of bed-janssen.csv, in whatever vessel; None without them."""
    table = run.bed.get("bed-janssen")
    if table is None:
        return None
    load = np.where(table["load"] > 0.0, table["load"], np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        areas = load / table["stress"]
    return float(np.nanmedian(areas)) if np.any(np.isfinite(areas)) else None


def weight_per_area(run, area=None):
    """Weight of the bed over the cross-section [Pa]; None if unknown. The @p area [m^2] is
    that of the bed if it is not given, or of the cylinder."""
    diameter = run.number("bed", "vessel_diameter")
    weights = [case["weight"] for case in run.cases if case["weight"] is not None]
    if area is None:
        area = cross_section_of_bed(run)
    if area is None and diameter is not None:
        area = math.pi * diameter**2 / 4.0
    return weights[0] / area if area and weights else None


def parts_of_deviation(case):
    """Splits a case's deviation from Ergun; relative, each None if it cannot be known.

    full = predicted + core + outside, with
      predicted  what Ergun summed over the radial void-fraction profile gives,
      core       what the middle half of the bed deviates beyond that,
      outside    full height less middle half.
    """
    full = case["deviation_from_ergun"]
    middle = case["gradient_deviation_from_ergun"]
    predicted = case["wall_channelling_deviation"]

    def difference(a, b):
        return None if a is None or b is None else a - b

    return {
        "full": full,
        "middle": middle,
        "predicted": predicted,
        "core": difference(middle, predicted),
        "outside": difference(full, middle),
    }
