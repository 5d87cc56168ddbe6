# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""One page on several runs: what differs in their parameters, their results side by side, and
their curves in the same figures."""

import math
from html import escape
from pathlib import Path

import numpy as np

from . import page, style, words
from .style import MILLI, PERCENT, column, known, legend_beside, new_figure, velocity_axis

COLOURS = (style.BLUE, style.VERMILLION, style.GREEN, style.PURPLE, style.ORANGE, style.BLACK)
# Parameters that say where and how a run is written, not what it computes.
NOT_COMPARED = ("Output/directory", "Output/report")
# Quantities of the tables of results: key, title, factor, unit, pattern.
RESULTS = (
    ("pressure_drop", "Pressure drop", 1.0, "Pa", ".2f"),
    ("deviation_from_ergun", "Deviation from Ergun's equation", PERCENT, "%", "+.2f"),
    ("bed_height", "Bed height", MILLI, "mm", ".2f"),
    ("mean_void_fraction", "Mean void fraction", 1.0, "-", ".4f"),
    ("bottom_force", "Force on the bottom", 1.0, "N", ".4f"),
)


def names_of(runs):
    """A short name of each run: of its directory, or its path where two are the same."""
    short = [run.directory.resolve().name for run in runs]
    whole = [str(run.directory) for run in runs]
    return whole if len(set(short)) < len(short) else short


def colour_of(number):
    """The colour of a run, by its place in the list."""
    return COLOURS[number % len(COLOURS)]


def differences(runs):
    """The parameters that differ: (path, texts of the runs, None where one has none)."""
    paths = dict.fromkeys(path for run in runs for path in run.parameters)
    rows = [(path, [run.parameters.get(path) for run in runs]) for path in paths]
    return [
        (path, texts)
        for path, texts in rows
        if path not in NOT_COMPARED and any(differ(texts[0], text) for text in texts[1:])
    ]


def differ(first, second):
    """Whether two texts of a parameter mean something else; 1e-2 is 0.01."""
    try:
        return not math.isclose(float(first), float(second), rel_tol=1e-12)
    except (TypeError, ValueError):
        return first != second


def velocity_of(case):
    """By which cases of several runs are the same [m/s]: what was asked for, to four digits."""
    asked = case.get("nominal_velocity")
    velocity = case["superficial_velocity"] if asked is None else asked
    return None if velocity is None else float(f"{velocity:.4g}")


def table(heads, rows):
    """An HTML table whose first column is text; @p heads are HTML."""
    cells = "".join(f"<th{'' if k else ' class=text'}>{head}</th>" for k, head in enumerate(heads))
    lines = [f'<div class="wide"><table><thead><tr>{cells}</tr></thead><tbody>']
    for first, *others in rows:
        rest = "".join(f"<td>{escape(cell)}</td>" for cell in others)
        lines.append(f'<tr><td class="text">{escape(first)}</td>{rest}</tr>')
    return "\n".join([*lines, "</tbody></table></div>"])


def heads_of(runs):
    """The names of the runs with their colours, as HTML."""
    return [
        f'<i class="swatch" style="background:{colour_of(k)}"></i>{escape(name)}'
        for k, name in enumerate(names_of(runs))
    ]


def beds(runs):
    """The runs themselves: versions, beds and cost."""

    def row(title, text_of):
        return [title, *(text_of(run) for run in runs)]

    def number(*path, pattern=".4g", factor=1.0, unit=""):
        return lambda run: words.number(run.number(*path), pattern, factor, unit)

    rows = [
        row("program", lambda run: str(run.get("program", "version") or words.NONE)),
        row("parameter file", lambda run: Path(run.get("program", "parameter_file") or "-").name),
        row("processes", number("program", "mpi_ranks")),
        row("particles", number("bed", "particle_count", pattern=",.0f")),
        row("their diameter", number("bed", "particle_diameter", factor=1e3, unit="mm")),
        row("scale", number("bed", "scale")),
        row("bed height at rest", number("bed", "height", factor=1e3, unit="mm")),
        row("void fraction at rest", number("bed", "mean_void_fraction", pattern=".4f")),
        row("CPU time", lambda run: words.duration(run.number("cost", "cpu_seconds"))),
    ]
    return table(["", *heads_of(runs)], rows)


def results(runs, key, title, factor, unit, pattern):
    """A quantity of all cases: a row a velocity, a column a run, and how far each is from the
    first; "" where no run knows it."""
    found = [{velocity_of(case): case.get(key) for case in run.cases} for run in runs]
    velocities = sorted({v for one in found for v in one if v is not None})
    if all(one.get(v) is None for one in found for v in velocities):
        return ""
    rows = []
    for velocity in velocities:
        values = [one.get(velocity) for one in found]
        cells = [words.number(value, pattern, factor) for value in values]
        for k, value in enumerate(values[1:], start=1):
            if None not in (value, values[0]):
                cells[k] += f" ({distance(values[0], value, unit)})"
        rows.append([words.number(velocity, ".4g", unit="m/s"), *cells])
    return f"<h3>{title} [{unit}]</h3>" + table(["V", *heads_of(runs)], rows)


def distance(first, value, unit):
    """How far a value is from the first: relative, or in points of what is in percent."""
    if unit == "%":
        return words.points(value - first)
    return words.percent(value / first - 1.0, 2) if first else words.NONE


def against_velocity(runs, key, label, factor):
    """A quantity of the cases against the superficial velocity, a curve a run."""
    if not any(known(column(run.cases, key)) for run in runs):
        raise style.NotOfThisRun(f"no case knows its {key}")
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    for k, (run, name) in enumerate(zip(runs, names_of(runs))):
        values = column(run.cases, key) * factor
        if known(values):
            style.plot_cases(axes, run.cases, values, colour_of(k), name)
    velocity_axis(axes)
    axes.set_ylabel(label)
    legend_beside(axes)
    return figure


def curves(runs, of_run, across, along):
    """Curves (x, y) of tables, one a run where it has one."""
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    for k, (run, name) in enumerate(zip(runs, names_of(runs))):
        found = of_run(run)
        if found is not None and known(found[1]):
            axes.plot(*found, color=colour_of(k), label=name)
    if not axes.lines:
        raise style.NotOfThisRun("no run has such a table")
    axes.set_xlabel(across)
    axes.set_ylabel(along)
    legend_beside(axes)
    return figure


def last_profile(name, factor=1.0):
    """A column of profiles-NN.csv of the last case against the height."""

    def of_run(run):
        if not run.profiles:
            return None
        rows = run.profiles[max(run.profiles)]
        return rows["z"] * MILLI, rows[name] * factor

    return of_run


def settled(run):
    """Void fraction of the settled bed from the wall inwards."""
    rows, diameter = run.bed.get("bed-radial"), run.number("bed", "particle_diameter")
    if rows is None or not diameter:
        return None
    return rows["wall_distance"] / diameter, rows["void_fraction"]


def over_time(name):
    """A monitor since the flow began."""

    def of_run(run):
        if run.monitors is None:
            return None
        flow = run.monitors["phase"] == "flow"
        if not np.any(flow):
            return None
        time = run.monitors["time"][flow]
        return time - time[0], run.monitors[name][flow]

    return of_run


FIGURES = {
    "pressure-drop": (
        "Pressure drop against superficial velocity. Hollow: the bed has lifted.",
        lambda runs: against_velocity(runs, "pressure_drop", "pressure drop [Pa]", 1.0),
    ),
    "deviation": (
        "Deviation from Ergun's equation for the bed of each run.",
        lambda runs: against_velocity(
            runs, "deviation_from_ergun", "deviation from Ergun [%]", PERCENT
        ),
    ),
    "bed-height": (
        "Bed height.",
        lambda runs: against_velocity(runs, "bed_height", "bed height [mm]", MILLI),
    ),
    "pressure-profile": (
        "Pressure along the axis, of the last case of each run.",
        lambda runs: curves(
            runs, last_profile("pressure"), "height over the bottom z [mm]", "pressure [Pa]"
        ),
    ),
    "void-fraction-profile": (
        "Void fraction along the axis, of the last case of each run.",
        lambda runs: curves(
            runs, last_profile("void_fraction"), "height over the bottom z [mm]",
            "void fraction [-]",
        ),
    ),
    "bed-radial": (
        "Void fraction of the settled bed from the wall inwards.",
        lambda runs: curves(
            runs, settled, "distance from the wall over the particle diameter [-]",
            "void fraction [-]",
        ),
    ),
    "pressure-drop-over-time": (
        "Pressure drop since the flow began.",
        lambda runs: curves(
            runs, over_time("pressure_drop"), "simulated time of the flow [s]", "pressure drop [Pa]"
        ),
    ),
}  # fmt: skip


def comparison(runs):
    """The whole page as HTML."""
    title = "Graupel: comparison of " + ", ".join(names_of(runs))
    body = [f"<h1>{escape(title)}</h1>", f'<p class="under">{len(runs)} runs</p>']
    for run in runs:
        body += page.notices_of(run)
    body += ["<h2>Runs</h2>", beds(runs), "<h2>Parameters that differ</h2>"]
    rows = [
        [path, *(words.NONE if text is None else text for text in texts)]
        for path, texts in differences(runs)
    ]
    body.append(table(["", *heads_of(runs)], rows) if rows else "<p>None.</p>")
    body.append("<h2>Results</h2>")
    body.append('<p class="note">In brackets: over the first run, less 1; of percentages, less'
                " that of the first.</p>")  # fmt: skip
    body += [results(runs, *quantity) for quantity in RESULTS]
    body.append("<h2>Curves</h2>")
    for name, (caption, make) in FIGURES.items():
        try:
            shown = style.render(make(runs), name, None)
        except style.NotOfThisRun:
            continue
        body.append(page.figure(name, shown, caption))
    return page.whole(escape(title), body)
