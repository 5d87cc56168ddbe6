# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Means over time, and how far they can be trusted."""

import numpy as np

FEWEST_BLOCKS = 8


def mean_with_error(values):
    """Mean of a series at equal steps, and the standard error of the mean.

    Blocks of 1, 2, 4, ... neighbours are averaged until FEWEST_BLOCKS remain; the largest
    error that the scatter of the blocks gives is taken, as neighbours are correlated.
    Source: Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461, doi:10.1063/1.457480.
    """
    blocks = np.asarray(values, dtype=float)
    mean, error = float(np.mean(blocks)), 0.0
    while len(blocks) >= FEWEST_BLOCKS:
        error = max(error, float(np.std(blocks, ddof=1) / np.sqrt(len(blocks))))
        blocks = 0.5 * (blocks[: len(blocks) // 2 * 2 : 2] + blocks[1::2])
    return mean, error


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
