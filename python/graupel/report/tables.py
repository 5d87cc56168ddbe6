# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The tables of the report, as HTML."""

from html import escape

import numpy as np

from . import reference

from . import words

NO_CASES = '<p class="absent">No flow case was found.</p>'


def table(groups, heads, rows, cases=()):
    """An HTML table: groups of columns [(title, count)], heads [(name, unit)], rows of text;
    @p cases has the number of the flow case of each row, where there is one."""
    lines = ['<div class="wide"><table>', "<thead>"]
    if groups:
        cells = "".join(
            f'<th colspan="{count}" class="group">{title}</th>' for title, count in groups
        )
        lines.append(f"<tr>{cells}</tr>")
    cells = "".join(f"<th>{name}<span>{unit}</span></th>" for name, unit in heads)
    lines += [f"<tr>{cells}</tr>", "</thead>", "<tbody>"]
    for row, case in zip(rows, cases or [None] * len(rows)):
        mark = "" if case is None else f' data-case="{case}"'
        cells = "".join(f"<td>{escape(str(cell))}</td>" for cell in row)
        lines.append(f"<tr{mark}>{cells}</tr>")
    lines += ["</tbody>", "</table></div>"]
    return "\n".join(lines)


def numbers_of(run):
    """The numbers of the cases."""
    return [case["number"] for case in run.cases]


def pressure_and_bed(run):
    """Table of cases: pressure drop and bed."""
    if not run.cases:
        return NO_CASES
    heads = [
        ("case", ""),
        ("V<sub>s</sub>", "m/s"),
        ("computed", "Pa"),
        ("Ergun", "Pa"),
        ("whole bed", "%"),
        ("middle half", "%"),
        ("wall predicts", "%"),
        ("height", "mm"),
        ("rise", "mm"),
        ("void fraction", "-"),
        ("lifted", ""),
        ("steady", ""),
    ]
    rows = [
        [
            case["number"],
            words.number(case["superficial_velocity"], ".3f"),
            words.number(case["pressure_drop"], ".1f"),
            words.number(case["ergun_pressure_drop"], ".1f"),
            words.number(case["deviation_from_ergun"], "+.2f", 100.0),
            words.number(case["gradient_deviation_from_ergun"], "+.2f", 100.0),
            words.number(case["wall_channelling_deviation"], "+.2f", 100.0),
            words.number(case["bed_height"], ".2f", 1e3),
            words.number(case["bed_rise"], ".2f", 1e3),
            words.number(case["mean_void_fraction"], ".4f"),
            words.flag(case["fluidized"]),
            words.flag(case["steady"]),
        ]
        for case in run.cases
    ]
    groups = [("", 2), ("pressure drop", 2), ("deviation from Ergun", 3), ("bed", 3), ("state", 2)]
    return table(groups, heads, rows, numbers_of(run))


def forces_and_cost(run):
    """Table of cases: balance of forces, simulated time and cost."""
    if not run.cases:
        return NO_CASES
    heads = [
        ("case", ""),
        ("V<sub>s</sub>", "m/s"),
        ("bottom", "N"),
        ("wall", "N"),
        ("fluid", "N"),
        ("weight", "N"),
        ("sum less weight", "% of weight"),
        ("simulated", "s"),
        ("wall clock", ""),
        ("CPU", ""),
    ]
    rows = [
        [
            case["number"],
            words.number(case["superficial_velocity"], ".3f"),
            words.number(case["bottom_force"], ".4f"),
            words.number(case["wall_force"], ".4f"),
            words.number(case["fluid_force"], ".4f"),
            words.number(case["weight"], ".4f"),
            words.number(imbalance(case), "+.2f", 100.0),
            words.number(case["simulated_time"], ".3f"),
            words.duration(case["wall_seconds"]),
            words.duration(case["cpu_seconds"]),
        ]
        for case in run.cases
    ]
    groups = [("", 2), ("forces along the axis", 5), ("time", 3)]
    return table(groups, heads, rows, numbers_of(run))


