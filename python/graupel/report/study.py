# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The report of a refinement study: its table, and how each quantity converges."""

from html import escape
from pathlib import Path

import numpy as np

from .style import BLACK, BLUE, GREY, PERCENT, VERMILLION, legend_beside, new_figure, render
from ..study import read_study

from . import page

# What a study varies, by the column that changes from level to level.
SIZES = {
    "scale": "scale of the particles [-]",
    "cell_size": "representative cell size [m]",
    "filter_length": "filter length [m]",
    "time_step": "time step [s]",
}
FAILED = "failed"


def by_quantity(rows):
    """The rows of each quantity, from the coarsest level to the finest; those of a study that
    knows no quantity, as every level failed, have the name ""."""
    quantities = {}
    for row in rows:
        quantities.setdefault(row["quantity"], []).append(row)
    return quantities


def computed(rows):
    """The levels that have a value."""
    return [row for row in rows if row["value"] is not None]


def what_varies(rows):
    """The column of sizes that differs between the levels."""
    for key in ("scale", "time_step", "filter_length", "cell_size"):
        if len({row[key] for row in rows if row[key] is not None}) > 1:
            return key
    return "cell_size"


def is_error(rows):
    """Whether the quantity is an error itself: its exact value is 0."""
    return all(row["value"] == row["error_or_change"] for row in computed(rows))


def error_figure(quantity, rows, key):
    """Errors against size, both logarithmic, with the slope of the last order."""
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    size = np.array([row[key] for row in rows])
    error = np.array([row["value"] for row in rows])
    axes.loglog(size, error, "o-", color=BLUE, label=quantity)
    for order, style in ((1, ":"), (2, "--")):
        axes.loglog(
            size, error[-1] * (size / size[-1]) ** order, style, color=GREY, label=f"order {order}"
        )
    axes.set_xlabel(SIZES[key])
    axes.set_ylabel(quantity)
    legend_beside(axes)
    return figure


def value_figure(quantity, rows, key):
    """A quantity against size, with what it is extrapolated to and the error of that."""
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    size = np.array([row[key] for row in rows])
    value = np.array([row["value"] for row in rows])
    axes.plot(size, value, "o-", color=BLUE, label="computed")
    last = rows[-1]
    if key == "scale":
        axes.errorbar(
            size,
            value,
            yerr=[row["standard_error"] or 0.0 for row in rows],
            fmt="none",
            color=BLUE,
        )
        if last["extrapolated"] is not None:
            spread = abs(last["extrapolated"]) * (last["grid_convergence_index"] or 0.0)
            axes.errorbar(
                [1.0],
                [last["extrapolated"]],
                yerr=[spread],
                fmt="D",
                color=VERMILLION,
                capsize=4,
                label="extrapolated to the original particles",
            )
    elif last["extrapolated"] is not None:
        spread = abs(last["value"]) * (last["grid_convergence_index"] or 0.0)
        axes.errorbar(
            [size[-1]], [value[-1]], yerr=[spread], color=BLACK, capsize=4, label="GCI (1.25)"
        )
        axes.plot([0.0], [last["extrapolated"]], "D", color=VERMILLION, label="extrapolated")
    if size.max() / size.min() > 50.0:
        axes.set_xscale("symlog", linthresh=size.min())
    axes.set_xlim(left=-0.02 * size.max() if size.max() / size.min() <= 50.0 else 0.0)
    axes.set_xlabel(SIZES[key])
    axes.set_ylabel(quantity)
    legend_beside(axes)
    return figure


def cell(value, pattern):
    """A number of the table, or a dash."""
    return "–" if value is None else format(value, pattern)


def table(rows, key):
    """The levels of one quantity as HTML."""
    header = "".join(
        f"<th>{name}</th>"
        for name in ("level", "cells", SIZES[key], "value", "error or change", "order", "extrapolated")
        + ("error of that [%]" if key == "scale" else "GCI [%]",)
    )
    lines = []
    for row in rows:
        index = row["grid_convergence_index"]
        entries = (
            cell(row["level"], ".0f"),
            cell(row["cells"], ".0f"),
            cell(row[key], ".4g"),
            FAILED if row.get("status") == FAILED else cell(row["value"], ".6g"),
            cell(row["error_or_change"], ".3g"),
            cell(row["observed_order"], ".2f"),
            cell(row["extrapolated"], ".6g"),
            cell(None if index is None else index * PERCENT, ".2f"),
        )
        lines.append("<tr>" + "".join(f"<td>{entry}</td>" for entry in entries) + "</tr>")
    return (
        f'<div class="wide"><table><thead><tr>{header}</tr></thead>'
        f"<tbody>{''.join(lines)}</tbody></table></div>"
    )


def figure_of(quantity, rows, key):
    """How a quantity converges; None if fewer than two levels have a value."""
    shown = [row for row in computed(rows) if row[key] is not None]
    if len(shown) < 2:
        return None
    make = error_figure if is_error(rows) else value_figure
    return make(quantity, shown, key)


def section(number, quantity, rows, folder):
    """Heading, table and figure of a quantity, as lines of HTML."""
    key = what_varies(rows)
    name = quantity or "No level was computed"
    lines = [f"<h2>{escape(name)}</h2>", table(rows, key)]
    failed = [f"{row['level']:.0f}" for row in rows if row.get("status") == FAILED]
    if failed:
        lines.append(
            f'<p class="note">Failed: level {", ".join(failed)} (log.txt says why). No change,'
            " order or extrapolation is computed across it.</p>"
        )
    figure = figure_of(quantity, rows, key)
    if figure is not None:
        shown = render(figure, f"study-{number}", folder)
        lines.append(page.figure(f"study-{number}", shown, escape(name)))
    return lines


def write_report(directory):
    """Writes the report of the study in @p directory."""
    quantities = by_quantity(read_study(directory / "study.csv"))
    folder = directory / "figures"
    folder.mkdir(exist_ok=True)
    title = f"Graupel: study in {escape(Path(directory).resolve().name)}"
    body = [f"<h1>{title}</h1>"]
    body.append(
        '<p class="under">Orders, Richardson extrapolation and grid-convergence index after'
        " Celik et al. (2008). Changes are relative, from one level to the next.</p>"
    )
    for number, (quantity, rows) in enumerate(quantities.items(), start=1):
        body += section(number, quantity, rows, folder)
    body.append(
        "<footer>The numbers are in study.csv; each level has its files in level-N, where"
        " scripts/report makes a report of it.</footer>"
    )
    (directory / "report.html").write_text(page.whole(title, body), encoding="utf-8")
