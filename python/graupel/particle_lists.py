# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Lists of particles: from other programs to what Filling/method = list reads, and back.

    scripts/particles FROM TO           (installed: graupel-particles)

FROM is a text dump of LIGGGHTS or LAMMPS, a VTU, VTP or PVD file, a run's directory (its
particles at the last moment), or a CSV file. TO is a CSV file for Filling/file, or a dump
(.dump) for LIGGGHTS, LAMMPS and OVITO.
"""

import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .vtu import pvd_records, read_vtu

# The columns of a list, in the order in which they are written.
COLUMNS = ("x", "y", "z", "diameter", "vx", "vy", "vz", "wx", "wy", "wz", "type")
# What others call them: dumps, and ParaView's tables.
OTHER_NAMES = {
    "omegax": "wx",
    "omegay": "wy",
    "omegaz": "wz",
    "xu": "x",
    "yu": "y",
    "zu": "z",
    **{f"Points:{i}": name for i, name in enumerate("xyz")},
    **{f"velocity:{i}": f"v{name}" for i, name in enumerate("xyz")},
    **{f"spin:{i}": f"w{name}" for i, name in enumerate("xyz")},
}
SPINS = ("spin", "omega")
VELOCITIES = ("velocity", "v")


@dataclass
class Particles:
    """Spheres, in SI units.

    position  centers, shape (n, 3) [m]
    diameter  shape (n,) [m]
    velocity  shape (n, 3) [m/s]
    spin      angular velocity, shape (n, 3) [rad/s]
    type      from 1 on, as parameter files count them, shape (n,)
    """

    position: np.ndarray
    diameter: np.ndarray
    velocity: np.ndarray
    spin: np.ndarray
    type: np.ndarray


class NoParticles(ValueError):
    """The file holds no particles that can be read; the message says why."""


def from_columns(columns, path, diameter=None):
    """Particles of columns by their names; @p diameter [m] is that of all where the file has
    none."""
    columns = {OTHER_NAMES.get(name, name): values for name, values in columns.items()}
    lacking = [name for name in "xyz" if name not in columns]
    if lacking:
        raise NoParticles(f"{path} has no column {', '.join(lacking)}")
    n = len(columns["x"])
    if "diameter" not in columns and "radius" in columns:
        columns["diameter"] = 2.0 * columns["radius"]
    if "diameter" not in columns:
        if diameter is None:
            raise NoParticles(f"{path} has neither diameters nor radii; give --diameter")
        columns["diameter"] = np.full(n, diameter)

    def three(names):
        return np.stack([columns.get(name, np.zeros(n)) for name in names], axis=1)

    kinds = np.asarray(columns.get("type", np.ones(n))).astype(int)
    return Particles(
        three("xyz"), columns["diameter"], three(("vx", "vy", "vz")),
        three(("wx", "wy", "wz")), kinds,
    )  # fmt: skip


def by_id(columns):
    """The columns in the order of the ids, if there are any."""
    if "id" not in columns:
        return columns
    order = np.argsort(columns["id"], kind="stable")
    return {name: values[order] for name, values in columns.items()}


def read_csv(path, diameter):
    """Of a CSV file whose first line names the columns; what follows a # is left out."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = (line.split("#")[0].strip() for line in file)
        rows = list(csv.reader(line for line in lines if line))
    if len(rows) < 2:
        raise NoParticles(f"{path} holds no particles")
    names = [name.strip() for name in rows[0]]
    try:
        numbers = np.array(rows[1:], dtype=float).T
    except ValueError as error:
        raise NoParticles(f"{path}: {error}") from error
    return from_columns(dict(zip(names, numbers)), path, diameter)


