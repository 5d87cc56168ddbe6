# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Means over time, and how far they can be trusted."""

import numpy as np

# An error from fewer blocks is too uncertain.
FEWEST_BLOCKS = 8
# What chi-squared of 1, 2, ... degrees of freedom is below at 95 % (Abramowitz & Stegun, table 26.8).
CHI_SQUARED = (3.841, 5.991, 7.815, 9.488, 11.070, 12.592, 14.067, 15.507, 16.919, 18.307,
               19.675, 21.026, 22.362, 23.685, 24.996, 26.296, 27.587, 28.869, 30.144, 31.410)  # fmt: skip


def blocked(values):
    """Of blocks of 1, 2, 4, ... neighbours the standard error of the mean, and the square of how far
    they correlate beyond chance, in its standard deviations."""
    blocks = np.asarray(values, dtype=float)
    while len(blocks) >= FEWEST_BLOCKS:
        n, away = len(blocks), blocks - np.mean(blocks)
        scatter = float(np.sum(away * away))
        correlation = float(np.sum(away[1:] * away[:-1])) / scatter if scatter > 0.0 else 0.0
        yield np.sqrt(scatter / n / (n - 1)), n * (correlation + (n - 1) / n**2) ** 2
        blocks = 0.5 * (blocks[: n // 2 * 2 : 2] + blocks[1::2])


def mean_with_error(values):
    """Mean of a series at equal steps, and the standard error of the mean: that of the shortest
    blocks that, like all longer ones, do not correlate with their neighbours, at a confidence of
    95 %, as the program finds it (graupel/base/block_sums.h). Where even the longest do, the largest
    that the scatter of blocks gives.

    Source: Jonsson, Phys. Rev. E 98 (2018) 043304, doi:10.1103/PhysRevE.98.043304.
    """
    levels = list(blocked(values))
    error = max((error for error, _ in levels), default=0.0)
    away = 0.0
    for limit, (of_level, squared) in zip(CHI_SQUARED, reversed(levels)):
        away += squared
        if away <= limit:
            error = of_level
    return float(np.mean(values)), float(error)


def rms_with_error(values):
    """Root mean square of the deviation from the mean of a series at equal steps, and the
    standard error of it."""
    square, error = mean_with_error((values - np.mean(values)) ** 2)
    rms = float(np.sqrt(square))
    return rms, 0.5 * error / rms


def crossings_with_error(time, values):
    """How often in a second a series at equal steps comes up through its mean [Hz], and the
    standard error of it."""
    above = values > np.mean(values)
    step = (time[-1] - time[0]) / (len(time) - 1)
    return mean_with_error((above[1:] & ~above[:-1]) / step)


def at_equal_steps(time, values, count=4096):
    """A series that was written at unequal times, interpolated to equal steps."""
    times = np.linspace(time[0], time[-1], min(count, len(time)))
    return np.interp(times, time, values)
