# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Words and tables of the pages in doc/."""

from graupel.report.style import PERCENT


def percent(value, digits=1):
    """A relative number as a signed percentage."""
    return "-" if value is None else f"{value * PERCENT:+.{digits}f} %"


def span(values, digits=1):
    """The range of relative numbers, as signed percentages."""
    low, high = min(values), max(values)
    same = f"{low * PERCENT:+.{digits}f}" == f"{high * PERCENT:+.{digits}f}"
    return percent(low, digits) if same else f"{low * PERCENT:+.{digits}f} to {percent(high, digits)}"


def table(header, rows):
    """A Markdown table."""
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def verdict(agrees):
    """yes or no, as a word of the table."""
    return "yes" if agrees else "**no**"


def image(name, text):
    """A figure with its caption."""
    return f"![{text}]({name}.png)\n\n*{text}*\n"
