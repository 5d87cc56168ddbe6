# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Figures of the inside of the bed: the mid-plane, and the profile from the wall inwards."""

import numpy as np
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from ..run import grid_of
from .style import BLACK, GREY, MILLI, NothingToShow, NotOfThisRun, colour_of_each, known
from .style import legend_beside, new_figure, of_case, of_cases

from .figures_bed import label_of
from .hover import plain

MOST_PANELS = 7


def chosen(numbers):
    """At most MOST_PANELS of the cases, the first and the last among them."""
    numbers = sorted(numbers)
    if len(numbers) <= MOST_PANELS:
        return numbers
    places = np.linspace(0, len(numbers) - 1, MOST_PANELS).round().astype(int)
    return [numbers[place] for place in places]


def void_fraction_range(fields):
    """Colour limits that show the bed, not the clear fluid above it."""
    inside = np.concatenate([values[values < 0.75] for values in fields])
    if inside.size == 0:
        return Normalize(0.0, 1.0)
    low, high = np.percentile(inside, (0.5, 97.0))
    return Normalize(np.floor(low * 20.0) / 20.0, np.ceil(high * 20.0) / 20.0)


def ratio_range(fields):
    """Colour limits that are symmetric about a ratio of 1."""
    away = np.abs(np.concatenate([values[np.isfinite(values)] for values in fields]) - 1.0)
    reach = max(0.05, np.ceil(np.percentile(away, 99.0) * 20.0) / 20.0) if away.size else 1.0
    return Normalize(1.0 - reach, 1.0 + reach)


def panels(run, tables, name, colour_map, choose_range, label, divide_by_velocity=False):
    """One image a case of a field on the plane y = 0, on common colours."""
    if not tables:
        raise NothingToShow("no midplane-NN.csv was found")
    numbers = chosen(tables)
    grids = []
    for number in numbers:
        x, z, values = grid_of(tables[number], name)
        if divide_by_velocity:
            case = run.case(number)
            if case is None or not case["superficial_velocity"]:
                raise NothingToShow("the cases hold no superficial velocity to divide by")
            values = values / case["superficial_velocity"]
        if known(values):
            grids.append((number, x * MILLI, z * MILLI, values))
    if not grids:
        raise NothingToShow(f"midplane-NN.csv holds no values of {name}")

    norm = choose_range([values for *_, values in grids])
    shape = max(np.ptp(x) / np.ptp(z) for _, x, z, _ in grids)
    figure = new_figure(*size_of_row(len(grids), shape))
    row = np.atleast_1d(figure.subplots(1, len(grids), sharey=True))
    for axes, (number, x, z, values) in zip(row, grids):
        image = draw_field(axes, x, z, values, colour_map, norm)
        image.set_label(plain(label))
        axes.set_gid(of_case(number))
        axes.set_xlabel("x [mm]")
        velocity = (run.case(number) or {}).get("superficial_velocity")
        speed = "" if velocity is None else f"\n{velocity:.3f} m/s"
        axes.set_title(f"case {number}{speed}", fontsize=8)
        height = (run.case(number) or {}).get("bed_height")
        if height is not None:
            axes.axhline(height * MILLI, color=BLACK, linewidth=0.8, linestyle=":")
    row[0].set_ylabel("height over the bottom z [mm]")
    bar = figure.colorbar(image, ax=list(row), extend="both", shrink=0.75, pad=0.02, label=label)
    bar.outline.set_visible(False)
    return figure


def size_of_row(n_panels, shape):
    """Width and height [inch] of a figure with panels side by side, each with an image of this
    width over height, lengths to scale."""
    height = min(4.4, 6.3 / (n_panels * shape))
    width = max(n_panels * max(0.75, height * shape), 2.5)
    return width + 1.4, max(height, 1.6) + 1.0


def draw_field(axes, x, z, values, colour_map, norm):
    """One image, its pixels centred on the points of the grid, lengths to scale."""
    half_x = 0.5 * (x[-1] - x[0]) / (len(x) - 1)
    half_z = 0.5 * (z[-1] - z[0]) / (len(z) - 1)
    image = axes.imshow(
        values,
        origin="lower",
        extent=(x[0] - half_x, x[-1] + half_x, z[0] - half_z, z[-1] + half_z),
        cmap=colour_map,
        norm=norm,
        interpolation="nearest",
        aspect="equal",
    )
    axes.grid(False)
    axes.tick_params(labelsize=7.5)
    axes.xaxis.set_major_locator(MaxNLocator(2, steps=[1, 2, 4, 5, 10]))
    return image


@of_cases
def void_fraction(run, paper):
    """Void fraction on the plane y = 0."""
    return panels(
        run, run.midplane, "void_fraction", "viridis", void_fraction_range, "void fraction [-]"
    )


@of_cases
def flux(run, paper):
    """Axial volumetric flux on the plane y = 0, over the superficial velocity."""
    return panels(
        run,
        run.midplane,
        "superficial_velocity",
        "RdBu_r",
        ratio_range,
        "axial flux over $V_s$ [-]",
        divide_by_velocity=True,
    )


@of_cases
def radial(run, paper):
    """Void fraction and axial flux against the distance from the wall."""
    if not run.radial and any(run.directory.glob("radial-*.csv")):
        raise NotOfThisRun("the vessel is not a whole cylinder")
    if not run.radial:
        raise NothingToShow("no radial-NN.csv was found")
    figure = new_figure(height=3.6)
    left, right = figure.subplots(1, 2, sharex=True)
    for colour, (number, table) in zip(colour_of_each(len(run.radial)), sorted(run.radial.items())):
        distance = table["wall_distance"] * MILLI
        label, mark = label_of(run, number), {"gid": of_case(number)}
        left.plot(distance, table["void_fraction"], color=colour, label=label, **mark)
        case = run.case(number)
        if case is not None and case["superficial_velocity"]:
            ratio = table["superficial_velocity"] / case["superficial_velocity"]
            right.plot(distance, ratio, color=colour, label=f"_{label}", **mark)
    left.set_ylabel("void fraction [-]")
    right.set_ylabel("axial flux over $V_s$ [-]")
    right.axhline(1.0, color=GREY, linewidth=0.9)
    diameter = run.number("bed", "particle_diameter")
    for axes in (left, right):
        axes.set_xlabel("distance from the wall [mm]")
        axes.set_xlim(left=0.0)
        if diameter is not None and diameter > 0.0:
            in_diameters = axes.secondary_xaxis(
                "top",
                functions=(
                    lambda length: length / (MILLI * diameter),
                    lambda count: count * MILLI * diameter,
                ),
            )
            in_diameters.set_xlabel("in particle diameters [-]", fontsize=8)
            in_diameters.tick_params(labelsize=7.5)
    legend_beside(right, left)
    return figure
