# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""An output directory such as a run writes, for report_test.py."""

import csv
import json
import math

import numpy as np

from graupel import columns
from graupel.report import figures_run, reference

VESSEL = 25e-3
AREA = math.pi * VESSEL**2 / 4.0
DENSITY, VISCOSITY = 1.18415, 1.85508e-5
HEIGHT, VOID_FRACTION = 0.1499, 0.388
WEIGHT = 0.48


def one_case(velocity, lifted):
    """A plausible flow case; the gas carries at most the weight."""
    ergun = reference.ergun_pressure_drop(
        velocity, HEIGHT, VOID_FRACTION, 1.6e-3, DENSITY, VISCOSITY
    )
    fluid = min(0.97 * ergun * AREA, WEIGHT)
    return {
        "superficial_velocity": velocity,
        "pressure_drop": fluid / AREA,
        "ergun_pressure_drop": ergun,
        "deviation_from_ergun": fluid / AREA / ergun - 1.0,
        "gradient_deviation_from_ergun": -0.021,
        "wall_channelling_deviation": -0.018,
        "bed_height": HEIGHT + (2.2e-3 if lifted else 0.0),
        "bed_rise": 2.2e-3 if lifted else 0.0,
        "mean_void_fraction": VOID_FRACTION,
        "bottom_force": 0.4 * (WEIGHT - fluid),
        "wall_force": 0.6 * (WEIGHT - fluid),
        "fluid_force": fluid,
        "weight": WEIGHT,
        "fluidized": lifted,
        "steady": True,
        "simulated_time": 1.2,
        "wall_seconds": 700.0,
        "cpu_seconds": 1400.0,
    }


def summary_of(cases, scale=1.0, vessel=VESSEL, original=1.6e-3):
    """A summary.json with every key."""
    sections = figures_run.SECTIONS
    return {
        "program": {
            "name": "graupel",
            "version": "0.2.0",
            "deal_ii_version": "9.4.1",
            "mpi_ranks": 2,
            "parameter_file": "prm/packed-bed/<sweep>.prm",
        },
        "bed": {
            "particle_count": 20997,
            "particle_diameter": original * scale,
            "scale": scale,
            "solid_volume": 4.5e-5,
            "height": HEIGHT,
            "mean_void_fraction": VOID_FRACTION,
            "mean_coordination_number": 5.9,
            "vessel_diameter": vessel,
            "vessel_height": 0.169,
            "original_diameter": original,
        },
        "reference": reference.PAPER if original == 1.6e-3 and vessel == VESSEL else "none",
        "fluid": {"density": DENSITY, "viscosity": VISCOSITY},
        "cases": cases,
        "ledger": {
            "max_mass_imbalance": 2e-11,
            "max_momentum_imbalance": 3e-13,
            "max_solid_volume_error": 0.0,
        },
        "cost": {
            "wall_seconds": 1600.0,
            "cpu_seconds": 3100.0,
            "particle_steps": 4000000000,
            "contact_steps": 12000000000,
            "fluid_steps": 2400,
            "seconds_in": {name: 100.0 for name in sections},
        },
    }


