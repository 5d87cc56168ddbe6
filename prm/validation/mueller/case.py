# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A bubbling bed seen by magnetic resonance: Mueller et al. (2008, 2009)."""

import numpy as np

from graupel.report.style import BLUE, GREEN, GREY, PURPLE, VERMILLION, new_figure
from graupel.run import of_grids, read_table
from validation_parts.case import FOLDER, Comparison, Run, measured

TITLE = "Bubbling bed of 44 mm x 10 mm at 0.6 and 0.9 m/s: void fraction and particle velocity"
SOURCE = (
    "magnetic resonance, Mueller et al., Powder Technology 184 (2008) 241 and Particuology 7"
    " (2009) 297, digitised by others (prm/validation/mueller); the limits are on the rms of the"
    " difference over the points of a line. The error of a profile is the rms of those of its bins, by"
    " blocks of time; meshes and steps agree where they differ by no more than three errors of both"
)

VELOCITIES = (0.6, 0.9)
WIDTH = 0.044
SEEN = "MRI experiment"  # the table has simulations of others too
# Name of the line of bins, its height [m], quantity, and the limit at each velocity where that
# was measured.
LINES = (
    ("void-16", 0.0164, "void_fraction", {0.6: 0.03, 0.9: 0.03}),
    ("void-31", 0.0312, "void_fraction", {0.6: 0.04, 0.9: 0.08}),
    ("velocity-15", 0.015, "particle_velocity_z", {0.9: 0.02}),
    ("velocity-25", 0.025, "particle_velocity_z", {0.9: 0.025}),
    ("velocity-35", 0.035, "particle_velocity_z", {0.9: 0.06}),
)
# The example of the bubbling bed, over the time that was averaged in the measurement.
EXAMPLE = "../../fluidised-bed/bubbling.prm"
WINDOW = {"Flow/duration": 10, "Averages/from": 2, "Averages/to": 10}
# Cells of 2.75 mm x 2.5 mm x 3 mm, of 1.83 mm x 2.5 mm x 2 mm and of 1.375 mm x 2.5 mm x 1.5 mm,
# and half the step on the first.
MESHES = {
    "coarse": {},
    "fine": {"Mesh/file": str(FOLDER / "mueller" / "box-fine.msh"), "Mesh/cell size": 1.9e-3},
    "finer": {"Mesh/file": str(FOLDER / "mueller" / "box-finer.msh"), "Mesh/cell size": 1.4e-3},
    "half-step": {"Flow/time step": 5e-4},
}
# Which of them are compared with each other.
PAIRS = (("fine", "coarse"), ("finer", "fine"), ("half-step", "coarse"))
PROFILES = "averages-lines-01.csv"
KEPT = (PROFILES,)
COLOURS = dict(zip(MESHES, (BLUE, GREEN, VERMILLION, PURPLE)))
LIMIT_OF_ERRORS = 3.0
UNITS = {"void_fraction": "-", "particle_velocity_z": "m/s"}
ERRORS = {"void_fraction": "solid_fraction_error", "particle_velocity_z": "velocity_error_z"}
COLUMNS = ("name", "x", "solid_fraction", "velocity_z", *ERRORS.values())


def name_of(velocity, mesh):
    """The run's name."""
    return f"{velocity}-{mesh}"


def runs(quick):
    """Both velocities on all meshes, a quarter of an hour to a whole one each; a moment if quick."""
    if quick:
        moment = {"Flow/duration": 0.05, "Averages/from": 0.01, "Averages/to": 0.05}
        return [Run(name_of(0.6, "coarse"), EXAMPLE, moment)]
    return [
        Run(name_of(v, mesh), EXAMPLE, {**WINDOW, "Flow/superficial velocities": v, **values}, True)
        for v in VELOCITIES
        for mesh, values in MESHES.items()
    ]


def lines_of(file):
    """Columns of each line of bins in the file of a run, by the name of the line."""
    return of_grids(read_table(file, COLUMNS, []))


def bins(columns):
    """Distance from the side wall [m], void fraction by particle volumes, and velocity [m/s]."""
    return columns["x"] + WIDTH / 2.0, {
        "void_fraction": 1.0 - columns["solid_fraction"],
        "particle_velocity_z": columns["velocity_z"],
    }