def read_dump(path, diameter):
    """Of the last moment of a text dump of LIGGGHTS or LAMMPS, in the order of the ids."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    heads = [k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")]
    if not heads:
        raise NoParticles(f"{path} has no line ITEM: ATOMS")
    head = heads[-1]
    names = lines[head].split()[2:]
    count, bounds = None, None
    for k in range(head - 1, -1, -1):
        if lines[k].startswith("ITEM: BOX BOUNDS") and bounds is None:
            bounds = [[float(word) for word in line.split()[:2]] for line in lines[k + 1 : k + 4]]
        if lines[k].startswith("ITEM: NUMBER OF ATOMS"):
            count = int(lines[k + 1])
            break
    rows = [line.split() for line in lines[head + 1 : head + 1 + (count or 0)]]
    if not rows or len(rows) < count or any(len(row) != len(names) for row in rows):
        raise NoParticles(f"{path}: its last moment is not complete")
    # Words, such as names of elements, are no columns of ours.
    columns = {}
    for name, words in zip(names, zip(*rows)):
        try:
            columns[name] = np.array(words, dtype=float)
        except ValueError:
            continue
    for axis, name in enumerate("xyz"):
        if f"{name}s" in columns and name not in columns:  # of the box
            low, high = bounds[axis]
            columns[name] = low + columns[f"{name}s"] * (high - low)
    return from_columns(by_id(columns), path, diameter)


def read_vtk_xml(path, diameter):
    """Of the points of a VTU or VTP file, in the order of the ids where it has them."""
    file = read_vtu(path)
    columns = dict(zip("xyz", file.points.T))
    for names, letter in ((VELOCITIES, "v"), (SPINS, "w")):
        found = next((file.values[name] for name in names if name in file.values), None)
        if found is not None:
            columns.update({letter + axis: found[:, k] for k, axis in enumerate("xyz")})
    scalars = ("id", "diameter", "radius", "type")
    columns.update({name: file.values[name] for name in scalars if name in file.values})
    return from_columns(by_id(columns), path, diameter)


def read_particles(path, diameter=None):
    """The Particles of a file or of a run's directory, by the end of its name: .csv, .vtu,
    .vtp, .pvd (the last moment); else a dump of LIGGGHTS or LAMMPS. Lengths are taken as
    metres. @p diameter [m] is that of all where the file has none. Throws NoParticles."""
    path = Path(path)
    if path.is_dir():
        path = path / "particles.pvd"
    if path.suffix == ".pvd":
        records = pvd_records(path)
        if not records:
            raise NoParticles(f"{path} lists no file")
        path = records[-1][1]
    if path.suffix in (".vtu", ".vtp"):
        return read_vtk_xml(path, diameter)
    return (read_csv if path.suffix == ".csv" else read_dump)(path, diameter)


def write_csv(path, particles):
    """A list for Filling/file, with as many digits as the numbers have."""
    table = np.column_stack(
        (particles.position, particles.diameter, particles.velocity, particles.spin)
    )
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row, kind in zip(table.tolist(), particles.type.tolist()):
            writer.writerow([*map(repr, row), kind])


def write_dump(path, particles):
    """A text dump of one moment, its box around all spheres."""
    radius = 0.5 * particles.diameter
    low = (particles.position - radius[:, None]).min(axis=0)
    high = (particles.position + radius[:, None]).max(axis=0)
    names = "id type x y z radius vx vy vz omegax omegay omegaz"
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(radius)}\n")
        file.write("ITEM: BOX BOUNDS ff ff ff\n")
        for bounds in zip(low.tolist(), high.tolist()):
            file.write("{!r} {!r}\n".format(*bounds))
        file.write(f"ITEM: ATOMS {names}\n")
        table = np.column_stack((particles.position, radius, particles.velocity, particles.spin))
        for k, (kind, row) in enumerate(zip(particles.type.tolist(), table.tolist()), start=1):
            file.write(f"{k} {kind} {' '.join(map(repr, row))}\n")


def write_particles(path, particles):
    """Writes a CSV list, or a dump if the name ends in .dump."""
    (write_dump if Path(path).suffix == ".dump" else write_csv)(path, particles)


def main():
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(
        description="Converts lists of particles for Filling/method = list, and back.",
        epilog="FROM: a text dump of LIGGGHTS or LAMMPS, .vtu, .vtp, .pvd, .csv, or the directory"
        " of a run. TO: .csv for Filling/file, or .dump.",
    )
    parser.add_argument("source", metavar="FROM", type=Path)
    parser.add_argument("target", metavar="TO", type=Path)
    parser.add_argument("--diameter", type=float, help="of all, where FROM has none [m]")
    parser.add_argument(
        "--unit", type=float, default=1.0, metavar="M",
        help="length of FROM's unit of length in metres, such as 1e-3",
    )  # fmt: skip
    arguments = parser.parse_args()
    if arguments.target.suffix not in (".csv", ".dump"):
        parser.error(f"{arguments.target} ends neither in .csv nor in .dump")
    try:
        particles = read_particles(
            arguments.source, arguments.diameter and arguments.diameter / arguments.unit
        )
        for name in ("position", "diameter", "velocity"):
            setattr(particles, name, getattr(particles, name) * arguments.unit)
        write_particles(arguments.target, particles)
    except (OSError, ValueError) as error:
        print(f"particles: {error}", file=sys.stderr)
        return 1
    print(f"{arguments.target}: {len(particles.diameter)} particles")
    return 0