def write_csv(path, header, rows):
    """A CSV file as the program writes it."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([header, *rows])


FURTHER_MONITORS = (
    "nominal_velocity",
    "bed_bottom",
    "support_force",
    "particles",
    "departed_particles",
    "fed_particles",
)


def what_further_monitors_say(step):
    """Their values; the bed has no bottom in every other row."""
    bottom = "" if step % 2 else 0.0
    return [0.3, bottom, 0.4, 20997 - step, step, 0]


BINNED = ("velocity_z", "velocity_rms_z", "solid_flux_x", "solid_flux_z", "flux_z")


def write_averages(directory, number):
    """What a run with a window of averages leaves of a case, from a pressure that swings."""
    swing = 2.5
    rows = [
        ["pressure_drop", "Pa", 400, 390.0, 12.0, 1.5, swing],
        ["expanded_height", "m", 400, HEIGHT, 1e-3, "", ""],
        ["linear_iterations", "-", 400, 12.0, 0.0, "", ""],
        ["inlet_pressure", "Pa", 400, 400.0, 13.0, 1.6, swing],
    ]
    header = ["quantity", "unit", "samples", "mean", "rms", "error", "frequency"]
    write_csv(directory / f"averages-{number:02d}.csv", header, rows)
    frequencies = np.arange(1, 40) * 0.25
    rows = [[f, 1.0 / (1.0 + (f - swing) ** 2), 1e-6 / f] for f in frequencies]
    header = ["frequency", "pressure_drop", "expanded_height"]
    write_csv(directory / f"spectra-{number:02d}.csv", header, rows)

    header = ["name", "x", "y", "z", "along", "across", "solid_fraction", "solid_fraction_rms"]
    header += ["void_fraction", *BINNED]
    rows = [
        [name, along - 0.012, 0.0, 0.05, along, "", 0.5, 0.1, "" if along < 2e-3 else 0.45]
        + [0.1, 0.2, 0.0, 0.05, 0.6]
        for name in ("low", "high")
        for along in np.arange(0.001, 0.024, 0.002)
    ]
    write_csv(directory / f"averages-lines-{number:02d}.csv", header, rows)
    rows = [
        ["mid", along - 0.012, 0.0, across, along, across, 0.5 + along, 0.1, 0.45]
        + [0.1, 0.2, 0.01, 0.05, 0.6]
        for across in np.arange(0.01, 0.15, 0.01)
        for along in np.arange(0.001, 0.024, 0.002)
    ]
    write_csv(directory / f"averages-planes-{number:02d}.csv", header, rows)
    points = [(x, z) for x in np.linspace(-0.0125, 0.0125, 11) for z in np.linspace(0, 0.169, 60)]
    rows = [[x, z, 0.4 if z < HEIGHT else 1.0, 0.5, 100.0] for x, z in points]
    header = list(columns.MIDPLANE_COLUMNS)
    write_csv(directory / f"averages-midplane-{number:02d}.csv", header, rows)
    rows = [[time, number, x, z, 0.4 + 10 * time] for time in (0.05, 0.055) for x, z in points]
    write_csv(directory / "snapshots.csv", ["time", "case", "x", "z", "void_fraction"], rows)


def write_run(directory, scale=1.0, vessel=VESSEL, steps=60):
    """A complete output directory with one fixed-bed case and one lifted one."""
    cases = [one_case(0.271, False), one_case(0.534, True)]
    summary = summary_of(cases, scale, vessel)
    (directory / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    rows = [
        [str(case[key]).lower() if key in columns.CASE_FLAGS else case[key] for key in case]
        for case in cases
    ]
    write_csv(directory / "cases.csv", list(cases[0]), rows)
    phases = [("fill", 0), ("settle", 0), ("flow", 1), ("flow", 2)]
    numbers = [0.3, 400.0, HEIGHT, 0.1, 0.2, 0.2, 1e-9, 1e-3, 1e-11, 1e-13, 0.0, 12]
    numbers += [2496, 1e-12, 1e-4]
    rows = [
        [step * 1e-3, *phases[4 * step // steps], *numbers, *what_further_monitors_say(step)]
        for step in range(steps)
    ]
    write_csv(directory / "monitors.csv", columns.MONITOR_COLUMNS + FURTHER_MONITORS, rows)
    walls = ("time", "particles_on_bottom_z", "particles_on_wall_z", "fluid_on_bottom_z")
    rows = [[step * 1e-3, -0.2 - step * 1e-3, 0.0, -0.1 if step else ""] for step in range(steps)]
    write_csv(directory / "wall-forces.csv", walls, rows)
    probed = ("time", "inlet_pressure", "far_side_pressure", "inlet_velocity_z")
    rows = [[step * 1e-3, 400.0 - step, 10.0, 0.3 if step else ""] for step in range(steps)]
    write_csv(directory / "probes.csv", probed, rows)
    for number, case in enumerate(cases, start=1):
        z = np.linspace(0.0, 0.169, 40)
        fall = np.maximum(0.0, 1.0 - z / HEIGHT)
        rows = [
            [height, case["pressure_drop"] * part, 0.39 if part > 0.0 else 1.0, 0.3, 400.0 * part]
            for height, part in zip(z, fall)
        ]
        write_csv(directory / f"profiles-{number:02d}.csv", columns.PROFILE_COLUMNS, rows)
        rows = [[distance, 0.4, 0.3] for distance in np.linspace(0.0, 0.0125, 20)]
        write_csv(directory / f"radial-{number:02d}.csv", columns.RADIAL_COLUMNS, rows)
    rows = [[distance, 0.4, 0.41] for distance in np.linspace(0.0, 0.0125, 50)]
    write_csv(directory / "bed-radial.csv", columns.BED_COLUMNS["bed-radial"], rows)
    rows = [
        [height, 0.48 - 3.0 * height, 0.3 - 2.0 * height, 0.18 - height, 600.0, 590.0, 0.1]
        for height in np.linspace(0.0, 0.15, 20)
    ]
    write_csv(directory / "bed-janssen.csv", columns.BED_COLUMNS["bed-janssen"], rows)
    rows = [
        [x, height, 0.4 if height < HEIGHT else 1.0, 0.5, 100.0]
        for x in np.linspace(-0.0125, 0.0125, 11)
        for height in np.linspace(0.0, 0.169, 60)
    ]
    write_csv(directory / "midplane-02.csv", columns.MIDPLANE_COLUMNS, rows)
    write_averages(directory, 2)
