"""The report of a refinement study: its table, and how each quantity converges."""

import csv
from html import escape
from pathlib import Path

import numpy as np

from . import page
from common.style import BLACK, BLUE, GREY, PERCENT, VERMILLION, new_figure, render

# What a study varies, by the column that changes from level to level.
SIZES = {
    "scale": "scale of the particles [-]",
    "cell_size": "representative cell size [m]",
    "filter_length": "filter length [m]",
    "time_step": "time step [s]",
}
NUMBERS = (
    "cells",
    "cell_size",
    "time_step",
    "value",
    "error_or_change",
    "observed_order",
    "filter_length",
    "extrapolated",
    "grid_convergence_index",
    "scale",
    "standard_error",
)


def read_study(path):
    """The rows of study.csv by quantity, in the order of the file; numbers as floats."""
    quantities = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            for key in NUMBERS:
                row[key] = float(row[key]) if row[key] else None
            quantities.setdefault(row["quantity"], []).append(row)
    return quantities


def what_varies(rows):
    """The column of sizes that differs between the levels."""
    for key in ("scale", "time_step", "filter_length", "cell_size"):
        if len({row[key] for row in rows}) > 1:
            return key
    return "cell_size"


def is_error(rows):
    """Whether the quantity is an error itself: its exact value is 0."""
    return all(row["value"] == row["error_or_change"] for row in rows)


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
    axes.legend()
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
            size, value, yerr=[row["standard_error"] for row in rows], fmt="none", color=BLUE
        )
        if last["extrapolated"] is not None:
            spread = abs(last["extrapolated"]) * last["grid_convergence_index"]
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
    axes.legend()
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
            row["level"],
            cell(row["cells"], ".0f"),
            cell(row[key], ".4g"),
            cell(row["value"], ".6g"),
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


def write_report(directory):
    """Writes the report of the study in @p directory."""
    quantities = read_study(directory / "study.csv")
    folder = directory / "figures"
    folder.mkdir(exist_ok=True)
    title = f"Graupel: study in {escape(Path(directory).resolve().name)}"
    body = [f"<h1>{title}</h1>"]
    body.append(
        '<p class="under">Orders, Richardson extrapolation and grid-convergence index after'
        " Celik et al. (2008). Changes are relative, from one level to the next.</p>"
    )
    for number, (quantity, rows) in enumerate(quantities.items(), start=1):
        key = what_varies(rows)
        make = error_figure if is_error(rows) else value_figure
        shown = render(make(quantity, rows, key), f"study-{number}", folder)
        body.append(f"<h2>{escape(quantity)}</h2>")
        body.append(table(rows, key))
        body.append(f'<figure><img alt="{escape(quantity)}" src="{shown.data_uri}"></figure>')
    body.append(
        "<footer>The numbers are in study.csv; each level has its files in level-N, where"
        " scripts/report.py makes a report of it.</footer>"
    )
    (directory / "report.html").write_text(page.whole(title, body), encoding="utf-8")
