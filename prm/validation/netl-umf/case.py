# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Minimum fluidisation of polyethylene beads, measured at NETL, from scaled spheres."""

from common.fluidisation import ergun_onset, onset
from common.force_balance import Suspension, ergun
from graupel.report.style import BLUE, GREY, VERMILLION, new_figure
from validation_parts.case import Comparison, Run, measured

TITLE = "Onset of polyethylene beads of 0.87 mm, spheres of scale 4, 3, 2 and 1"
SOURCE = "Ergun's at the bed's own void fraction; measured 0.182 m/s (NETL, prm/validation/netl-umf)"

AREA = 0.0508**2
COUNTS = {4: 4234, 3: 10036, 2: 33870, 1: 270960}
LONG = (2, 1)
LIMIT = 0.03


def name_of(scale):
    """The run's name."""
    return f"scale-{scale}"


def runs(quick):
    """The same mass as spheres of each scale; a sixteenth of it if quick."""
    scales = (4,) if quick else tuple(COUNTS)
    return [
        Run(name_of(s), "netl.prm",
            {"Particles/scale": s, "Filling/count": COUNTS[s] // (16 if quick else 1)},
            is_long=s in LONG)
        for s in scales
    ]  # fmt: skip


def of_laboratory():
    """The measured onset [m/s]."""
    rows = {row["item"]: row["value"] for row in measured("netl-umf")}
    return rows["minimum fluidisation velocity"]


def evaluate(results):
    """Against Ergun at the bed's void fraction, which is shown, and the laboratory."""
    rows = []
    for scale in COUNTS:
        if not results.has(name_of(scale)):
            continue
        run = results[name_of(scale)]
        here = onset(run, AREA)
        rows += [
            Comparison(f"onset at scale {scale}, Ergun", "m/s", ergun_onset(run, AREA), here,
                       limit=LIMIT, decimals=4, run=name_of(scale)),
            Comparison(f"onset at scale {scale}, measured", "m/s", of_laboratory(), here, decimals=4,
                       run=name_of(scale)),
            Comparison(f"void fraction at scale {scale}, that of Ergun's at 0.182 m/s", "-", 0.382,
                       run.number("bed", "mean_void_fraction"), relative=False, decimals=4,
                       run=name_of(scale)),
        ]  # fmt: skip
    return rows


def figure(results):
    """Onset against the void fraction: Ergun's curve, ours, the measured one."""
    picture = new_figure()
    axes = picture.subplots()
    bed = Suspension(ergun, 0.87e-3, 860.0, 1.0, 1.8e-5)
    alphas = [0.36 + 0.002 * k for k in range(41)]
    axes.plot(alphas, [bed.superficial_velocity(a) for a in alphas], color=GREY, label="Ergun")
    axes.axhline(of_laboratory(), color=VERMILLION, label="measured")
    for scale in COUNTS:
        if results.has(name_of(scale)):
            run = results[name_of(scale)]
            void = run.number("bed", "mean_void_fraction")
            axes.plot([void], [onset(run, AREA)], "o", color=BLUE)
            axes.annotate(f" s = {scale}", (void, onset(run, AREA)))
    axes.set_xlabel("mean void fraction at rest [-]")
    axes.set_ylabel("onset of fluidisation [m/s]")
    axes.legend()
    return picture
