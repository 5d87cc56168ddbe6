# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Figures over time of what not every run has: forces on walls, feeds, open ends, probes."""

import numpy as np

from .style import NotOfThisRun, colour_of_each, known, legend_beside, new_figure

from .figures_run import shade_stretches, thinned

# Quantity of a probe's column NAME_QUANTITY, and the label of its panel.
PROBED = {
    "pressure": "pressure [Pa]",
    "void_fraction": "void fraction [-]",
    "velocity_x": "velocity x [m/s]",
    "velocity_y": "velocity y [m/s]",
    "velocity_z": "velocity z [m/s]",
}
NUMBERS = {
    "particles": "in the vessel",
    "fed_particles": "fed so far",
    "departed_particles": "left so far",
}
PANEL_HEIGHT = 1.8


def draw(table, panels, shade=True):
    """Panels [(label, [(column, legend)])] over the time of a table, one below the other."""
    figure = new_figure(height=0.8 + PANEL_HEIGHT * len(panels))
    rows = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True))
    for axes, (label, curves) in zip(rows, panels):
        for colour, (name, legend) in zip(colour_of_each(len(curves)), curves):
            if known(table[name]):
                moment, values = thinned(table["time"], table[name])
                axes.plot(moment, values, color=colour, linewidth=1.1, label=legend)
        axes.set_ylabel(label)
        legend_beside(axes, fontsize=8)
    if shade:
        shade_stretches(rows, table)
    rows[-1].set_xlabel("simulated time [s]")
    rows[-1].margins(x=0.01)
    return figure


def known_columns(table, names):
    """Those of the names of which the table has a number and a time."""
    if table is None or not known(table["time"]):
        return []
    return [name for name in names if known(table.get(name))]


def wall_forces(run, paper):
    """Vertical forces of particles and fluid on each wall, those that are never zero."""
    if not run.wall_forces:
        raise NotOfThisRun("there are no forces on walls")
    table, panels = dict(run.wall_forces), []
    for source in ("particles", "fluid"):
        names = [name for name in table if name.startswith(f"{source}_on_") and name.endswith("_z")]
        names = [name for name in known_columns(table, names) if np.nanmax(np.abs(table[name])) > 0]
        curves = [(name, name[len(source) + 4 : -2]) for name in names]
        if curves:
            panels.append((f"{source} on walls\ndownwards [N]", curves))
        table.update({name: -table[name] for name in names})
    if not panels:
        raise NotOfThisRun("no wall bears anything")
    return draw(table, panels, shade=False)


def particle_number(run, paper):
    """Particles in the vessel, fed and gone, where their number changes but by filling."""
    names = known_columns(run.monitors, NUMBERS)
    filled = run.monitors["phase"] != "fill" if names else []

    def changes(name):
        values = run.monitors[name][filled]
        return known(values) and np.nanmin(values) < np.nanmax(values)

    if not any(changes(name) for name in names):
        raise NotOfThisRun("the number of particles does not change")
    return draw(run.monitors, [("particles [-]", [(name, NUMBERS[name]) for name in names])])


def probes(run, paper):
    """What the probes saw: a panel a quantity, a curve a probe."""
    names = known_columns(run.probes, [name for name in run.probes or {} if name != "time"])
    if not names:
        raise NotOfThisRun("there are no probes")
    panels = []
    for quantity, label in PROBED.items():
        curves = [
            (name, name[: -len(quantity) - 1]) for name in names if name.endswith(f"_{quantity}")
        ]
        if curves:
            panels.append((label, curves))
    shown = {name for _, curves in panels for name, _ in curves}
    panels += [(name, [(name, name)]) for name in names if name not in shown]
    return draw(run.probes, panels, shade=False)
