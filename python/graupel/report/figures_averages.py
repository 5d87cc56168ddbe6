# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Figures of a bed that moves: its bubbles, and its means over time."""

import numpy as np
from matplotlib.colors import Normalize

from ..run import grid_of, of_grids
from .style import BLACK, BLUE, GREY, MILLI, VERMILLION
from .style import NotOfThisRun, colour_of_each, known, legend_beside, new_figure

from .figures_inside import draw_field, panels, void_fraction_range
from .figures_run import thinned

MOST_SNAPSHOTS = 8
# Quantities of a line's panels: (label, [(column, rms, legend, colour, is a void fraction)]).
LINE_PANELS = (
    (
        "solid fraction [-]",
        (
            ("solid_fraction", "solid_fraction_rms", "spheres", BLUE, False),
            ("void_fraction", None, "mesh", VERMILLION, True),
        ),
    ),
    (
        "velocity z [m/s]",
        (("velocity_z", "velocity_rms_z", "particles", BLUE, False),),
    ),
    ("flux z [m/s]", (("flux_z", None, "fluid", VERMILLION, False),)),
)


def averages_of(run, stem):
    """The tables of a stem, of the last case first."""
    tables = run.averages.get(stem)
    if not tables:
        raise NotOfThisRun("there are no averages")
    return sorted(tables.items(), reverse=True)


def lines(run, paper):
    """Means along each line, of the last case."""
    number, table = averages_of(run, "averages-lines")[0]
    grids = of_grids(table)
    figure = new_figure(height=0.6 + 2.0 * len(grids))
    rows = np.atleast_2d(figure.subplots(len(grids), len(LINE_PANELS), sharex="row", squeeze=False))
    for row, (name, grid) in zip(rows, grids.items()):
        for axes, (label, curves) in zip(row, LINE_PANELS):
            draw_line(axes, grid, curves)
            if not axes.lines:
                middle = {"ha": "center", "transform": axes.transAxes, "color": GREY}
                axes.text(0.5, 0.5, "nothing there", **middle)
                axes.set_yticks([])
            axes.set_ylabel(label, fontsize=8)
            axes.tick_params(labelsize=7.5)
            axes.set_xlabel(f"along {name} [mm]", fontsize=8)
    legend_beside(rows[0, -1], rows[0, 0], fontsize=7.5)
    return figure


def draw_line(axes, grid, curves):
    """Curves over a line; a band is their rms."""
    place = grid["along"] * MILLI
    for column, rms, legend, colour, is_void in curves:
        if not known(grid.get(column)):
            continue
        values = 1.0 - grid[column] if is_void else grid[column]
        axes.plot(place, values, color=colour, label=legend, marker=".", markersize=3)
        if rms is not None and known(grid.get(rms)):
            axes.fill_between(
                place, values - grid[rms], values + grid[rms], color=colour, alpha=0.15, linewidth=0
            )


def planes(run, paper):
    """Mean solid fraction over each plane, of the last case, and how the solid moves."""
    number, table = averages_of(run, "averages-planes")[0]
    grids = of_grids(table)
    figure = new_figure(width=max(3.2, 2.6 * len(grids)), height=4.6)
    row = np.atleast_1d(figure.subplots(1, len(grids)))
    for axes, (name, grid) in zip(row, grids.items()):
        one, at_one = np.unique(grid["along"], return_inverse=True)
        other, at_other = np.unique(grid["across"], return_inverse=True)
        if len(one) < 2 or len(other) < 2:
            raise NotOfThisRun("a plane needs two bins along both sides to be drawn")
        values = np.full((len(other), len(one)), np.nan)
        values[at_other, at_one] = grid["solid_fraction"]
        image = draw_field(axes, one * MILLI, other * MILLI, values, "viridis", None)
        draw_arrows(axes, grid)
        axes.set_title(f"{name}, case {number}", fontsize=8)
        axes.set_xlabel("along [mm]", fontsize=8)
        image.set_label("solid fraction [-]")
        bar = figure.colorbar(image, ax=axes, shrink=0.75, label="solid fraction [-]")
        bar.outline.set_visible(False)
    row[0].set_ylabel("across [mm]")
    return figure


