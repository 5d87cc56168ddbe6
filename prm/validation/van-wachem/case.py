# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A slugging bed: van Wachem et al. (2001)."""

import numpy as np
from matplotlib.mlab import psd

from common.statistics import at_equal_steps, mean_with_error, rms_with_error
from graupel.report.style import BLUE, GREY, new_figure
from validation_parts.case import Comparison, Run, measured

TITLE = "Slugging bed of 90 mm x 8 mm at 0.9 m/s: height, pressure and its frequency"
SOURCE = (
    "van Wachem et al. (2001), digitised by others (prm/validation/van-wachem). The measured height is"
    " of 2 s, five slugs: the standard error of its mean is 0.003 m"
)

NAME = "0.9"
FROM = 2.0  # [s] since the flow began
RMS = 85.0  # of the measured pressure [Pa]


def runs(quick):
    """One of hours; a moment if quick."""
    if quick:
        return [Run(NAME, "van-wachem.prm", {"Flow/duration": 0.02})]
    return [Run(NAME, "van-wachem.prm", {}, is_long=True)]


def of_laboratory(quantity):
    """Abscissa and value of a measured quantity."""
    rows = [row for row in measured("van-wachem") if row["quantity"] == quantity]
    return np.array([(row["abscissa"], row["value"]) for row in rows]).T


def mean_height():
    """Mean of the measured height over the time that it covers [m]; the points are not even."""
    time, height = of_laboratory("bed_height")
    return float(np.mean(at_equal_steps(time, height)))


def rms_height():
    """Its rms about the mean [m]."""
    return float(np.std(at_equal_steps(*of_laboratory("bed_height"))))


def later(run):
    """Time, pressure at the port and height of the bed's surface at equal steps after FROM."""
    time = run.probes["time"]
    flow = run.monitors["phase"] == "flow"
    begin = min(time[0] + FROM, 0.5 * (time[0] + time[-1]))
    rows = time >= begin
    of_run = flow & (run.monitors["time"] >= begin)
    height = at_equal_steps(run.monitors["time"][of_run], run.monitors["bed_height"][of_run])
    pressure = run.probes["port_pressure"]
    equal = at_equal_steps(time[rows], pressure[rows])
    return np.linspace(time[rows][0], time[-1], len(equal)), equal, height


def dominant(time, values):
    """Where the spectrum of a series is highest [Hz]: mean of windowed halves that overlap
    (Welch 1967, doi:10.1109/TAU.1967.1161901)."""
    rate = (len(time) - 1) / (time[-1] - time[0])
    length = len(values) // 2
    power, frequency = psd(
        values, NFFT=length, noverlap=length // 2, Fs=rate, detrend="constant"
    )
    return float(frequency[1:][np.argmax(power[1:])])


def evaluate(results):
    """Height, frequency, and the rms."""
    if not results.has(NAME):
        return []
    time, pressure, height = later(results[NAME])
    mean, error = mean_with_error(height)
    frequency, density = of_laboratory("pressure_psd")
    return [
        Comparison("mean height", "m", mean_height(), mean, error, 0.10, decimals=4,
                   run=NAME),
        Comparison("frequency of the pressure", "Hz", float(frequency[np.argmax(density)]),
                   dominant(time, pressure), limit=0.15, decimals=2, run=NAME),
        Comparison("rms of the height", "m", rms_height(), *rms_with_error(height), decimals=4,
                   run=NAME),
        Comparison("rms of the pressure at 45 mm", "Pa", RMS, *rms_with_error(pressure),
                   decimals=1, run=NAME),
    ]  # fmt: skip


def figure(results):
    """Height in time, measured and ours."""
    time, _, height = later(results[NAME])
    picture = new_figure()
    axes = picture.subplots()
    at, value = of_laboratory("bed_height")
    axes.plot(at - at[0], value * 1e3, color=GREY, label="measured")
    axes.plot(np.linspace(0.0, time[-1] - time[0], len(height)), height * 1e3, color=BLUE, label="ours")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("height of the bed [mm]")
    axes.legend()
    return picture
