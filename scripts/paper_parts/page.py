# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The page doc/paper/README.md: Table 1, what agrees and what does not, and the figures."""

import csv

from common.fluidisation import ergun_onset, fixed_cases, onset, plateau, supported_drop
from common.markdown import image, percent, span, table, verdict
from graupel.report.reference import PAPER_VESSEL, ergun_curve, paper_for
from common.runs import case_at
from graupel.report.style import MILLI

from .runs import drop_at, over, rise

COMMAND = "scripts/reproduce-paper"
# What each part of the page is made of; the command of each run stands in that script.
SOURCES = (
    ("Table 1, figures 3, 4, 6 to 9, 11, 12, cost", "`1x`, `2x`, `2x-printed`"),
    ("Onset, figures 5, 6, 10, 11", "`1x-onset`, `2x-onset`, `1x-onset-aluminium`,"
     " `2x-onset-aluminium`"),
    ("Any scale", "`1x`, `1.5x`, `ladder/level-3`, `-2`, `-1`, `50mm`"),
    ("The original bed", "`original-bed/level-3`, `-2`, `-1`, `2x-original-onset` and so on"),
    ("The ladder", "`ladder/study.csv`, `1x`"),
    ("The resting bed", "`2x`, `2x-moving`"),
)


def deviations(run):
    """Deviation from Ergun of the cases in which the bed rests."""
    return [case["deviation_from_ergun"] for case in fixed_cases(run)]


