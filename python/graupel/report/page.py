# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The page: sections and captions. Nothing in it is fetched from elsewhere."""

import json
from html import escape
from pathlib import Path, PurePath

from . import tables, words

FOLDER = Path(__file__).parent
STYLE = (FOLDER / "page.css").read_text(encoding="utf-8")
SCRIPT = (FOLDER / "page.js").read_text(encoding="utf-8")


def title_of(run):
    """What the run is called: the name of its parameter file, or of its directory."""
    prm = run.get("program", "parameter_file")
    name = PurePath(prm).name if isinstance(prm, str) and prm else run.directory.resolve().name
    return f"Graupel: {name}"


def program_line(run):
    """Version, deal.II and ranks."""
    name = run.get("program", "name") or "graupel"
    parts = [f"{name} {run.get('program', 'version') or words.NONE}"]
    parts.append(f"deal.II {run.get('program', 'deal_ii_version') or words.NONE}")
    ranks = run.number("program", "mpi_ranks")
    parts.append(f"{words.number(ranks, '.0f')} MPI process{'' if ranks == 1 else 'es'}")
    parts.append(f"parameter file {run.get('program', 'parameter_file') or words.NONE}")
    return ", ".join(str(part) for part in parts)


def captions(run, paper):
    """Caption of every figure, by the name of the figure."""
    of_paper = f" Diamonds: the paper, {paper.scale}X." if paper else ""
    return {
        "pressure-profile": "<b>Pressure along the axis.</b> Averages over the cross-section"
        " (lines) against Ergun's straight line with the bed's own height and mean void fraction"
        " (dashed); below, the void fraction.",
        "pressure-drop": "<b>Pressure drop against superficial velocity.</b> Hollow circles: the"
        " bed has lifted. The grey curve is Ergun's equation for the bed before the flow, the"
        " dashes use the height and void fraction of each case." + of_paper,
        "deviation": caption_of_deviation(paper),
        "bottom-force": caption_of_forces(paper),
        "bed-height": "<b>Bed height.</b> The height is where the section-averaged solid fraction"
        " falls to half of its bulk value." + of_paper,
        "void-fraction": "<b>Void fraction on the plane y = 0,</b> lengths to scale. Dotted: bed"
        " height. The colours are chosen for the bed; the clear fluid above it (void fraction 1)"
        " lies beyond their end.",
        "flux": "<b>Axial volumetric flux on the plane y = 0,</b> over the superficial velocity."
        " Red: more than the average passes there.",
        "radial": "<b>From the wall inwards.</b> Averages over the middle half of the bed's height"
        " and around the axis: void fraction (left) and axial volumetric flux over the superficial"
        " velocity (right).",
        "bubbles": "<b>Bubbles.</b> Void fraction on the plane y = 0 at some moments of the last"
        " case, and the pressure drop, dotted where they are.",
        "averages-lines": "<b>Means along lines,</b> over the window of the averages, of the last"
        " case. Solid fraction from spheres cut by the bins, and from the void fraction on the"
        " mesh; bands are the rms about the mean, over time for the solid fraction and over time"
        " and particles for the velocity.",
        "averages-planes": "<b>Means over planes,</b> of the last case: solid fraction, and arrows"
        " along which the solid moves.",
        "averages-midplane": "<b>Mean void fraction on the plane y = 0,</b> over the window of the"
        " averages, lengths to scale.",
        "spectra": "<b>Spectra over the window of the averages,</b> of the last case: power by"
        " frequency, over the whole power of each quantity (Welch's method).",
        "bed-radial": "<b>Void fraction of the settled bed from the wall inwards.</b> Spheres cut"
        " exactly, over the middle half of the bed's height; dashed: de Klerk's correlation (2003)"
        " with the bulk void fraction of this bed.",
        "bed-janssen": "<b>Who carries the weight of the settled bed.</b> Left: vertical stress"
        " against height, Janssen's formula with the friction that the wall has mobilised, and the"
        " stress without a wall. Right: at every plane, the weight above it and the loads that"
        " carry it.",
        "monitors": "<b>The run over time.</b> Every fluid step; shading and the names on top tell"
        " the phases, and the numbers the flow cases. Speeds, energies and imbalances are on"
        " logarithmic axes, without their zeros.",
        "wall-forces": "<b>Forces of particles and fluid on each wall,</b> along the axis; positive"
        " presses down.",
        "particle-number": "<b>How many particles there are,</b> were fed and have left.",
        "probes": "<b>What the probes saw,</b> each at its point.",
        "cost": f"<b>Where the time went.</b> {escape(words.cost_sentence(run, paper))}",
    }


def caption_of_forces(paper):
    """Caption of the forces on bottom and wall, with the paper's findings if they apply."""
    text = (
        "<b>What bottom and wall carry.</b> Positive presses down on the bottom, or hangs on the"
        " wall; their sum must be the weight less the force of the fluid."
    )
    if paper is not None:
        text += (
            " The paper sees the bottom force fall monotonically to zero at onset; it counts it"
            f" negative (\u2212{paper.onset_bottom_force:.3f} N there). Its onset fits particles of"
            f" about {paper.density_at_onset:,.0f} kg/m\u00b3; those of the aluminium that it names"
            " would lift later."
        )
    return text.replace(" N ", "\u00a0N ")


