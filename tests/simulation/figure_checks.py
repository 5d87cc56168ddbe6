# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What a figure must not do: cover data with a legend, or a label with another one."""

import itertools

from matplotlib.text import Text

# By how much two boxes may meet before it counts, in pixels: descenders that are not there.
SLACK = 1.0


def overlap(first, second):
    """Whether two boxes cover each other, beyond the slack."""
    return (
        min(first.x1, second.x1) - max(first.x0, second.x0) > SLACK
        and min(first.y1, second.y1) - max(first.y0, second.y0) > SLACK
    )


def hidden_labels(figure):
    """Labels of ticks beyond the limits of their axis, which matplotlib keeps undrawn."""
    hidden = set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            # On a logarithmic axis, of the logarithm.
            scaled = axis.get_transform().transform
            low, high = sorted(scaled(axis.get_view_interval()))
            slack = 1e-6 * (high - low)
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                if not low - slack <= scaled(tick.get_loc()) <= high + slack:
                    hidden |= {tick.label1, tick.label2}
    return hidden


def faults(figure):
    """Sentences on what covers what in a figure that has been drawn."""
    renderer = figure.canvas.get_renderer()
    hidden = hidden_labels(figure)
    texts = [
        (one, one.get_window_extent(renderer))
        for one in figure.findobj(Text)
        if one not in hidden and one.get_visible() and one.get_text().strip()
    ]
    found = [
        f"'{a.get_text()}' meets '{b.get_text()}'"
        for (a, box), (b, other) in itertools.combinations(texts, 2)
        if overlap(box, other)
    ]
    width, height = figure.bbox.width, figure.bbox.height
    found += [
        f"'{text.get_text()}' is cut off"
        for text, box in texts
        if box.x0 < -SLACK or box.y0 < -SLACK or box.x1 > width + SLACK or box.y1 > height + SLACK
    ]
    data = [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
    covers = [(axes.get_legend(), "legend") for axes in figure.axes if axes.get_legend()]
    covers += [(axes, "colour bar") for axes in figure.axes if axes.get_label() == "<colorbar>"]
    for cover, kind in covers:
        box = cover.get_window_extent(renderer)
        for axes in data:
            if overlap(box, axes.get_window_extent(renderer)):
                found.append(f"the {kind} covers data of '{axes.get_ylabel()}'")
    return found
