# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""How the figures look, and how they reach the page and the folder of PNG files."""

import functools
import io
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from . import hover

# Okabe and Ito's colours, which stay apart for colour-blind readers.
BLUE = "#0072B2"
VERMILLION = "#D55E00"
GREEN = "#009E73"
PURPLE = "#A2578A"
ORANGE = "#E69F00"
GREY = "#7A7A7A"
BLACK = "#222222"

MILLI = 1e3
PERCENT = 1e2

matplotlib.rcParams.update(
    {
        "font.family": "sans-serif",
        "font.sans-serif": ["DejaVu Sans"],
        "font.size": 9,
        "text.color": BLACK,
        "axes.labelcolor": BLACK,
        "axes.edgecolor": "#9A9A9A",
        "axes.linewidth": 0.7,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.titlesize": 9,
        "axes.formatter.useoffset": False,
        "grid.color": "#E6E6E6",
        "grid.linewidth": 0.6,
        "xtick.color": "#555555",
        "ytick.color": "#555555",
        "lines.linewidth": 1.5,
        "lines.markersize": 5.5,
        "legend.frameon": False,
        "legend.fontsize": 8.5,
        "svg.hashsalt": "graupel",
    }
)


class NothingToShow(Exception):
    """The data of a figure are not there; the message says which."""


class NotOfThisRun(NothingToShow):
    """The run has nothing of the kind (no flow, no particles), so that nothing is missing."""


@dataclass
class Rendered:
    """A finished figure: its SVG to stand in the page, and what the page's script shows under
    the pointer (hover.py)."""

    svg: str
    hover: dict


def new_figure(width=7.4, height=3.8):
    """A figure of that size [inch] whose parts arrange themselves."""
    return Figure(figsize=(width, height), dpi=160, layout="constrained")


def render(figure, name, folder):
    """Writes folder/NAME.png unless the folder is None, and returns the figure for the page."""
    # The canvases are called directly: Figure.savefig draws everything twice.
    canvas = FigureCanvasAgg(figure)
    if folder is None:
        canvas.draw()
    else:
        canvas.print_png(folder / f"{name}.png")
    # The parts have found their places; to look for them again costs as much
    # as drawing.
    figure.set_layout_engine("none")
    shown = hover.of_figure(figure)
    # The page finds what belongs to a case by its id.
    marked = figure.findobj(lambda artist: artist.get_gid() is not None)
    for number, artist in enumerate(marked):
        artist.set_gid(f"{name}.{number}.{artist.get_gid()}")
    buffer = io.BytesIO()
    no_metadata = {key: None for key in ("Creator", "Date", "Format", "Type")}
    FigureCanvasSVG(figure).print_svg(buffer, metadata=no_metadata)
    svg = buffer.getvalue().decode("utf-8")
    return Rendered(svg[svg.index("<svg") :], shown)


def of_case(number):
    """Mark (gid) of what a figure draws of one flow case, so that the reader can choose it."""
    return f"case-{number}"


def legend_beside(axes, source=None, **more):
    """A legend to the right of the axes, where there is no data; of the curves of @p source if
    they are others'."""
    handles, labels = (source or axes).get_legend_handles_labels()
    if handles:
        axes.legend(handles, labels, loc="center left", bbox_to_anchor=(1.01, 0.5), **more)


def colour_of_each(count):
    """One colour a case, from dark to light in the order of the cases."""
    return [colormaps["viridis"](value) for value in np.linspace(0.0, 0.85, max(count, 1))]


def column(cases, key):
    """One quantity of all cases, as an array with NaN where it is not known."""
    return np.array(
        [np.nan if case.get(key) is None else case[key] for case in cases], dtype=float
    )


def known(values):
    """Whether an array has at least one number in it."""
    return values is not None and bool(np.any(np.isfinite(values)))


def plot_cases(axes, cases, values, colour, label, marker="o", line="-"):
    """Draws a quantity against V_s: filled markers for fixed beds, hollow for lifted ones."""
    velocity = column(cases, "superficial_velocity")
    axes.plot(velocity, values, line, color=colour, linewidth=1.2, alpha=0.75)
    lifted = np.array([case["fluidized"] is True for case in cases], dtype=bool)
    axes.plot(velocity[~lifted], values[~lifted], marker, color=colour, label=label)
    axes.plot(
        velocity[lifted],
        values[lifted],
        marker,
        markerfacecolor="white",
        markeredgecolor=colour,
        markeredgewidth=1.4,
        label=None if np.any(~lifted) else label,
    )


def diamonds(axes, x, y, label, **more):
    """The paper's own values: hollow diamonds."""
    axes.plot(
        x, y, "D", markerfacecolor="none", markeredgecolor=VERMILLION, label=label, **more
    )


def note(axes, text, at, offset=(4, 3), colour=PURPLE, fontsize=8, **more):
    """A text near the point @p at, so many points beside it."""
    axes.annotate(
        text,
        at,
        xytext=offset,
        textcoords="offset points",
        color=colour,
        fontsize=fontsize,
        **more,
    )


def shade_papers_band(axes, paper, label):
    """The paper's range of deviations [%] over the cases before its onset, in grey."""
    axes.fill_between(
        [paper.velocity[0], paper.velocity[-2]],
        *np.array(paper.band) * PERCENT,
        color="#DCDCDC",
        linewidth=0,
        label=label,
    )


def velocity_axis(axes):
    """Labels the axis of the superficial velocity."""
    axes.set_xlabel("superficial velocity $V_s$ [m/s]")


def of_cases(make):
    """A figure of the flow cases: a run that has none does not miss it."""

    @functools.wraps(make)
    def figure(run, paper):
        if not run.has_flow():
            raise NotOfThisRun("there is no flow")
        return make(run, paper)

    return figure


def need_cases(cases):
    """Throws NothingToShow unless there are cases with a superficial velocity."""
    if not known(column(cases, "superficial_velocity")):
        raise NothingToShow("no flow case with a superficial velocity was found")
