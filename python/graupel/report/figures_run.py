# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Figures of the run itself: the monitors over time, and where the time went."""

import numpy as np

from .style import (
    BLUE,
    GREEN,
    GREY,
    MILLI,
    ORANGE,
    PURPLE,
    VERMILLION,
    NothingToShow,
    NotOfThisRun,
    known,
    legend_beside,
    new_figure,
)

# More rows than this are drawn as the range of each bin: no line has more
# points on paper, and the file stays small.
MOST_ROWS = 3000

SECTIONS = {
    "contact": "contacts",
    "neighbor": "neighbour lists",
    "halo": "halo exchange",
    "void_fraction": "void fraction",
    "exchange": "momentum exchange",
    "fluid": "fluid solver",
    "mesh": "mesh",
    "output": "output",
}


def thinned(time, values):
    """The curve with every bin of rows replaced by its least and its largest value."""
    if len(time) <= MOST_ROWS:
        return time, values
    starts = np.unique(np.linspace(0, len(time), MOST_ROWS // 2, endpoint=False).astype(int))
    low = np.fmin.reduceat(values, starts)
    high = np.fmax.reduceat(values, starts)
    return np.repeat(time[starts], 2), np.column_stack((low, high)).ravel()


def stretches(table):
    """Runs of rows with the same phase and case: (label, first time, last time)."""
    case = np.nan_to_num(table["case"], nan=0.0).astype(int)
    change = (table["phase"][1:] != table["phase"][:-1]) | (case[1:] != case[:-1])
    starts = np.concatenate(([0], np.flatnonzero(change) + 1))
    ends = np.append(starts[1:], len(case)) - 1
    found = []
    for start, end in zip(starts, ends):
        phase = str(table["phase"][start])
        label = str(case[start]) if phase == "flow" else phase
        found.append((label, table["time"][start], table["time"][end]))
    return found


def shade_stretches(rows, table):
    """Marks phases and cases: alternate shading, and a name over the top panel."""
    total = np.nanmax(table["time"]) - np.nanmin(table["time"])
    for index, (label, start, end) in enumerate(stretches(table)):
        for axes in rows:
            if index % 2:
                axes.axvspan(start, end, color="#F1F3F5", linewidth=0)
        share = (end - start) / total if total > 0.0 else 1.0
        if share > 0.015:
            rows[0].annotate(
                label,
                (0.5 * (start + end), 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(0, 3),
                textcoords="offset points",
                ha="center",
                rotation=0 if share > 0.013 * len(label) else 90,
                fontsize=7.5,
                color="#555555",
            )


PANELS = (
    ("$V_s$ [m/s]", 1.0, False, (("superficial_velocity", BLUE, None),)),
    ("pressure\ndrop [Pa]", 1.0, False, (("pressure_drop", BLUE, None),)),
    ("bed height\n[mm]", MILLI, False, (("bed_height", BLUE, None),)),
    (
        "force [N]",
        1.0,
        False,
        (
            ("bottom_force", BLUE, "bottom"),
            ("wall_force", ORANGE, "wall"),
            ("fluid_force", GREEN, "fluid"),
        ),
    ),
    ("maximum\nspeed [m/s]", 1.0, True, (("maximum_speed", BLUE, None),)),
    ("kinetic energy\na particle [J]", 1.0, True, (("kinetic_energy_per_particle", BLUE, None),)),
    (
        "relative\nimbalance [-]",
        1.0,
        True,
        (
            ("mass_imbalance", BLUE, "mass"),
            ("momentum_imbalance", VERMILLION, "momentum"),
            ("solid_volume_error", PURPLE, "solid volume"),
        ),
    ),
    ("linear\niterations [-]", 1.0, False, (("linear_iterations", BLUE, None),)),
)


def draw_panel(axes, table, panel):
    """One quantity, or several of the same unit, over time."""
    label, factor, logarithmic, curves = panel
    for name, colour, legend in curves:
        values = np.abs(table[name]) if logarithmic else table[name] * factor
        if logarithmic:
            values = np.where(values > 0.0, values, np.nan)
        if known(values):
            axes.plot(*thinned(table["time"], values), color=colour, linewidth=0.9, label=legend)
    if logarithmic and axes.lines:
        axes.set_yscale("log")
    axes.set_ylabel(label, fontsize=8)
    axes.tick_params(labelsize=7.5)
    legend_beside(axes, fontsize=8)


def monitors(run, paper):
    """The monitors of every fluid step over time."""
    if run.monitors is None and not run.has_flow():
        raise NotOfThisRun("there is no flow")
    if run.monitors is None:
        raise NothingToShow("monitors.csv was not found, or holds no rows")
    if not known(run.monitors["time"]):
        raise NothingToShow("monitors.csv holds no times")
    figure = new_figure(height=8.8)
    rows = figure.subplots(len(PANELS), 1, sharex=True)
    for axes, panel in zip(rows, PANELS):
        draw_panel(axes, run.monitors, panel)
    shade_stretches(rows, run.monitors)
    rows[-1].set_xlabel("simulated time [s]")
    rows[-1].margins(x=0.01)
    figure.align_ylabels(rows)
    return figure


def cost(run, paper):
    """Wall-clock seconds by activity."""
    seconds_in = run.get("cost", "seconds_in")
    if not isinstance(seconds_in, dict):
        raise NothingToShow("summary.json holds no cost.seconds_in")
    spent = {
        SECTIONS.get(key, key): run.number("cost", "seconds_in", key)
        for key in seconds_in
        if run.number("cost", "seconds_in", key) is not None
    }
    if not spent:
        raise NothingToShow("cost.seconds_in of summary.json holds no numbers")
    wall = run.number("cost", "wall_seconds")
    if wall is not None and wall > sum(spent.values()):
        spent["everything else"] = wall - sum(spent.values())
    whole = max(sum(spent.values()), 1e-300)
    items = sorted(spent.items(), key=lambda item: item[1])
    figure = new_figure(height=0.9 + 0.28 * len(items))
    axes = figure.subplots()
    names = [name for name, _ in items]
    seconds = [value for _, value in items]
    colours = [GREY if name == "everything else" else BLUE for name in names]
    bars = axes.barh(names, seconds, color=colours, height=0.62)
    labels = [
        f"{value:,.3g} s, {100 * value / whole:.1f} %"
        if value < 1000
        else f"{value:,.0f} s, {100 * value / whole:.1f} %"
        for value in seconds
    ]
    axes.bar_label(bars, labels=labels, padding=4, fontsize=8)
    axes.margins(x=0.18)
    axes.grid(False, axis="y")
    axes.tick_params(axis="y", length=0, labelcolor="#222222")
    axes.set_xlabel("wall-clock time [s]")
    return figure
