# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Figures of the settled bed before the flow: packing at the wall, and what carries the weight."""

import numpy as np

from ..run import OF_CYLINDERS
from . import reference
from .style import BLACK, BLUE, GREY, MILLI, ORANGE, VERMILLION, NothingToShow, NotOfThisRun
from .style import legend_beside, new_figure


def table_of(run, name):
    """The table NAME.csv of the run; throws NothingToShow without it."""
    if not run.has_particles():
        raise NotOfThisRun("there are no particles")
    table = run.bed.get(name)
    if table is None and name in OF_CYLINDERS and (run.directory / f"{name}.csv").is_file():
        raise NotOfThisRun("the vessel is not a whole cylinder")
    if table is None:
        raise NothingToShow(f"{name}.csv was not found, or holds no rows")
    return table


def bed_radial(run, paper):
    """Void fraction against the distance from the wall, beside de Klerk's correlation."""
    table = table_of(run, "bed-radial")
    diameter = run.number("bed", "particle_diameter")
    in_diameters = diameter is not None and diameter > 0.0
    distance = table["wall_distance"] / diameter if in_diameters else table["wall_distance"] * MILLI
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    axes.plot(distance, table["void_fraction"], color=BLUE, label="settled bed")
    axes.plot(distance, table["de_klerk"], "--", color=VERMILLION, linewidth=1.2, label="de Klerk")
    unit = "over the particle diameter [-]" if in_diameters else "[mm]"
    axes.set_xlabel(f"distance from the wall {unit}")
    axes.set_ylabel("void fraction [-]")
    axes.set_xlim(left=0.0)
    axes.set_ylim(0.0, 1.0)
    legend_beside(axes)
    return figure


def bed_janssen(run, paper):
    """Stress and loads against the height of the bed."""
    table = table_of(run, "bed-janssen")
    z = table["z"] * MILLI
    figure = new_figure(height=3.8)
    left, right = figure.subplots(1, 2, sharey=True)
    area = reference.cross_section_of_bed(run)
    if area is None:
        raise NothingToShow("nothing stands on any plane of bed-janssen.csv")
    left.plot(table["weight"] / area, z, ":", color=GREY, label="without a wall")
    left.plot(table["stress"], z, color=BLUE, label="load over cross-section")
    friction = table["mobilised_friction"][0]
    known_friction = f", $\\mu K$ = {friction:.3f}" if np.isfinite(friction) else ""
    left.plot(
        table["janssen_stress"],
        z,
        "--",
        color=VERMILLION,
        linewidth=1.2,
        label=f"Janssen{known_friction}".replace("-", "\u2212"),
    )
    left.set_xlabel("vertical stress [Pa]")
    left.set_ylabel("height over the bottom z [mm]")
    right.plot(table["weight"], z, ":", color=GREY, label="weight above")
    right.plot(table["load"], z, color=BLUE, label="through the plane")
    right.plot(table["wall_load"], z, color=ORANGE, label="by the wall above")
    right.plot(
        (table["load"] + table["wall_load"])[::8],
        z[::8],
        "x",
        color=BLACK,
        markersize=4,
        label="both",
    )
    right.set_xlabel("vertical force [N]")
    for axes in (left, right):
        axes.set_ylim(bottom=0.0)
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, fontsize=8)
    return figure
