# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Numbers and findings as text."""

from pathlib import PurePath

from . import reference

NONE = "-"
MINUS = "\u2212"


def number(value, pattern=".3g", factor=1.0, unit=""):
    """A number with its unit, or NONE. The pattern is that of format()."""
    if value is None:
        return NONE
    text = format(value * factor, pattern)
    if not text.strip("+-0.%"):
        text = text.lstrip("+-")
    text = text.replace("-", MINUS)
    return f"{text}\u00a0{unit}" if unit else text


def percent(value, digits=1):
    """A relative quantity as signed percent, or NONE."""
    return NONE if value is None else number(value, f"+.{digits}f", 100.0, "%")


def points(value):
    """A difference of relative quantities, in percentage points without the unit."""
    return number(value, "+.1f", 100.0)


def flag(value):
    """yes, no, or NONE."""
    return NONE if value is None else ("yes" if value else "no")


def duration(seconds):
    """Seconds in the unit that suits them, or NONE."""
    if seconds is None:
        return NONE
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 1.5 * size:
            return number(seconds / size, ".3g", unit=unit)
    return number(seconds, ".3g", unit="s")


def between(values, text):
    """A range such as "0.2 to 0.5", from the values that are known; NONE without any."""
    values = [value for value in values if value is not None]
    if not values:
        return NONE
    low, high = text(min(values)), text(max(values))
    return low if low == high else f"{low} to {high}"


def velocity_of(case):
    """Superficial velocity of a case, as text."""
    return number(case["superficial_velocity"], ".3f", unit="m/s")


def the_bed(run):
    """One or two sentences on the bed before the flow."""
    count = run.number("bed", "particle_count")
    diameter = run.number("bed", "particle_diameter")
    original = run.number("bed", "original_diameter")
    scale = run.number("bed", "scale")
    if not run.has_particles():
        return "There are no particles."
    if count is None and diameter is None:
        return "summary.json says nothing about the bed."
    text = f"The bed holds {number(count, ',.0f')} spheres of {number(diameter, '.2f', 1e3, 'mm')}"
    if scale is not None and scale > 1.0:
        text += (
            f", each in place of {number(scale**3, '.3g')} of {number(original, '.2f', 1e3, 'mm')}"
            f" (scale {number(scale, '.3g')})"
        )
    vessel = run.number("bed", "vessel_diameter")
    mesh = run.parameters.get("Mesh/file")
    if mesh:
        text += f", in the vessel of {PurePath(mesh).name}"
    elif vessel is not None:
        text += f", in a vessel {number(vessel, '.4g', 1e3, 'mm')} wide"
    if run.number("bed", "height") is None:
        return f"{text}. A height of the bed before the flow is not known."
    text += (
        f". Before the flow it is {number(run.number('bed', 'height'), '.1f', 1e3, 'mm')} high,"
        f" with a mean void fraction of {number(run.number('bed', 'mean_void_fraction'), '.4f')}"
    )
    contacts = run.number("bed", "mean_coordination_number")
    if contacts is not None:
        text += f" and {number(contacts, '.1f')} contacts a particle"
    return text + "."


def the_flow(run):
    """Sentences on the range of velocities and the largest deviation from Ergun."""
    if not run.cases:
        return "There is no flow case."
    speeds = between(
        [case["superficial_velocity"] for case in run.cases], lambda value: number(value, ".3f")
    )
    if len(run.cases) == 1:
        text = f"There is one flow case, at a superficial velocity of {speeds} m/s."
    else:
        text = f"There are {len(run.cases)} flow cases, at superficial velocities of {speeds} m/s."
    fixed = [
        case
        for case in run.cases
        if case["fluidized"] is False and case["deviation_from_ergun"] is not None
    ]
    if fixed:
        worst = max(fixed, key=lambda case: abs(case["deviation_from_ergun"]))
        text += (
            f" While the bed is fixed, the pressure drop deviates from Ergun's equation (with the"
            f" bed's own height and void fraction) by at most"
            f" {percent(worst['deviation_from_ergun'])}, at {velocity_of(worst)}."
        )
    else:
        text += " No fixed-bed case has a deviation from Ergun's equation to report."
    unsteady = [str(case["number"]) for case in run.cases if case["steady"] is False]
    if unsteady:
        text += f" Not steady at its end: case {', '.join(unsteady)}."
    return text


