# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Reads the output directory of a run (doc/output-files.md says what lies there).

Nothing here stops the reader: what is missing or cannot be read becomes a sentence in
Run.notices, and the value None (or a column of NaN).
"""

import csv
import json
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .columns import AVERAGES_COLUMNS, BED_COLUMNS, CASE_FLAGS, CASE_KEYS, MIDPLANE_COLUMNS
from .columns import MONITOR_COLUMNS, PROFILE_COLUMNS, RADIAL_COLUMNS, SNAPSHOT_COLUMNS
from .columns import TEXT_COLUMNS
from .parameters import read_parameters
from .hdf5 import read_hdf5, xdmf_records
from .vtu import pvd_records, read_vtu


# Tables that have no rows where the vessel is not a whole cylinder.
OF_CYLINDERS = ("radial", "bed-radial")


@dataclass
class Run:
    """All of one run, in SI units (graupel.UNITS has them by column).

    A table maps the name of a column to its array of shape (rows,): numbers, NaN where there
    is none, or text. Tables of cases are keyed by the number of the case, from 1.

    summary     what summary.json says, as nested dictionaries
    parameters  texts of parameters.prm by path, as in "Flow/time step"
    cases       a dictionary a flow case: the columns of cases.csv, and "number"; value or None
    monitors    monitors.csv: a row a step of the flow
    wall_forces wall-forces.csv: "time" [s], "particles_on_NAME_x" and so on [N]
    probes      probes.csv: "time" [s], "NAME_pressure" [Pa] and so on
    snapshots   snapshots.csv: void fraction on the plane y = 0 over time
    profiles    profiles-NN.csv by case: averages over cross-sections along z
    radial      radial-NN.csv by case: averages around the axis by distance from the wall
    midplane    midplane-NN.csv by case: fields on the plane y = 0; grid_of() makes images of it
    averages    by stem, then case: averages-NN.csv, spectra-NN.csv, averages-lines-NN.csv,
                averages-planes-NN.csv, averages-midplane-NN.csv
    bed         by stem: bed-axial.csv, bed-radial.csv, bed-janssen.csv, bed-coordination.csv,
                bed-contacts.csv
    notices     sentences on what is missing or cannot be read

    Tables that a run does not have are None, or not in their dictionary.
    """

    directory: Path
    summary: dict = field(default_factory=dict)
    parameters: dict = field(default_factory=dict)
    cases: list = field(default_factory=list)
    monitors: dict = None
    wall_forces: dict = None
    probes: dict = None
    snapshots: dict = None
    profiles: dict = field(default_factory=dict)
    radial: dict = field(default_factory=dict)
    midplane: dict = field(default_factory=dict)
    averages: dict = field(default_factory=dict)
    bed: dict = field(default_factory=dict)
    notices: list = field(default_factory=list)

    def records(self, stem):
        """Times [s] and paths of the files for ParaView that STEM.pvd or STEM.xdmf lists, in
        their order; stem is solution, particles, contacts or averages."""
        in_hdf5 = self.directory / f"{stem}.xdmf"
        return xdmf_records(in_hdf5) if in_hdf5.exists() else pvd_records(in_hdf5.with_suffix(".pvd"))

    def particles(self, number=-1):
        """The particles at the moment @p number of particles.pvd, by default the last, as a
        VtuFile: points are the centers (n, 3) [m]; values id, type, coordination_number,
        wall_contacts (n,) [-], diameter (n,) [m], velocity (n, 3) [m/s], spin (n, 3) [rad/s],
        mean_normal_stress (n,) [Pa], contact_force and fluid_force (n, 3) [N]."""
        return read_vtu(self.records("particles")[number][1])

    def contacts(self, number=-1):
        """The contacts likewise: a line each, points are its ends (2 n, 3) [m]; values, the
        same at both ends, normal_force and tangential_force [N], overlap [m], with_wall (2 n,)
        and force (2 n, 3) [N]."""
        return read_vtu(self.records("contacts")[number][1])

    def fields(self, number=-1):
        """The fields likewise, from solution.pvd: points are the corners of the cells, each
        cell with its own (8 cells, 3) [m]; values void_fraction [-], pressure [Pa],
        drag_coefficient [kg/m^3/s], subdomain, refinement_level (8 cells,) [-], flux and
        interstitial velocity (8 cells, 3) [m/s]. From solution.xdmf each node once, without
        subdomain and refinement_level; that needs Debian's python3-h5py."""
        return self.read_fields("solution", number)

    def mean_fields(self, number=-1):
        """The means over the window of Averages likewise, from averages.pvd: void_fraction_mean
        and _rms [-], pressure_mean and _rms [Pa], flux_mean and _rms [m/s]."""
        return self.read_fields("averages", number)

    def read_fields(self, stem, number):
        """What the file of a moment of a series of fields holds, as a VtuFile."""
        path = self.records(stem)[number][1]
        return read_hdf5(path) if path.suffix == ".h5" else read_vtu(path)

    def get(self, *path):
        """The entry of summary.json at this path of keys; None if absent or null."""
        value = self.summary
        for key in path:
            value = value.get(key) if isinstance(value, dict) else None
        return None if isinstance(value, float) and not math.isfinite(value) else value

    def number(self, *path):
        """The same, but None too where the entry is not a number."""
        return as_number(self.get(*path))

    def case(self, number):
        """The case with this number, or None."""
        return next((case for case in self.cases if case["number"] == number), None)

    def has_flow(self):
        """False only if the run says itself that it has no flow case."""
        return self.get("cases") != []

    def has_particles(self):
        """False only if the run says itself that it has no particles."""
        return self.number("bed", "particle_count") != 0.0

    def empty(self):
        """Whether nothing at all of a run was found."""
        return not (
            self.summary
            or self.cases
            or self.monitors
            or self.profiles
            or self.radial
            or self.midplane
            or self.probes
        )


