# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""One figure for each of the paper's figures 3 to 12, and those beyond it."""

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.patches import Rectangle

from graupel.report import reference
from common.fluidisation import fixed_cases, supported_drop
from graupel.report.style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILLION
from graupel.report.style import MILLI, PERCENT, column, new_figure, plot_cases, velocity_axis
from graupel.report.style import diamonds, note, shade_papers_band
from graupel.report import figures_inside

from .runs import over

SPHERE = np.array([0.36, 0.55, 0.72])
# Diameter and offset over that of the sphere, brightness.
DISCS = ((1.0, 0.0, 0.45), (0.8, 0.06, 0.75), (0.5, 0.13, 1.0))


def draw_bed(axes, run):
    """The spheres seen from the side, those behind drawn first, and the vessel."""
    points = run.particles(0).points * MILLI
    diameter = run.number("bed", "particle_diameter") * MILLI
    vessel = run.number("bed", "vessel_diameter") * MILLI
    height = run.number("bed", "vessel_height") * MILLI
    # From behind to the front, without the half that cannot be seen.
    points = points[points[:, 1] < 0.2 * vessel]
    points = points[np.argsort(-points[:, 1])]
    depth = np.clip(0.5 - points[:, 1] / vessel, 0.0, 1.0)
    # Each sphere as three discs, the smaller the brighter and the nearer to the light;
    # all discs of one before those of the next.
    n = len(points)
    sizes = np.tile([diameter * size for size, _, _ in DISCS], n)
    shift = np.tile([diameter * offset for _, offset, _ in DISCS], n)
    centers = np.repeat(points[:, [0, 2]], len(DISCS), axis=0) + np.stack([-shift, shift], axis=1)
    shades = [
        np.clip(np.outer(0.35 + 0.65 * depth, SPHERE * light + 0.25 * light), 0.0, 1.0)
        for _, _, light in DISCS
    ]
    colours = np.stack(shades, axis=1).reshape(-1, 3)
    axes.add_collection(
        EllipseCollection(
            sizes,
            sizes,
            np.zeros_like(sizes),
            units="xy",
            offsets=centers,
            offset_transform=axes.transData,
            facecolors=colours,
            edgecolors="none",
        )
    )
    axes.add_patch(
        Rectangle((-vessel / 2, 0), vessel, height, fill=False, edgecolor=BLACK, linewidth=0.8)
    )
    axes.set_xlim(-0.6 * vessel, 0.6 * vessel)
    axes.set_ylim(-2.0, height + 2.0)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("x [mm]")
    axes.set_title(
        f"{run.number('bed', 'particle_count'):,.0f} spheres of {diameter:.1f} mm\n"
        f"height {run.number('bed', 'height') * MILLI:.1f} mm,"
        f" void fraction {run.number('bed', 'mean_void_fraction'):.4f}",
        fontsize=8,
    )


def beds(first, second):
    """Figure 3: two beds side by side, to scale."""
    figure = new_figure(width=5.0, height=8.0)
    left, right = figure.subplots(1, 2, sharey=True)
    draw_bed(left, first)
    draw_bed(right, second)
    left.set_ylabel("height over the bottom z [mm]")
    return figure


def pressure_profile(run):
    """Figures 4 and 9: pressure along the axis in case 1, and Ergun's line."""
    table, case = run.profiles[1], run.case(1)
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    z = table["z"] * MILLI
    axes.plot(z, table["pressure"], color=BLUE, label="computed, section average")
    axes.plot(z, table["ergun_pressure"], "--", color=VERMILLION, label="Ergun, this bed")
    axes.axvline(case["bed_height"] * MILLI, color=GREY, linestyle=":", linewidth=1.0)
    top = (case["bed_height"] * MILLI, 0.6 * table["pressure"].max())
    note(axes, "top of the bed", top, (-4, 0), GREY, ha="right")
    axes.set_xlabel("height over the bottom z [mm]")
    axes.set_ylabel("pressure over outlet [Pa]")
    axes.set_title(f"case 1, $V_s$ = {case['superficial_velocity']:.3f} m/s")
    axes.legend()
    return figure


