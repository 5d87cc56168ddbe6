# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What the page shows under the pointer: the values of curves and images, by their place."""

import base64
import re

import numpy as np

# Points of a curve that are kept; a reader's hand is no finer.
MOST_POINTS = 400
SVG_DPI = 72.0  # in which the canvas writes
NO_VALUE = 255  # of an image


def plain(text):
    """A label without the marks of mathematics, in one line."""
    return re.sub(r"[$\\{}]", "", text or "").replace("\n", " ")


def label_of_axis(axes, direction):
    """Label of an axis, or of those that share it."""
    own = getattr(axes, f"get_{direction}label")()
    group = getattr(axes, f"get_shared_{direction}_axes")()
    shared = [getattr(other, f"get_{direction}label")() for other in group.get_siblings(axes)]
    return plain(own or next((label for label in shared if label), ""))


def case_of(artist):
    """The number of the case that an artist belongs to, or None."""
    found = re.fullmatch(r"case-(\d+)", artist.get_gid() or "")
    return int(found.group(1)) if found else None


def places(axes, points, figure):
    """Where points of the data stand in the SVG, shape (n, 2)."""
    shown = axes.transData.transform(points) * (SVG_DPI / figure.dpi)
    shown[:, 1] = figure.get_figheight() * SVG_DPI - shown[:, 1]
    return shown


def numbers(array, digits):
    """Numbers of so many digits, as a list for JSON."""
    return [float(f"{value:.{digits}g}") for value in np.ravel(array)]


def of_curve(line, axes, figure):
    """A curve: places and values of its points; None if it has none within the axes."""
    points = np.column_stack([np.asarray(values, dtype=float) for values in line.get_data()])
    low, high = np.sort(axes.viewLim.get_points(), axis=0)
    slack = 1e-9 * (high - low)
    inside = np.all((points >= low - slack) & (points <= high + slack), axis=1)
    points = points[inside]
    if not len(points):
        return None
    points = points[:: -(-len(points) // MOST_POINTS)]
    # Labels of one line in front keep a curve out of the legend; "_child" is matplotlib's own.
    label = line.get_label()
    return {
        "label": "" if label.startswith("_child") else plain(label).lstrip("_"),
        "case": case_of(line) or case_of(axes),
        "axes": [label_of_axis(axes, "x"), label_of_axis(axes, "y")],
        "at": np.round(places(axes, points, figure), 1).ravel().tolist(),
        "values": numbers(points, 5),
    }


def of_image(image, axes, figure):
    """An image: its corners, and its values in 255 steps."""
    values = np.ma.filled(np.ma.asarray(image.get_array(), dtype=float), np.nan)
    known = np.isfinite(values)
    if not np.any(known):
        return None
    low, high = np.nanmin(values), np.nanmax(values)
    steps = np.full(values.shape, NO_VALUE, dtype=np.uint8)
    width = (high - low) or 1.0
    steps[known] = np.round((values[known] - low) / width * (NO_VALUE - 1)).astype(np.uint8)
    left, right, bottom, top = image.get_extent()
    corners = places(axes, np.array([[left, bottom], [right, top]]), figure)
    return {
        "label": "" if image.get_label().startswith("_") else plain(image.get_label()),
        "case": case_of(axes),
        "axes": [label_of_axis(axes, "x"), label_of_axis(axes, "y")],
        "at": np.round(corners, 1).ravel().tolist(),
        "extent": numbers((left, bottom, right, top), 6),
        "range": numbers((low, high), 6),
        "shape": list(values.shape),
        "steps": base64.b64encode(steps.tobytes()).decode("ascii"),
    }


def of_figure(figure):
    """All curves and images of a figure whose parts have found their places."""
    shown = {"curves": [], "images": []}
    for axes in figure.axes:
        if axes.get_label() == "<colorbar>":
            continue
        # Lines across the axes, such as that of zero, are no data.
        curves = [line for line in axes.lines if line.get_transform() is axes.transData]
        shown["curves"] += [of_curve(line, axes, figure) for line in curves]
        shown["images"] += [of_image(image, axes, figure) for image in axes.images]
    return {kind: [one for one in all_of if one is not None] for kind, all_of in shown.items()}