def draw_arrows(axes, grid):
    """Arrows of the solid flux in the plane, whose sides lie along x, y or z; else none."""
    along, across = (side_of(grid, name) for name in ("along", "across"))
    if along is None or across is None:
        return
    flux = [grid[f"solid_flux_{direction}"] for direction in (along, across)]
    if known(flux[0]):
        axes.quiver(
            grid["along"] * MILLI, grid["across"] * MILLI, *flux, color="white", width=5e-3
        )


def side_of(grid, name):
    """The direction that grows as a side does."""
    for direction in "xyz":
        if np.allclose(grid[direction] - grid[direction][0], grid[name] - grid[name][0]):
            return direction
    return None


def midplane(run, paper):
    """Mean void fraction on the plane y = 0."""
    tables = run.averages.get("averages-midplane")
    if not tables:
        raise NotOfThisRun("there are no averages")
    return panels(
        run, tables, "void_fraction", "viridis", void_fraction_range, "mean void fraction [-]"
    )


def spectra(run, paper):
    """Power by frequency, of the last case: a curve a quantity, over its whole power."""
    number, table = averages_of(run, "spectra")[0]
    names = [name for name in table if name != "frequency" and known(table[name])]
    names = [name for name in names if np.nansum(table[name]) > 0.0]
    if not names:
        raise NotOfThisRun("nothing swings")
    figure = new_figure(height=3.6)
    axes = figure.subplots()
    step = table["frequency"][0]
    for colour, name in zip(colour_of_each(len(names)), names):
        density = table[name] / (np.nansum(table[name]) * step)
        axes.loglog(table["frequency"], density, color=colour, linewidth=1.1, label=name)
    axes.set_xlabel("frequency [Hz]")
    axes.set_ylabel("power over the whole [1/Hz]")
    legend_beside(axes, fontsize=7.5)
    return figure


def bubbles(run, paper):
    """Void fraction on the plane y = 0 at some moments of the last case that has any, and the
    pressure drop over time."""
    table = run.snapshots
    if table is None or not known(table["case"]):
        raise NotOfThisRun("there are no snapshots")
    number = np.nanmax(table["case"])
    moments = np.unique(table["time"][table["case"] == number])
    shown = np.linspace(0, len(moments) - 1, min(len(moments), MOST_SNAPSHOTS))
    moments = moments[shown.astype(int)]
    figure = new_figure(height=6.0)
    upper, lower = figure.subfigures(2, 1, height_ratios=(2.2, 1.0))
    row = np.atleast_1d(upper.subplots(1, len(moments), sharey=True))
    grids = []
    for moment in moments:
        chosen = (table["time"] == moment) & (table["case"] == number)
        grids.append(grid_of({key: table[key][chosen] for key in table}, "void_fraction"))
    # Bubbles are what matters, so the colours end at clear fluid.
    lowest = min(np.nanmin(values) for *_, values in grids)
    norm = Normalize(np.floor(lowest * 20.0) / 20.0, 1.0)
    for axes, moment, (x, z, values) in zip(row, moments, grids):
        image = draw_field(axes, x * MILLI, z * MILLI, values, "viridis", norm)
        axes.set_title(f"{moment:.3f} s", fontsize=7.5)
        image.set_label("void fraction [-]")
    row[0].set_ylabel("z [mm]")
    bar = upper.colorbar(image, ax=list(row), shrink=0.75, label="void fraction [-]")
    bar.outline.set_visible(False)
    draw_pressure(lower.subplots(), run, number, moments)
    return figure


def draw_pressure(axes, run, number, moments):
    """The pressure drop of a case over time, and when the snapshots were taken."""
    axes.set_xlabel("simulated time [s]")
    axes.set_ylabel("drop [Pa]")
    for moment in moments:
        axes.axvline(moment, color=GREY, linewidth=0.8, linestyle=":")
    if run.monitors is None:
        return
    of_case = run.monitors["case"] == number
    if known(run.monitors["pressure_drop"][of_case]):
        time, drop = thinned(
            run.monitors["time"][of_case], run.monitors["pressure_drop"][of_case]
        )
        axes.plot(time, drop, color=BLACK, linewidth=0.9)