def bottom_force(light, heavy, paper):
    """Figures 5 and 10: force on the bottom over the weight, both densities."""
    figure = new_figure(height=3.6)
    axes = figure.subplots()
    for run, colour, label in (
        (light, BLUE, "1100 kg/m³"),
        (heavy, PURPLE, "2700 kg/m³ (aluminium)"),
    ):
        weight = run.cases[0]["weight"]
        plot_cases(
            axes, run.cases, column(run.cases, "bottom_force") / weight * PERCENT, colour, label
        )
    axes.axhline(0.0, color=GREY, linewidth=0.9)
    axes.axvline(paper.onset_velocity, color=VERMILLION, linestyle=":", linewidth=1.1)
    note(
        axes,
        f"the paper's bed lifts:\n{paper.onset_bottom_force:.3f} N",
        (paper.onset_velocity, 0.6 * axes.get_ylim()[1]),
        (4, 0),
        VERMILLION,
    )
    velocity_axis(axes)
    axes.set_ylabel("force on the bottom / weight [%]")
    axes.legend()
    return figure


def pressure_drop(fixed, light, paper, more=()):
    """Figures 6 and 11: pressure drop against Ergun's values, ours and the paper's."""
    figure = new_figure(height=4.0)
    axes = figure.subplots()
    smooth = np.linspace(0.2, 0.62, 100)
    axes.plot(smooth, reference.ergun_curve(fixed, smooth), color=GREY, label="Ergun, our bed")
    diamonds(axes, paper.velocity, paper.ergun, "Ergun, the paper's Table 1")
    plot_cases(
        axes, fixed.cases, column(fixed.cases, "pressure_drop"), BLUE, "computed, 2700 kg/m³"
    )
    plot_cases(
        axes, light.cases, column(light.cases, "pressure_drop"), GREEN, "computed, 1100 kg/m³", "s"
    )
    for run, colour, label in more:
        plot_cases(axes, run.cases, column(run.cases, "pressure_drop"), colour, label, "^")
    axes.axhline(supported_drop(light), color=PURPLE, linestyle="--", linewidth=1.0)
    note(axes, "1100 kg/m³: weight over cross-section", (0.2, supported_drop(light)), (2, 3))
    velocity_axis(axes)
    axes.set_ylabel("pressure drop [Pa]")
    axes.legend(loc="lower right")
    return figure


def percent_error(run, paper, more=()):
    """Figures 7 and 12: deviation from Ergun's equation of the bed's own height and void
    fraction, and how much of it the looser packing at the wall explains."""
    figure = new_figure(height=3.8)
    axes = figure.subplots()
    shade_papers_band(axes, paper, f"the paper: {paper.band_in_words}")
    axes.axhline(0.0, color=GREY, linewidth=0.9)
    cases = fixed_cases(run)
    plot_cases(axes, cases, column(cases, "deviation_from_ergun") * PERCENT, BLUE, "whole bed")
    plot_cases(
        axes,
        cases,
        column(cases, "wall_channelling_deviation") * PERCENT,
        ORANGE,
        "Ergun over the radial void fraction",
        "^",
        ":",
    )
    for other, colour, label in more:
        shown = fixed_cases(other)
        plot_cases(axes, shown, column(shown, "deviation_from_ergun") * PERCENT, colour, label, "s")
    velocity_axis(axes)
    axes.set_ylabel("deviation from Ergun [%]")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    return figure


def void_fraction(run):
    """Figure 8: void fraction on the mid-plane, first and last case."""
    return figures_inside.void_fraction(run, None)


def scales(runs_by_scale):
    """Deviation from Ergun, each bed's own, against the scale."""
    figure = new_figure(height=3.4)
    axes = figure.subplots()
    for scale, run in runs_by_scale:
        values = column(fixed_cases(run), "deviation_from_ergun") * PERCENT
        axes.plot([scale] * len(values), values, "o", color=BLUE)
    axes.axhspan(-2.0, 2.0, color="#EAEAEA", zorder=0)
    axes.axhline(0.0, color=GREY, linewidth=0.9)
    axes.set_xlabel("scale s: simulated over original diameter [-]")
    axes.set_ylabel("deviation from Ergun [%]")
    return figure


def original_bed(reference_run, plain, corrected):
    """Pressure drop over that of the 1X bed, without and with the void-fraction correction."""
    figure = new_figure(height=3.8)
    axes = figure.subplots()
    colours = {2: BLUE, 3: GREEN, 4: VERMILLION}
    for group, marker, line, label in (
        (plain, "s", ":", "law at the simulated bed's void fraction"),
        (corrected, "o", "-", "law at the original bed's"),
    ):
        for scale, run in group:
            cases = fixed_cases(run)
            plot_cases(
                axes,
                cases,
                np.array(over(reference_run, run)) * PERCENT,
                colours[scale],
                f"s = {scale}, {label}",
                marker,
                line,
            )
    axes.axhline(0.0, color=GREY, linewidth=0.9)
    velocity_axis(axes)
    axes.set_ylabel("pressure drop over the 1X bed's [%]")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    return figure