def table_1(runs, folder):
    """The paper's Table 1 with our columns; also as table1.csv."""
    header = [
        "case",
        "V_s [m/s]",
        "void fraction, paper",
        "here",
        "Ergun [Pa], paper",
        "Ergun [Pa], here",
        "computed [Pa]",
        "deviation",
        "of it wall",
        "printed closure",
        "1100 kg/m³ [Pa]",
        "deviation",
    ]
    rows = []
    for scale in (1, 2):
        run, light = runs[f"{scale}x"], runs[f"{scale}x-onset"]
        paper = paper_for(run)
        printed = runs["2x-printed"] if scale == 2 else None
        for number, velocity in enumerate(paper.velocity):
            case = case_at(run, velocity)
            row = [
                paper.names[number] + ("" if scale == 1 else "_2x"),
                f"{velocity:.3f}",
                f"{paper.void_fraction[number]:.3f}",
                f"{case['mean_void_fraction']:.4f}",
                f"{paper.ergun[number]:.1f}",
                f"{case['ergun_pressure_drop']:.1f}",
                f"{case['pressure_drop']:.1f}",
                percent(case["deviation_from_ergun"], 2),
                percent(case["wall_channelling_deviation"], 2),
                percent(case_at(printed, velocity)["deviation_from_ergun"]) if printed else "",
            ]
            same = [c for c in light.cases if abs(c["superficial_velocity"] - velocity) < 1e-6]
            row += (
                [f"{same[0]['pressure_drop']:.1f}", percent(same[0]["deviation_from_ergun"])]
                if same
                else ["", ""]
            )
            rows.append(row)
    with open(folder / "table1.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([header, *rows])
    return table(header, rows)


def line_by_line(runs):
    """What the paper says, what is found here, whether it agrees, and why not."""
    one, two, printed = runs["1x"], runs["2x"], runs["2x-printed"]
    d1, d2, dp = deviations(one), deviations(two), deviations(printed)
    between = max(d2) - min(d1), min(d2) - max(d1)
    excess = [
        p["pressure_drop"] / e["pressure_drop"] - 1.0 for p, e in zip(printed.cases, two.cases)
    ]
    rows = [
        [
            "1X: pressure drop within 2 % under Ergun before onset",
            span(d1, 2),
            verdict(-0.02 <= min(d1) and max(d1) <= 0.0),
            "wall: the looser packing there lets gas pass; Ergun over the radial void fraction"
            f" gives {span([c['wall_channelling_deviation'] for c in fixed_cases(one)], 2)}",
        ],
        [
            "2X, scaled: within 6 % over Ergun",
            f"{span(d2, 2)} with the exact closure, {span(dp)} with the printed one",
            verdict(max(dp) <= 0.06),
            f"the printed coefficient is too large by 7/3 - 1.75: it drops {span(excess)} more"
            " than the exact one; by the closure itself +8.6 to +12.7 %",
        ],
        [
            "difference between the scales under 8 %",
            f"{span(between, 2)} (2X less 1X, each from its own Ergun value)",
            verdict(max(abs(b) for b in between) < 0.08),
            "exact closure: no error of the scaling is left, only the beds differ",
        ],
    ]
    for scale in (1, 2):
        light, heavy = runs[f"{scale}x-onset"], runs[f"{scale}x-onset-aluminium"]
        paper = paper_for(light)
        at = case_at(light, paper.velocity[-1])
        rest = light.cases[0]
        rows += [
            [
                f"{scale}X: the bottom force falls monotonically with V_s (figure"
                f" {5 if scale == 1 else 10})",
                "1100 kg/m³: "
                + ", ".join(f"{c['bottom_force']:.3f}" for c in light.cases)
                + " N",
                verdict(
                    all(
                        b["bottom_force"] < a["bottom_force"] + 0.01 * a["weight"]
                        for a, b in zip(light.cases, light.cases[1:])
                    )
                ),
                "",
            ],
            [
                f"{scale}X: case 6 ({paper.velocity[-1]} m/s) has lifted: force on the bottom"
                f" {paper.onset_bottom_force} N, bed higher by"
                f" {paper.onset_rise * MILLI:.1f} mm",
                f"1100 kg/m³: {at['bottom_force']:.3f} N of {rest['weight']:.3f} N weight,"
                f" {rise(light, at) * MILLI:.1f} mm (median in time)",
                verdict(at["bottom_force"] < 0.1 * rest["weight"]),
                "the paper's aluminium cannot lift there: by Ergun it does at"
                f" {ergun_onset(heavy):.3f} m/s, here at {onset(heavy):.3f} m/s",
            ],
            [
                f"{scale}X: case 6 below Ergun"
                + (" by nearly 12 %" if scale == 1 else ""),
                f"{percent(at['pressure_drop'] / ergun_curve(light, paper.velocity[-1]) - 1.0)}"
                " from Ergun for the bed at rest",
                "in kind",
                "a lifted bed drops its weight over the cross-section, whatever V_s",
            ],
        ]
    return table(["the paper", "here", "agrees", "why"], rows)


def plateau_cells(lifted):
    """The columns of a lifted bed, dashes without one."""
    if lifted is None:
        return ["-"] * 4
    parts = (lifted.level - 1.0, lifted.on_bottom, lifted.on_wall)
    return [*map(percent, parts), f"{lifted.seconds:.1f}"]


def onset_table(runs):
    """Onset and plateau of all sweeps that reach it."""
    rows = []
    for name, label in (
        ("1x-onset", "1X, 1100 kg/m³"),
        ("2x-onset", "2X, 1100 kg/m³"),
        ("1x-onset-aluminium", "1X, 2700 kg/m³"),
        ("2x-onset-aluminium", "2X, 2700 kg/m³"),
    ):
        run = runs[name]
        ergun, here = ergun_onset(run), onset(run)
        rows.append(
            [
                label,
                f"{run.number('bed', 'mean_void_fraction'):.4f}",
                f"{ergun:.4f}",
                f"{here:.4f}",
                percent(here / ergun - 1.0),
                f"{supported_drop(run):.1f}",
                *plateau_cells(plateau(run)),
                f"{max(rise(run, c) for c in run.cases) * MILLI:.1f}",
            ]
        )
    return table(
        [
            "bed",
            "void fraction at rest",
            "Ergun's onset [m/s]",
            "onset here [m/s]",
            "difference",
            "weight / area [Pa]",
            "plateau over that",
            "weight on the bottom",
            "on the wall",
            "mean over [s]",
            "largest rise [mm]",
        ],
        rows,
    )


def cost_table(runs):
    """CPU time of a case against the paper's."""
    rows = []
    for scale in (1, 2):
        run = runs[f"{scale}x"]
        each = [case["cpu_seconds"] for case in run.cases]
        rows.append(
            [
                f"{scale}X",
                f"{min(each):.0f} to {max(each):.0f} s",
                paper_for(run).cpu_hours,
                f"{run.number('cost', 'wall_seconds') / 60.0:.1f} min",
                f"{run.number('cost', 'cpu_seconds') / 60.0:.1f} min",
            ]
        )
    one, two = (
        sum(case["cpu_seconds"] for case in runs[name].cases) for name in ("1x", "2x")
    )
    whole = runs["1x"].number("cost", "cpu_seconds") / runs["2x"].number("cost", "cpu_seconds")
    return (
        table(
            [
                "scale",
                "CPU time a flow case",
                "the paper's",
                "whole sweep, packing included",
                "CPU time of that",
            ],
            rows,
        )
        + f"\n\nCPU time of 1X over 2X: {one / two:.1f} for the flow cases, {whole:.1f} for the"
        " whole runs (the paper: 18 to 24). The paper's ratio is that of the particles, which"
        " were its cost; here the resting bed costs no particle steps, and what remains is the"
        " ratio of the meshes."
    )


def scales_table(runs_by_scale):
    """Deviation from Ergun at every scale."""
    rows = [
        [
            f"{scale:g}",
            f"{run.number('bed', 'particle_count'):,.0f}",
            f"{run.number('bed', 'mean_void_fraction'):.4f}",
            span(deviations(run), 2),
        ]
        for scale, run in runs_by_scale
    ]
    return table(["s", "spheres", "void fraction", "deviation from Ergun"], rows)


def original_table(runs, plain, corrected):
    """Pressure drop and onset of corrected beds against the 1X simulation."""
    one, light = runs["1x"], runs["1x-onset"]
    rows = []
    for (scale, run), (_, other) in zip(corrected, plain):
        sweep = runs[f"{scale}x-original-onset"]
        rows.append(
            [
                scale,
                f"{run.number('bed', 'original_solid_ratio'):.4f}",
                span(over(one, other)),
                span(over(one, run)),
                f"{onset(sweep):.4f}",
                percent(onset(sweep) / onset(light) - 1.0),
            ]
        )
    return table(
        [
            "s",
            "solid fraction of the law over the bed's",
            "pressure drop over 1X, uncorrected",
            "corrected",
            f"onset, 1100 kg/m³ [m/s] (1X: {onset(light):.4f})",
            "over 1X",
        ],
        rows,
    )


def ladder_table(runs):
    """The ladder's extrapolation against the 1X simulation."""
    one = runs["1x"]
    rows = []
    for row in runs.study("ladder"):
        if row["extrapolated"] is None or not row["quantity"].startswith("pressure drop at "):
            continue
        velocity = float(row["quantity"].split()[3])
        true = drop_at(one, velocity)
        error = row["extrapolated"] * row["grid_convergence_index"]
        rows.append(
            [
                f"{velocity:.3f}",
                f"{row['extrapolated']:.1f} ± {error:.1f}",
                f"{true:.1f}",
                verdict(abs(true - row["extrapolated"]) <= error),
            ]
        )
    return table(["V_s [m/s]", "ladder s = 4, 3, 2 to 1 [Pa]", "1X [Pa]", "inside"], rows)


def frozen_table(runs):
    """Steady flow through the resting bed against the moving one."""
    rows = []
    for case in runs["2x-moving"].cases:
        still = case_at(runs["2x"], case["superficial_velocity"])
        rows.append(
            [
                f"{case['superficial_velocity']:.3f}",
                f"{still['pressure_drop']:.2f}",
                f"{case['pressure_drop']:.2f}",
                percent(still["pressure_drop"] / case["pressure_drop"] - 1.0, 3),
                f"{still['cpu_seconds']:.0f}",
                f"{case['cpu_seconds']:.0f}",
            ]
        )
    return table(
        [
            "V_s [m/s]",
            "resting bed [Pa]",
            "moving bed [Pa]",
            "difference",
            "CPU [s]",
            "CPU, moving [s]",
        ],
        rows,
    )


def page(runs, folder, figures, plain, corrected, runs_by_scale):
    """The whole page as Markdown."""
    fifty = runs["50mm"]
    parts = [
        "# The paper, reproduced\n",
        "M. Ricklick, O. Baran, *Analytical Scaling of DEM Particles for Efficient Packed-Bed"
        f" Simulations* (2014). Everything on this page is made by `{COMMAND}`; nothing is"
        " entered by hand. Cases are driven by the superficial velocity, as the paper's printed"
        " mass flows belong to another diameter than its vessel of"
        f" {PAPER_VESSEL * MILLI:.0f} mm.\n",
        "## Table 1\n",
        table_1(runs, folder),
        "\nDeviations are from Ergun's equation with the bed's own height and mean void fraction."
        " \"Of it wall\": Ergun's equation over annuli of the measured radial void fraction that"
        " share one pressure gradient. \"1100 kg/m³\": the sweep in which the bed lifts, where it"
        " has that velocity. Packing friction 0.15 gives both beds the paper's void fraction"
        " (`prm/packed-bed/ricklick-2x.prm`).\n",
        "## What agrees, line by line\n",
        line_by_line(runs),
        "\n## Onset of fluidisation\n",
        onset_table(runs),
        "\nOnset is where the line of the fixed bed, a V + b V² through the cases in which the"
        " fluid carries less than 86 % of the weight, meets the weight less buoyancy over the"
        " cross-section, as it is measured in the laboratory. Ergun's onset is for the bed at"
        " rest. A lifted bed rises and falls as slugs, so that the plateau is the mean over the"
        " second half of the fastest case; what then rests on the bottom and hangs on the wall is"
        " the rest of the bed's weight.\n",
        "## Cost\n",
        cost_table(runs),
        "\n## Any scale\n",
        scales_table(runs_by_scale),
        "\nIn a vessel of 50 mm (s = 2, "
        f"{fifty.number('bed', 'particle_count'):,.0f} spheres, void fraction"
        f" {fifty.number('bed', 'mean_void_fraction'):.4f}) the deviation is"
        f" {span(deviations(fifty), 2)}.\n",
        "## The pressure drop of the original bed\n",
        original_table(runs, plain, corrected),
        "\nLarger spheres pack looser at the wall and drop less pressure at the same velocity."
        " Corrected, the drag law is evaluated at the solid fraction that a short bed of the"
        " original particles has (`Original bed/void fraction = measured`).\n",
        "## The ladder\n",
        ladder_table(runs),
        "\nWithout any 1X particle: three packings each of s = 4, 3 and 2 (`prm/studies/ladder.prm`)."
        " The drop over Ergun's value is extrapolated to 1; it multiplies Ergun's value of the"
        " original bed, which each packing tells by its wall layer. The error joins the scatter"
        " of both with 1.25 times the difference between parabola and line."
        " The levels are packed in a vessel of 200 mm, the 1X bed in one of 169 mm, which packs"
        " it looser by 0.6 %.\n",
        "## The resting bed\n",
        frozen_table(runs),
        "\n## Where the numbers come from\n",
        table(["part", f"runs of `{COMMAND}`, in its directory of results"], SOURCES),
        "\n## Figures\n",
    ]
    parts += [image(name, text) for name, text in figures]
    return "\n".join(parts)
