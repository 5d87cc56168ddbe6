#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Writes doc/paper/ from the runs of scripts/reproduce-paper.

    scripts/paper.py RESULTS [FOLDER]

README.md holds the paper's Table 1 with ours beside it, what agrees line by line, and the
figures; table1.csv the table. Needs Debian's python3-matplotlib. Exit status: 0 if all was
written, 1 if a run is missing.
"""

import argparse
import sys
from pathlib import Path

try:
    from common.runs import Runs
    from graupel.report.reference import paper_for
    from graupel.report.style import ORANGE, VERMILLION, render
    from paper_parts import figures, page
except ImportError as error:
    sys.exit(f"paper.py: {error}. It needs Debian's python3-matplotlib.")

ROOT = Path(__file__).resolve().parents[1]


def all_figures(runs, plain, corrected, runs_by_scale):
    """Name, caption and figure of each picture."""
    one, two = runs["1x"], runs["2x"]
    onset = {scale: runs[f"{scale}x-onset"] for scale in (1, 2)}
    heavy = {scale: runs[f"{scale}x-onset-aluminium"] for scale in (1, 2)}
    papers = {1: paper_for(one), 2: paper_for(two)}
    printed = runs["2x-printed"]
    yield "figure-03", "Figure 3: the 1X bed beside the 2X bed.", figures.beds(one, two)
    yield "figure-04", "Figure 4: pressure profile, 1X, case 1.", figures.pressure_profile(one)
    yield (
        "figure-05",
        "Figure 5: force on the bottom, 1X. Hollow: the bed has lifted.",
        figures.bottom_force(onset[1], heavy[1], papers[1]),
    )
    yield (
        "figure-06",
        "Figure 6: pressure drop against Ergun, 1X.",
        figures.pressure_drop(one, onset[1], papers[1]),
    )
    yield "figure-07", "Figure 7: percent error, 1X.", figures.percent_error(one, papers[1])
    yield (
        "figure-08",
        "Figure 8: void fraction on the mid-plane, 1X, as the drag's filter sees it.",
        figures.void_fraction(one),
    )
    yield "figure-09", "Figure 9: pressure profile, 2X, case 1.", figures.pressure_profile(two)
    yield (
        "figure-10",
        "Figure 10: force on the bottom, 2X. Hollow: the bed has lifted.",
        figures.bottom_force(onset[2], heavy[2], papers[2]),
    )
    yield (
        "figure-11",
        "Figure 11: pressure drop against Ergun, 2X, exact and printed closure.",
        figures.pressure_drop(
            two, onset[2], papers[2], [(printed, ORANGE, "printed closure, 2700 kg/m³")]
        ),
    )
    yield (
        "figure-12",
        "Figure 12: percent error, 2X, exact and printed closure.",
        figures.percent_error(two, papers[2], [(printed, VERMILLION, "printed closure")]),
    )
    yield (
        "figure-scales",
        "Beyond the paper: deviation from Ergun at every scale, exact closure. Grey: 2 %.",
        figures.scales(runs_by_scale),
    )
    yield (
        "figure-original-bed",
        "Beyond the paper: pressure drop of scaled beds over that of the 1X bed.",
        figures.original_bed(one, plain, corrected),
    )


def main():
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(description="Writes doc/paper/ from the paper's runs.")
    parser.add_argument("results", type=Path, help="directory of scripts/reproduce-paper")
    parser.add_argument("folder", type=Path, nargs="?", default=ROOT / "doc" / "paper")
    arguments = parser.parse_args()
    runs = Runs(arguments.results, page.COMMAND)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    try:
        plain = [(s, runs[f"ladder/level-{n}"]) for s, n in ((2, 3), (3, 2), (4, 1))]
        corrected = [(s, runs[f"original-bed/level-{n}"]) for s, n in ((2, 3), (3, 2), (4, 1))]
        by_scale = [(1.0, runs["1x"]), (1.5, runs["1.5x"]), *plain]
        shown = []
        for name, caption, figure in all_figures(runs, plain, corrected, by_scale):
            render(figure, name, arguments.folder)
            shown.append((name, caption))
        text = page.page(runs, arguments.folder, shown, plain, corrected, by_scale)
    except FileNotFoundError as error:
        print(f"paper.py: {error}", file=sys.stderr)
        return 1
    (arguments.folder / "README.md").write_text(text, encoding="utf-8")
    print(arguments.folder / "README.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