def as_number(value):
    """A finite float, or None. Booleans are no numbers."""
    if isinstance(value, bool) or value is None:
        return None
    try:
        value = float(value)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def as_flag(value):
    """True, False, or None if neither was written."""
    if isinstance(value, str):
        return {"true": True, "1": True, "false": False, "0": False}.get(value.strip().lower())
    if isinstance(value, (bool, int)):
        return bool(value)
    return None


def read_table(path, columns, notices, may_be_empty=False):
    """Columns of a CSV file by name; None where it has no rows, with a notice unless it may
    have none.

    Incomplete rows (a run that was killed while writing) are left out and
    counted in a notice; a missing column is NaN throughout.
    """
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        notices.append(f"{path.name} cannot be read: {error}.")
        return None
    if len(rows) < 2:
        if not (may_be_empty and rows):
            notices.append(f"{path.name} holds no rows of values.")
        return None

    header = [name.strip() for name in rows[0]]
    whole = [row for row in rows[1:] if len(row) == len(header)]
    if len(whole) < len(rows) - 1:
        left_out = len(rows) - 1 - len(whole)
        notices.append(f"{path.name}: {left_out} incomplete row(s) left out.")
    if not whole:
        return None
    table = {
        name: np.array(cells, dtype=str) if name in TEXT_COLUMNS else to_floats(cells)
        for name, cells in zip(header, zip(*whole))
    }
    absent = [name for name in columns if name not in table]
    if absent:
        notices.append(f"{path.name} lacks the column(s) {', '.join(absent)}.")
    for name in absent:
        filler = "" if name in TEXT_COLUMNS else math.nan
        table[name] = np.full(len(whole), filler)
    return table


def to_floats(cells):
    """Array of floats; NaN for a cell that holds no number."""
    try:
        return np.array(cells, dtype=float)
    except ValueError:
        numbers = [as_number(cell) for cell in cells]
        return np.array([math.nan if number is None else number for number in numbers])


def read_summary(directory, notices):
    """summary.json as a dictionary; empty, with a notice, if it cannot be had."""
    path = directory / "summary.json"
    if not path.is_file():
        notices.append("summary.json is missing: is the run still going on, or did it stop early?")
        return {}
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        notices.append(f"summary.json cannot be read: {error}.")
        return {}
    if not isinstance(summary, dict):
        notices.append("summary.json holds no object at its top level.")
        return {}
    return summary


