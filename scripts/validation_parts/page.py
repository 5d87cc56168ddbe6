# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The page doc/validation/README.md, from the tables of its cases.

Each case leaves NAME.csv and NAME.png in the folder of the page, so that the page stays whole
when one of them is run alone, or some of its runs. All of them take most of a day.
"""

import csv

from common.markdown import image, table, verdict
from graupel.run import as_flag, as_number
from graupel.report.style import PERCENT, render

from .case import load, names

COLUMNS = (
    "quantity",
    "unit",
    "expected",
    "ours",
    "error",
    "deviation",
    "limit",
    "relative",
    "met",
    "decimals",
    "run",
    "cpu_seconds",
)
COMMAND = "scripts/validate"


def as_row(one, cpu_seconds):
    """A comparison as a row of NAME.csv; @p cpu_seconds are texts by the name of the run."""
    return {
        "quantity": one.quantity,
        "unit": one.unit,
        "expected": repr(one.expected),
        "ours": repr(one.ours),
        "error": "" if one.error is None else repr(one.error),
        "deviation": repr(one.deviation),
        "limit": "" if one.limit is None else repr(one.limit),
        "relative": str(one.relative),
        "met": "" if one.is_met is None else str(one.is_met),
        "decimals": str(one.decimals),
        "run": one.run,
        "cpu_seconds": cpu_seconds[one.run],
    }


def merged(before, now, order):
    """The rows of now, and those of before whose runs have none in now and are of the case
    still, in the order of the runs."""
    again = {row["run"] for row in now}
    kept = [row for row in before if row["run"] not in again and row["run"] in order]
    return sorted(kept + now, key=lambda row: order.index(row["run"]))


def write_case(name, comparisons, cpu_seconds, figure, folder):
    """Leaves what a case came to in the folder of the page; @p cpu_seconds is the CPU time of
    each run by its name."""
    render(figure, name, folder)
    file = folder / f"{name}.csv"
    order = [run.name for run in load(name).runs(False)]
    before = read_case(file) if file.exists() else []
    cost = {row["run"]: row["cpu_seconds"] for row in before}
    cost.update((run, f"{seconds:.0f}") for run, seconds in cpu_seconds.items())
    rows = merged(before, [as_row(one, cost) for one in comparisons], order)
    drawn = [run for run in order if any(one.run == run for one in comparisons)]
    with open(file, "w", newline="", encoding="utf-8") as stream:
        stream.write(f"# {COMMAND} {name}; the figure shows the runs\n# {', '.join(drawn)}\n")
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)


def read_case(file):
    """The rows that write_case() has left."""
    return list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()[2:]))


def drawn_runs(file):
    """The runs that the figure beside a table shows, as a text."""
    return file.read_text(encoding="utf-8").splitlines()[1].strip("# ")


def number(text, decimals):
    """A cell of the page."""
    value, places = as_number(text), int(decimals)
    if value is None:
        return ""
    return f"{value:.2g}" if places < 0 else f"{value:.{places}f}"


def with_error(row):
    """Our value and its error."""
    error = number(row["error"], row["decimals"])
    return number(row["ours"], row["decimals"]) + (f" ± {error}" if error else "")


def distance(row, key, sign=""):
    """Deviation or limit, in per cent where it is relative."""
    value = as_number(row[key])
    if value is None:
        return "shown"
    if as_flag(row["relative"]):
        return f"{value * PERCENT:{sign}.1f} %"
    return ("+" if sign and value > 0.0 else "") + number(row[key], row["decimals"])


def case_rows(name, rows):
    """The lines of a case in the table."""
    for number_of_row, row in enumerate(rows):
        met = as_flag(row["met"])
        is_first_of_run = number_of_row == 0 or row["run"] != rows[number_of_row - 1]["run"]
        yield [
            f"[{name}](#{name})" if number_of_row == 0 else "",
            f"{row['quantity']} [{row['unit']}]",
            number(row["expected"], row["decimals"]),
            with_error(row),
            distance(row, "deviation", "+"),
            distance(row, "limit"),
            "" if met is None else verdict(met),
            f"{row['cpu_seconds']} s" if is_first_of_run and row["cpu_seconds"] else "",
        ]


def section(name, folder):
    """What a case is, its command, and its figure."""
    case = load(name)
    parts = [f"## {name}\n", f"{case.TITLE}\n", f"Expected values: {case.SOURCE}\n"]
    parts.append(f"`{COMMAND} {name}`\n")
    if (folder / f"{name}.png").exists():
        parts.append(image(name, f"{case.TITLE}: {drawn_runs(folder / f'{name}.csv')}"))
    return "\n".join(parts)


def write_page(folder):
    """README.md of the cases whose tables are in the folder; those not run yet are named."""
    lines, sections, missing = [], [], []
    for name in names():
        file = folder / f"{name}.csv"
        if not file.exists():
            missing.append(name)
            continue
        lines += case_rows(name, read_case(file))
        sections.append(section(name, folder))
    header = [
        "case",
        "quantity",
        "expected",
        "ours",
        "deviation",
        "limit",
        "met",
        "CPU time of the run",
    ]
    text = [
        "# Judged by measurement and law\n",
        f"Made by `{COMMAND}`; nothing is entered by hand. `{COMMAND} CASE` runs one of them."
        " Errors are one standard deviation of the mean, by block averages where it is a mean"
        " over time. Without a limit a number is only shown.\n",
        table(header, lines) + "\n",
        *sections,
    ]
    if missing:
        text.append("Not run yet: " + ", ".join(missing) + ".\n")
    (folder / "README.md").write_text("\n".join(text), encoding="utf-8")
