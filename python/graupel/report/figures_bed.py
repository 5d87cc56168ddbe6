# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Figures of the bed as a whole: pressure, deviation from Ergun, forces and height."""

import numpy as np

from . import reference
from .style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILLION
from .style import MILLI, PERCENT, NothingToShow, colour_of_each, column, known
from .style import diamonds, legend_beside, need_cases, new_figure, note, of_case, of_cases
from .style import plot_cases, shade_papers_band, velocity_axis


# Of the axis of a height, over the height [-].
LEAST_SPAN = 0.01


def label_of(run, number):
    """Name of a case in a legend."""
    case = run.case(number)
    if case is None or case["superficial_velocity"] is None:
        return f"case {number}"
    lifted = ", lifted" if case["fluidized"] else ""
    return f"case {number}: {case['superficial_velocity']:.3f} m/s{lifted}"


@of_cases
def pressure_profile(run, paper):
    """Section-averaged pressure along the axis against Ergun's line, and the void fraction."""
    if not run.profiles:
        raise NothingToShow("no profiles-NN.csv was found")
    figure = new_figure(height=5.2)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.4, 1.0))
    colours = colour_of_each(len(run.profiles))
    for colour, (number, table) in zip(colours, sorted(run.profiles.items())):
        z = table["z"] * MILLI
        label, mark = label_of(run, number), {"gid": of_case(number)}
        ergun = f"_Ergun, {label}"
        upper.plot(z, table["pressure"], color=colour, label=label, **mark)
        thin = {"color": colour, "linewidth": 1.0, **mark}
        upper.plot(z, table["ergun_pressure"], "--", label=ergun, **thin)
        lower.plot(z, table["void_fraction"], label=f"_{label}", **thin)
    upper.plot([], [], "--", color=GREY, linewidth=1.0, label="Ergun")
    height = run.number("bed", "height")
    if height is not None:
        for axes in (upper, lower):
            axes.axvline(height * MILLI, color=GREY, linestyle=":", linewidth=1.0)
        # Above the axes, where there is no curve.
        at_top = {"xycoords": ("data", "axes fraction"), "ha": "center", "va": "bottom"}
        note(upper, "top of the bed at rest", (height * MILLI, 1.0), (0, 2), GREY, 7.5, **at_top)
    upper.set_ylabel("pressure over outlet [Pa]")
    upper.set_ylim(bottom=min(0.0, upper.get_ylim()[0]))
    legend_beside(upper)
    lower.set_ylabel("void fraction [-]")
    lower.set_ylim(0.0, 1.05)
    lower.set_xlabel("height over the bottom z [mm]")
    lower.margins(x=0.01)
    return figure


@of_cases
def pressure_drop(run, paper):
    """Pressure drop against superficial velocity: computed, Ergun, paper, weight per area."""
    need_cases(run.cases)
    figure = new_figure()
    axes = figure.subplots()
    velocity = column(run.cases, "superficial_velocity")
    last = np.nanmax(velocity)
    if paper is not None:
        last = max(last, paper.onset_velocity)
    smooth = np.linspace(0.0, 1.06 * last, 120)
    curve = reference.ergun_curve(run, smooth)
    if curve is not None:
        axes.plot(smooth, curve, color=GREY, linewidth=1.2, label="Ergun, this bed\nat rest")
    own = column(run.cases, "ergun_pressure_drop")
    axes.plot(velocity, own, "_", color=BLACK, markersize=11, label="Ergun, bed of\neach case")
    if paper is not None:
        table_1 = f"Ergun in the paper's\nTable 1 ({paper.scale}X)"
        diamonds(axes, paper.velocity, paper.ergun, table_1, markersize=6.5)
    plot_cases(axes, run.cases, column(run.cases, "pressure_drop"), BLUE, "computed")
    weight = reference.weight_per_area(run)
    if weight is not None:
        axes.axhline(weight, color=PURPLE, linestyle="--", linewidth=1.1)
        label = "weight of the bed\nover the section"
        axes.plot([], [], "--", color=PURPLE, linewidth=1.1, label=label)
    velocity_axis(axes)
    axes.set_xlim(0.0, 1.06 * last)
    axes.set_ylabel("pressure drop [Pa]")
    axes.set_ylim(bottom=0.0)
    legend_beside(axes)
    return figure


def limits_of_deviation(cases, curves, paper):
    """Range of the axis [%]: the fixed beds and the paper's band, not what a lifted bed does."""
    fixed = np.array([case["fluidized"] is not True for case in cases], dtype=bool)
    shown = [values[fixed] for values in curves]
    inside = np.concatenate(shown) if np.any(fixed) else np.concatenate(curves)
    inside = np.append(inside[np.isfinite(inside)], 0.0)
    if paper is not None:
        inside = np.append(inside, np.array(paper.band) * PERCENT)
    margin = max(0.5, 0.15 * np.ptp(inside))
    return inside.min() - margin, inside.max() + margin


