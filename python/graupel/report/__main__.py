# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Writes report.html from the output directory of a run, or a page that compares runs.

    scripts/report DIR                          (installed: graupel-report)
    scripts/report DIR DIR... [--output FILE]

The report is one file with its figures inside; they also go to DIR/figures as PNG. What is
missing in the directory is named on standard error and in the report, and the rest is
shown. Several runs are compared on one page, by default comparison.html in the folder where
it is called. Needs Debian's python3-matplotlib. Exit status: 0 if a page was written, 1 if
nothing of a run was found or the page could not be written, 2 for a wrong call.
"""

import argparse
import sys
from pathlib import Path

from ..run import read_run

try:
    from . import comparison, figures_averages, figures_bed, figures_inside, figures_run
    from . import figures_settled, figures_time, page, reference, study, style
except ImportError as error:
    sys.exit(f"report: {error}. The report needs matplotlib: apt-get install python3-matplotlib.")

FIGURES = {
    "pressure-profile": figures_bed.pressure_profile,
    "pressure-drop": figures_bed.pressure_drop,
    "deviation": figures_bed.deviation,
    "bottom-force": figures_bed.bottom_force,
    "bed-height": figures_bed.bed_height,
    "void-fraction": figures_inside.void_fraction,
    "flux": figures_inside.flux,
    "radial": figures_inside.radial,
    "bubbles": figures_averages.bubbles,
    "averages-lines": figures_averages.lines,
    "averages-planes": figures_averages.planes,
    "averages-midplane": figures_averages.midplane,
    "spectra": figures_averages.spectra,
    "bed-radial": figures_settled.bed_radial,
    "bed-janssen": figures_settled.bed_janssen,
    "monitors": figures_run.monitors,
    "wall-forces": figures_time.wall_forces,
    "particle-number": figures_time.particle_number,
    "probes": figures_time.probes,
    "cost": figures_run.cost,
}


def make_figures(run, paper, folder):
    """Every figure rendered, or the reason why it is not there, by name; None where the run
    has nothing of the kind."""
    folder.mkdir(exist_ok=True)
    shown = {}
    for name, make in FIGURES.items():
        try:
            shown[name] = style.render(make(run, paper), name, folder)
        except style.NotOfThisRun:
            shown[name] = None
        except style.NothingToShow as reason:
            shown[name] = str(reason)
        # One figure that cannot be drawn from odd data must not take the
        # others with it; the reader is told.
        except Exception as error:
            shown[name] = f"{type(error).__name__}: {error}"
            run.notices.append(f"The figure {name} could not be drawn ({shown[name]}).")
        if not isinstance(shown[name], style.Rendered):
            # A figure of an earlier report would pass for one of this run.
            (folder / f"{name}.png").unlink(missing_ok=True)
    return shown


def write_report(directory):
    """Reads the run in @p directory and writes its report; returns the exit status."""
    if (directory / "study.csv").exists():
        study.write_report(directory)
        print(directory / "report.html")
        return 0
    run = read_run(directory)
    if run.empty():
        print(f"report: {directory} holds no output of a run.", file=sys.stderr)
        return 1
    paper = reference.chosen_paper(run)
    try:
        figures = make_figures(run, paper, directory / "figures")
        (directory / "report.html").write_text(page.page(run, paper, figures), encoding="utf-8")
    except OSError as error:
        print(f"report: the report cannot be written: {error}.", file=sys.stderr)
        return 1
    for notice in run.notices:
        print(f"report: {notice}", file=sys.stderr)
    print(directory / "report.html")
    return 0


def write_comparison(directories, target):
    """Writes the page that compares the runs; returns the exit status."""
    runs = [read_run(directory) for directory in directories]
    for run in runs:
        if run.empty():
            print(f"report: {run.directory} holds no output of a run.", file=sys.stderr)
            return 1
    try:
        target.write_text(comparison.comparison(runs), encoding="utf-8")
    except OSError as error:
        print(f"report: the page cannot be written: {error}.", file=sys.stderr)
        return 1
    print(target)
    return 0


def main():
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="report", description="Writes report.html of a run, or a page that compares runs."
    )
    parser.add_argument(
        "directories", type=Path, nargs="+", metavar="DIR", help="output directory of a run"
    )
    parser.add_argument(
        "--output", type=Path, default=Path("comparison.html"), metavar="FILE",
        help="page of several runs (default: comparison.html)",
    )  # fmt: skip
    arguments = parser.parse_args()
    for directory in arguments.directories:
        if not directory.is_dir():
            parser.error(f"{directory} is no directory")
    if len(arguments.directories) == 1:
        return write_report(arguments.directories[0])
    return write_comparison(arguments.directories, arguments.output)


if __name__ == "__main__":
    sys.exit(main())