def points(velocity, height, quantity):
    """What was measured on a line: place [m] and value."""
    rows = [
        (row["x_m"], row["value"])
        for row in measured("mueller")
        if (row["U_m_per_s"], row["z_m"], row["quantity"]) == (velocity, height, quantity)
        and row["kind"] == SEEN
    ]
    return np.array(rows).T


def rms(values):
    """Over the points that have a value."""
    return float(np.sqrt(np.nanmean(np.square(values))))


def error_of_profile(columns, quantity):
    """rms of the standard errors of the bins."""
    return rms(columns[ERRORS[quantity]])


def difference(columns, velocity, height, quantity):
    """rms over the measured points of ours less the measured."""
    x, values = bins(columns)
    seen = np.isfinite(values[quantity])
    at, value = points(velocity, height, quantity)
    return rms(np.interp(at, x[seen], values[quantity][seen]) - value)


def against_measurement(lines, velocity, mesh):
    """The rms difference of each measured line."""
    return [
        Comparison(f"rms difference, {line}, {velocity} m/s, {mesh} mesh", UNITS[quantity], 0.0,
                   difference(lines[line], velocity, height, quantity),
                   error_of_profile(lines[line], quantity), limits[velocity], relative=False,
                   decimals=4, run=name_of(velocity, mesh))
        for line, height, quantity, limits in LINES
        if velocity in limits
    ]  # fmt: skip


def against_other(profiles, velocity, mesh, other):
    """The rms difference of each line from that of another mesh."""
    rows = []
    for line, _, quantity, _ in LINES:
        both = [profiles[one][line] for one in (mesh, other)]
        ours, its = (bins(columns)[1][quantity] for columns in both)
        error = np.hypot(*(error_of_profile(columns, quantity) for columns in both))
        rows.append(Comparison(
            f"{line}, {velocity} m/s, {mesh} against {other}", UNITS[quantity], 0.0,
            rms(ours - its), error, LIMIT_OF_ERRORS * error, relative=False, decimals=4,
            run=name_of(velocity, mesh),
        ))  # fmt: skip
    return rows


def profiles_of(results, velocity):
    """The lines of the runs of a velocity, by mesh."""
    return {
        mesh: lines_of(results.kept_file(name_of(velocity, mesh), PROFILES))
        for mesh in MESHES
        if results.keeps(name_of(velocity, mesh))
    }


def evaluate(results):
    """Each by itself, and the meshes against each other."""
    rows = []
    for velocity in VELOCITIES:
        profiles = profiles_of(results, velocity)
        for mesh, lines in profiles.items():
            rows += against_measurement(lines, velocity, mesh)
        for mesh, other in PAIRS:
            if mesh in profiles and other in profiles:
                rows += against_other(profiles, velocity, mesh, other)
    return rows


def figure(results):
    """The lines, measured and ours, at the velocities of which there are runs."""
    of_all = {velocity: profiles_of(results, velocity) for velocity in VELOCITIES}
    shown = {velocity: profiles for velocity, profiles in of_all.items() if profiles}
    picture = new_figure(height=3.0 * len(shown))
    parts = picture.subplots(len(shown), len(LINES), squeeze=False)
    for row, (velocity, profiles) in zip(parts, shown.items()):
        for axes, (line, height, quantity, limits) in zip(row, LINES):
            name = "void fraction" if quantity == "void_fraction" else "velocity"
            axes.set_title(f"{name} [{UNITS[quantity]}], {height * 1e3:g} mm, {velocity} m/s",
                           fontsize=5)  # fmt: skip
            axes.tick_params(labelsize=6)
            axes.set_xlabel("from the side wall [mm]", fontsize=6)
            if velocity in limits:
                x, value = points(velocity, height, quantity)
                axes.plot(x * 1e3, value, "o", color=GREY, markersize=2, label="measured")
            for mesh, lines in profiles.items():
                x, values = bins(lines[line])
                axes.plot(x * 1e3, values[quantity], color=COLOURS[mesh], label=mesh)
    parts[0][0].legend(fontsize=5)
    return picture