def imbalance(case):
    """What walls and fluid carry less the weight, over the weight; None if one is unknown."""
    keys = ["bottom_force", "wall_force"]
    if case.get("support_force") is not None:
        keys = ["support_force"]  # of all walls, bottom and lateral one among them
    forces = [case[key] for key in (*keys, "fluid_force", "weight")]
    if any(force is None for force in forces) or forces[-1] == 0.0:
        return None
    return (sum(forces[:-1]) - forces[-1]) / forces[-1]


def papers_values(run, paper):
    """The paper's Table 1 at this scale, with this run's case at the same velocity beside it."""
    heads = [
        ("case", ""),
        ("V<sub>s</sub>", "m/s"),
        ("void fraction", "-"),
        ("Ergun", "Pa"),
        ("void fraction", "-"),
        ("Ergun", "Pa"),
        ("computed", "Pa"),
    ]
    rows = []
    for name, velocity, void_fraction, ergun in zip(
        paper.names, paper.velocity, paper.void_fraction, paper.ergun
    ):
        ours = case_at(run, velocity) or {}
        rows.append(
            [
                name,
                words.number(velocity, ".3f"),
                words.number(void_fraction, ".3f"),
                words.number(ergun, ".1f"),
                words.number(ours.get("mean_void_fraction"), ".4f"),
                words.number(ours.get("ergun_pressure_drop"), ".1f"),
                words.number(ours.get("pressure_drop"), ".1f"),
            ]
        )
    return table([(f"the paper, {paper.scale}X", 4), ("this run, same velocity", 3)], heads, rows)


def case_at(run, velocity):
    """The case whose superficial velocity agrees to the paper's three digits, or None."""
    for case in run.cases:
        ours = case["superficial_velocity"]
        if ours is not None and np.isclose(ours, velocity, rtol=0.0, atol=6e-4):
            return case
    return None


def deviation_in_parts(run):
    """Table of what the radial profile explains of each case's deviation, and what is left."""
    if not run.cases:
        return NO_CASES
    heads = [
        ("case", ""),
        ("V<sub>s</sub>", "m/s"),
        ("predicted from the radial profile", "points"),
        ("left in the middle half", "points"),
        ("whole bed less middle half", "points"),
        ("whole bed", "%"),
    ]
    rows = []
    for case in run.cases:
        parts = reference.parts_of_deviation(case)
        rows.append(
            [
                f"{case['number']}{' (lifted)' if case['fluidized'] else ''}",
                words.number(case["superficial_velocity"], ".3f"),
                words.number(parts["predicted"], "+.2f", 100.0),
                words.number(parts["core"], "+.2f", 100.0),
                words.number(parts["outside"], "+.2f", 100.0),
                words.number(parts["full"], "+.2f", 100.0),
            ]
        )
    return table([], heads, rows, numbers_of(run))


# Quantities of the table of means, beside all probes, with a factor and a unit.
AVERAGED = {
    "pressure_drop": (1.0, "Pa"),
    "expanded_height": (1e3, "mm"),
    "center_of_mass": (1e3, "mm"),
    "bed_height": (1e3, "mm"),
    "support_force": (1.0, "N"),
    "fluid_force": (1.0, "N"),
}


def means_over_time(run):
    """Table of means, rms, statistical errors and frequencies over the window."""
    rows = []
    for number, means in sorted(run.averages.get("averages", {}).items()):
        for k, quantity in enumerate(means["quantity"]):
            is_probe = any(str(quantity) == name for name in run.probes or {})
            if quantity not in AVERAGED and not is_probe:
                continue
            factor, unit = AVERAGED.get(quantity, (1.0, means["unit"][k]))
            cells = [
                words.number(value if np.isfinite(value) else None, ".4g", scale)
                for value, scale in (
                    (means["mean"][k], factor),
                    (means["error"][k], factor),
                    (means["rms"][k], factor),
                    (means["frequency"][k], 1.0),
                )
            ]
            rows.append([number, quantity.replace("_", " "), unit, *cells])
    if not rows:
        return ""
    heads = [
        ("case", ""),
        ("quantity", ""),
        ("unit", ""),
        ("mean", ""),
        ("its error", "by blocks"),
        ("rms", "about the mean"),
        ("frequency", "Hz"),
    ]
    return table([], heads, rows)