def caption_of_deviation(paper):
    """Caption of the deviation from Ergun, with the paper's findings if they apply."""
    text = (
        "<b>Deviation from Ergun's equation,</b> each with its own void fraction: pressure drop"
        " over the whole bed, gradient over its middle half, and what Ergun's equation predicts"
        " when it is summed over the radial void-fraction profile. Hollow: the bed has lifted,"
        " and Ergun's equation no longer applies."
    )
    if paper is not None:
        text += (
            f" Grey: the paper's cases before onset at {paper.scale}X, {paper.band_in_words};"
            " it finds up to 8 % between the two scales."
        )
        if paper.onset_deviation is not None:
            text += (
                f" At onset, {paper.onset_velocity:.3f} m/s, it reports nearly"
                f" {abs(paper.onset_deviation) * 100:.0f} % under Ergun."
            )
    return text.replace(" %", "\u00a0%")


SECTIONS = (
    ("Pressure", ("pressure-profile", "pressure-drop")),
    ("Deviation from Ergun", ("deviation",)),
    ("Forces and lift", ("bottom-force", "bed-height")),
    ("Inside the bed", ("void-fraction", "flux", "radial")),
    (
        "The moving bed",
        ("bubbles", "averages-lines", "averages-planes", "averages-midplane", "spectra"),
    ),
    ("The settled bed", ("bed-radial", "bed-janssen")),
    ("Over time", ("monitors", "wall-forces", "particle-number", "probes")),
    ("Cost", ("cost",)),
)


def figures_of(names, figures, caption, count):
    """The figures of a section as HTML; count[0] is the number of the last figure."""
    lines = []
    for name in names:
        shown = figures[name]
        if shown is None:
            continue
        if isinstance(shown, str):
            heading = name.replace("-", " ").capitalize()
            lines.append(f'<p class="absent">{heading}: not shown; {escape(shown)}.</p>')
            continue
        count[0] += 1
        lines.append(figure(name, shown, f"Figure {count[0]}. {caption[name]}"))
    return lines


def figure(name, shown, caption):
    """A Rendered figure as HTML, with what the script shows of it under the pointer."""
    svg = shown.svg.replace("<svg", f'<svg role="img" aria-label="{name.replace("-", " ")}"', 1)
    # In a script, "</" would end it.
    data = json.dumps(shown.hover, separators=(",", ":")).replace("</", "<\\/")
    return (
        f'<figure id="{name}">{svg}<figcaption>{caption}</figcaption>'
        f'<script type="application/json" class="hover">{data}</script></figure>'
    )


def chooser(run):
    """Buttons that leave one flow case alone in tables and figures; the script shows them."""
    if len(run.cases) < 2:
        return []
    buttons = ['<button value="">all</button>']
    buttons += [
        f'<button value="{number}" title="{words.velocity_of(case)}">{number}</button>'
        for number, case in ((case["number"], case) for case in run.cases)
    ]
    return [f'<div id="chooser" hidden>Flow case: {"".join(buttons)}</div>']


def notices_of(run):
    """What could not be read, as HTML."""
    if not run.notices:
        return []
    items = "".join(f"<li>{escape(notice)}</li>" for notice in run.notices)
    return [f'<div class="notices"><p>This report is not complete:</p><ul>{items}</ul></div>']


def cases_section(run, paper):
    """The tables of cases, and the paper's values."""
    lines = ["<h2>Cases</h2>", tables.pressure_and_bed(run), tables.forces_and_cost(run)]
    lines.append(
        '<p class="note">Ergun: original particle diameter, superficial velocity, and the height'
        " and mean void fraction of the bed in that case. Middle half: the pressure gradient there"
        " against Ergun's at the void fraction there. Bottom, wall and fluid together must carry"
        " the weight.</p>"
    )
    if paper is not None:
        lines.append(tables.papers_values(run, paper))
        lines.append(
            f'<p class="note">Ricklick and Baran (2014), Table 1, scale {paper.scale}X; Ergun\'s'
            " value there uses the void fraction of their bed.</p>"
        )
    return lines


def page(run, paper, figures):
    """The whole report as HTML; a figure is a Rendered, the reason why there is none, or None
    where the run has nothing of the kind."""
    title = escape(title_of(run))
    caption = captions(run, paper)
    count = [0]
    body = [f"<h1>{title}</h1>", f'<p class="under">{escape(program_line(run))}</p>']
    body.append(f'<p class="summary">{escape(words.summary(run))}</p>')
    body += notices_of(run)
    body += chooser(run)
    if run.has_flow():
        body += cases_section(run, paper)
    for heading, names in SECTIONS:
        if all(figures[name] is None for name in names):
            continue
        body.append(f"<h2>{heading}</h2>")
        if heading == "The moving bed":
            body.append(tables.means_over_time(run))
        body += figures_of(names, figures, caption, count)
        if heading == "Deviation from Ergun" and words.wall_is_known(run):
            body.append(f"<p>{escape(words.what_is_left(run))}</p>")
            body.append(tables.deviation_in_parts(run))
    body.append(
        "<footer>The numbers are in summary.json and the CSV files beside this page, all values of"
        " the parameters in parameters.prm, the figures as PNG in figures/.</footer>"
    )
    return whole(title, body)


def whole(title, body):
    """A page of that title (escaped) from the lines of its body."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n"
        + "\n".join(body)
        + f"\n</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    )