def mark_outside(axes, cases, values, limits, colour):
    """Writes the value of points that lie off the axis at its edge."""
    for case, value in zip(cases, values):
        if not np.isfinite(value) or limits[0] <= value <= limits[1]:
            continue
        below = value < limits[0]
        note(
            axes,
            f"{'↓' if below else '↑'} {value:+.1f} %".replace("-", "−"),
            (case["superficial_velocity"], limits[0 if below else 1]),
            (0, 4 if below else -10),
            colour,
            ha="center",
        )


@of_cases
def deviation(run, paper):
    """Relative deviation from Ergun: whole bed, middle half, and what the wall predicts."""
    need_cases(run.cases)
    curves = [
        ("deviation_from_ergun", BLUE, "o", "-", "whole bed"),
        ("gradient_deviation_from_ergun", VERMILLION, "s", "-", "gradient over the\nmiddle half"),
        ("wall_channelling_deviation", GREEN, "^", ":", "predicted from the\nradial void fraction"),
    ]
    values = [column(run.cases, key) * PERCENT for key, *_ in curves]
    if not any(known(array) for array in values):
        raise NothingToShow("the cases hold no deviation from Ergun")
    figure = new_figure(height=4.0)
    axes = figure.subplots()
    limits = limits_of_deviation(run.cases, values, paper)
    if paper is not None:
        shade_papers_band(axes, paper, f"the paper, {paper.scale}X:\n{paper.band_in_words}")
    axes.axhline(0.0, color=GREY, linewidth=0.9)
    for array, (_, colour, marker, line, label) in zip(values, curves):
        if known(array):
            plot_cases(axes, run.cases, array, colour, label, marker, line)
    axes.set_ylim(limits)
    whole = next(index for index, array in enumerate(values) if known(array))
    mark_outside(axes, run.cases, values[whole], limits, curves[whole][1])
    velocity_axis(axes)
    axes.margins(x=0.08)
    axes.set_ylabel("deviation from Ergun [%]")
    legend_beside(axes)
    return figure


@of_cases
def bottom_force(run, paper):
    """What the bottom and the wall carry, and what the fluid leaves for them."""
    need_cases(run.cases)
    bottom = column(run.cases, "bottom_force")
    wall = column(run.cases, "wall_force")
    left = column(run.cases, "weight") - column(run.cases, "fluid_force")
    if not (known(bottom) or known(wall)):
        raise NothingToShow("the cases hold no forces")
    figure = new_figure()
    axes = figure.subplots()
    axes.axhline(0.0, color=GREY, linewidth=0.9)
    velocity = column(run.cases, "superficial_velocity")
    if known(left):
        axes.plot(velocity, left, "--", color=GREY, linewidth=1.2, label="weight less fluid\nforce")
    supports = column(run.cases, "support_force")
    if known(supports):
        axes.plot(velocity, supports, "x", color=BLACK, markersize=6, label="all walls")
    elif known(bottom) and known(wall):
        axes.plot(velocity, bottom + wall, "x", color=BLACK, markersize=6, label="bottom + wall")
    if known(bottom):
        plot_cases(axes, run.cases, bottom, BLUE, "bottom")
    if known(wall):
        plot_cases(axes, run.cases, wall, ORANGE, "wall", marker="s")
    if paper is not None:
        at_onset = f"bottom in the paper\nat onset ({paper.scale}X)"
        diamonds(
            axes, [paper.onset_velocity], [paper.onset_bottom_force], at_onset, markersize=6.5
        )
    velocity_axis(axes)
    axes.set_ylabel("contact force along the axis [N]")
    legend_beside(axes)
    return figure


@of_cases
def bed_height(run, paper):
    """Height of the bed, and how far it rose, against superficial velocity."""
    need_cases(run.cases)
    height = column(run.cases, "bed_height") * MILLI
    rise = column(run.cases, "bed_rise") * MILLI
    if not (known(height) or known(rise)):
        raise NothingToShow("the cases hold no bed height")
    figure = new_figure(height=3.2)
    left, right = figure.subplots(1, 2)
    plot_cases(left, run.cases, height, BLUE, None)
    left.set_ylabel("bed height [mm]")
    plot_cases(right, run.cases, rise, BLUE, "computed")
    if paper is not None:
        at_onset = f"the paper at\nonset ({paper.scale}X)"
        rise_there = [paper.onset_rise * MILLI]
        diamonds(right, [paper.onset_velocity], rise_there, at_onset, markersize=6.5)
    right.axhline(0.0, color=GREY, linewidth=0.9)
    right.set_ylabel("rise over the bed before the flow [mm]")
    if paper is not None:
        legend_beside(right)
    for axes, values in ((left, height), (right, rise)):
        velocity_axis(axes)
        widen(axes, LEAST_SPAN * np.nanmax(height, initial=0.0))
    return figure


def widen(axes, span):
    """Makes the vertical axis at least so long: less than this is no change of the bed."""
    low, high = axes.get_ylim()
    if high - low < span:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - 0.5 * span, middle + 0.5 * span)