def the_onset(run):
    """A sentence on whether and at which velocity the bed lifted."""
    if not run.cases:
        return ""
    lifted = [case for case in run.cases if case["fluidized"] is True]
    unknown = [str(case["number"]) for case in run.cases if case["fluidized"] is None]
    if lifted:
        first = lifted[0]
        before = run.case(first["number"] - 1)
        text = f"The bed lifted at {velocity_of(first)} (case {first['number']})"
        if before is not None and before["fluidized"] is False:
            text += f", having stayed at rest at {velocity_of(before)}"
        if first["bed_rise"] is not None:
            text += f"; it rose by {number(first['bed_rise'], '.2f', 1e3, 'mm')}"
        if first["bottom_force"] is not None:
            text += (
                f" and pressed on the bottom with {number(first['bottom_force'], '.3f', unit='N')}"
            )
        text += "."
    elif len(unknown) < len(run.cases):
        text = "The bed did not lift."
    else:
        return "Whether the bed lifted is not recorded."
    if unknown:
        text += f" Whether it lifted is not recorded for case {', '.join(unknown)}."
    return text


def the_ledger(run):
    """A sentence on conservation."""
    keys = ("max_mass_imbalance", "max_momentum_imbalance", "max_solid_volume_error")
    values = [run.number("ledger", key) for key in keys]
    if all(value is None for value in values):
        return ""
    mass, momentum, solid = (scientific(value) for value in values)
    return (
        f"The worst relative imbalance of any step was {mass} in mass, {momentum} in the momentum"
        f" exchanged between fluid and particles, and {solid} in solid volume."
    )


def scientific(value):
    """A small number with a power of ten, as text."""
    if value is None:
        return NONE
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.1e}".split("e")
    superscripts = str.maketrans(
        "-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"
    )
    return f"{mantissa.replace('-', MINUS)}\u00b710{str(int(exponent)).translate(superscripts)}"


def summary(run):
    """The run in one paragraph."""
    sentences = (the_bed(run), the_flow(run), the_onset(run), the_ledger(run))
    return " ".join(sentence for sentence in sentences if sentence)


def wall_is_known(run):
    """Whether a case knows what the looser packing at the wall explains."""
    return any(case["wall_channelling_deviation"] is not None for case in run.cases)


def what_is_left(run):
    """How much of the deviation the radial profile explains, in a sentence or two."""
    parts = [reference.parts_of_deviation(case) for case in run.cases if case["fluidized"] is False]
    parts = [part for part in parts if part["core"] is not None]
    if not parts:
        return (
            "How much of the deviation the radial profile explains cannot be said: no fixed-bed"
            " case has both a gradient deviation and a prediction."
        )
    predicted = between([part["predicted"] for part in parts], percent)
    middle = between([part["middle"] for part in parts], percent)
    core = between([part["core"] for part in parts], points)
    text = (
        f"Looser packing at the wall lets fluid pass: Ergun's equation, summed over the radial"
        f" void-fraction profile, predicts {predicted} in the fixed-bed cases. The gradient over"
        f" the middle half deviates by {middle}, which leaves {core} percentage points there that"
        f" the profile does not explain."
    )
    outside = between([part["outside"] for part in parts], points)
    if outside != NONE:
        text += (
            f" The whole bed differs from its middle half by a further {outside} points: the two"
            f" ends of the bed, and its height and mean void fraction as defined."
        )
    return text


def cost_sentence(run, paper):
    """Throughput, and the paper's cost of a case beside ours."""
    wall = run.number("cost", "wall_seconds")
    cpu = run.number("cost", "cpu_seconds")
    ranks = run.number("program", "mpi_ranks")
    text = f"Wall-clock time {duration(wall)}, CPU time {duration(cpu)}"
    if ranks is not None:
        text += f", on {number(ranks, '.0f')} process{'' if ranks == 1 else 'es'}"
    text += "."
    steps = run.number("cost", "particle_steps")
    if steps is not None and wall:
        text += f" Particle steps per second of wall-clock time: {scientific(steps / wall)}."
    each = [case["cpu_seconds"] for case in run.cases if case["cpu_seconds"] is not None]
    if paper is not None and each:
        text += (
            f" A flow case took {between(each, duration)} of CPU time; the paper reports"
            f" {paper.cpu_hours} for one of its {paper.scale}X cases, on a desktop of 2014."
        )
    return text
