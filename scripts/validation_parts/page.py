"""The page doc/validation/README.md, from the tables of its cases.

Each case leaves NAME.csv and NAME.png in the folder of the page, so that the page stays whole
when one of them is run alone.
"""

import csv

from common.markdown import image, table, verdict
from common.run_output import as_flag, as_number
from common.style import PERCENT, render

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
)
COMMAND = "scripts/validate"


def write_case(name, comparisons, cost, figure, folder):
    """Leaves what a case came to in the folder of the page; @p cost is its CPU time [s]."""
    render(figure, name, folder)
    with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
        file.write(f"# {COMMAND} {name}; CPU time of its runs [s]:\n# {cost:.0f}\n")
        rows = csv.writer(file)
        rows.writerow(COLUMNS)
        for one in comparisons:
            rows.writerow(
                [
                    one.quantity,
                    one.unit,
                    repr(one.expected),
                    repr(one.ours),
                    "" if one.error is None else repr(one.error),
                    repr(one.deviation),
                    "" if one.limit is None else repr(one.limit),
                    one.relative,
                    "" if one.is_met is None else one.is_met,
                    one.decimals,
                ]
            )


def read_case(file):
    """What write_case() has left: the rows, and the CPU time [s]."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(lines[2:])), float(lines[1].strip("# "))


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


def case_rows(name, rows, seconds):
    """The lines of a case in the table."""
    for number_of_row, row in enumerate(rows):
        met = as_flag(row["met"])
        yield [
            f"[{name}](#{name})" if number_of_row == 0 else "",
            f"{row['quantity']} [{row['unit']}]",
            number(row["expected"], row["decimals"]),
            with_error(row),
            distance(row, "deviation", "+"),
            distance(row, "limit"),
            "" if met is None else verdict(met),
            f"{seconds:.0f} s" if number_of_row == 0 else "",
        ]


def section(name, folder):
    """What a case is, its command, and its figure."""
    case = load(name)
    parts = [f"## {name}\n", f"{case.TITLE}\n", f"Expected values: {case.SOURCE}\n"]
    parts.append(f"`{COMMAND} {name}`\n")
    if (folder / f"{name}.png").exists():
        parts.append(image(name, case.TITLE))
    return "\n".join(parts)


def write_page(folder):
    """README.md of the cases whose tables are in the folder; those not run yet are named."""
    lines, sections, missing = [], [], []
    for name in names():
        file = folder / f"{name}.csv"
        if not file.exists():
            missing.append(name)
            continue
        lines += case_rows(name, *read_case(file))
        sections.append(section(name, folder))
    header = [
        "case",
        "quantity",
        "expected",
        "ours",
        "deviation",
        "limit",
        "met",
        "CPU time",
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