def read_cases(directory, summary, notices):
    """The flow cases, from summary.json or else from cases.csv."""
    listed = summary.get("cases")
    listed = listed if isinstance(listed, list) else []
    rows = [row for row in listed if isinstance(row, dict)]
    path = directory / "cases.csv"
    if listed == [] and "cases" in summary:
        return []
    if not path.is_file():
        notices.append(
            "cases.csv is missing" + ("; the cases are those of summary.json." if rows else ".")
        )
    elif not rows:
        rows = rows_of_cases_csv(path, notices)
    cases = []
    for number, row in enumerate(rows, start=1):
        names = [key for key in {**dict.fromkeys(CASE_KEYS), **row} if key not in CASE_FLAGS]
        case = {key: as_number(row.get(key)) for key in names}
        case.update({key: as_flag(row.get(key)) for key in CASE_FLAGS})
        case["number"] = number
        cases.append(case)
    return cases


def rows_of_cases_csv(path, notices):
    """The rows of cases.csv as dictionaries of text."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        notices.append(f"cases.csv cannot be read: {error}.")
        return []


def read_numbered(run, stem, columns, every_case=True, optional=False):
    """The tables STEM-NN.csv by case number; names in a notice what is missing, unless
    there need not be any."""
    directory, cases, notices = run.directory, run.cases, run.notices
    tables = {}
    on_disk = set()
    for path in sorted(directory.glob(f"{stem}-*.csv")):
        match = re.fullmatch(rf"{stem}-(\d+)\.csv", path.name)
        if not match:
            continue
        on_disk.add(int(match.group(1)))
        table = read_table(path, columns, notices, stem in OF_CYLINDERS)
        if table is not None:
            tables[int(match.group(1))] = table
    if optional:
        return tables
    absent = [f"{stem}-{case['number']:02d}.csv" for case in cases if case["number"] not in on_disk]
    if not on_disk and run.has_flow():
        notices.append(f"{stem}-NN.csv: there is no such file.")
    elif absent and every_case:
        notices.append(f"{', '.join(absent)} {'is' if len(absent) == 1 else 'are'} missing.")
    return tables


def read_run(directory):
    """Reads everything in @p directory but the files for ParaView; see Run."""
    run = Run(Path(directory))
    notices = run.notices
    run.summary = read_summary(run.directory, notices)
    run.cases = read_cases(run.directory, run.summary, notices)

    def table(name, columns=("time",)):
        path = run.directory / f"{name}.csv"
        is_there = path.is_file()
        return read_table(path, columns, notices, name in OF_CYLINDERS) if is_there else None

    if (run.directory / "parameters.prm").is_file():
        run.parameters = read_parameters(run.directory / "parameters.prm")
    run.monitors = table("monitors", MONITOR_COLUMNS)
    if run.has_flow() and not (run.directory / "monitors.csv").is_file():
        notices.append("monitors.csv is missing.")
    run.wall_forces = table("wall-forces")
    run.probes = table("probes")
    run.snapshots = table("snapshots", SNAPSHOT_COLUMNS)
    run.profiles = read_numbered(run, "profiles", PROFILE_COLUMNS)
    run.radial = read_numbered(run, "radial", RADIAL_COLUMNS)
    run.midplane = read_numbered(run, "midplane", MIDPLANE_COLUMNS, every_case=False)
    for stem, columns in AVERAGES_COLUMNS.items():
        run.averages[stem] = read_numbered(run, stem, columns, optional=True)
    beds = {name: table(name, columns) for name, columns in BED_COLUMNS.items()}
    run.bed = {name: rows for name, rows in beds.items() if rows is not None}
    return run


def grid_of(table, name):
    """Column @p name of a mid-plane table as (x, z, values), values[k, i] at (x[i], z[k]).

    Works in whatever order the rows come, because it looks up each row's place
    rather than counting; points without a row are NaN. Throws ValueError if the
    points do not lie on a grid.
    """
    x, at_x = np.unique(np.round(table["x"], 9), return_inverse=True)
    z, at_z = np.unique(np.round(table["z"], 9), return_inverse=True)
    if len(x) < 2 or len(z) < 2 or len(x) * len(z) > 2 * len(table["x"]):
        raise ValueError("the points of the mid-plane lie on no regular grid")
    values = np.full((len(z), len(x)), math.nan)
    values[at_z, at_x] = table[name]
    return x, z, values


def of_grids(table):
    """The rows of each line or plane of a table, by its name."""
    names = list(dict.fromkeys(table["name"]))
    return {
        name: {column: values[table["name"] == name] for column, values in table.items()}
        for name in names
    }
