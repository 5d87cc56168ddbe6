# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Reads what a run of Graupel leaves, as numpy arrays in SI units.

    import graupel
    run = graupel.read_run("output-short")
    run.monitors["time"]                  # array of shape (rows,) [s]
    run.cases[0]["pressure_drop"]         # [Pa]
    run.profiles[1]["void_fraction"]      # of case 1, array of shape (rows,) [-]
    run.particles().points                # centers at the last moment, (n, 3) [m]
    graupel.UNITS["pressure_drop"]        # "Pa"

What the files are is told in doc/output-files.md. graupel.particle_lists converts lists of
particles, graupel.report makes report.html.
"""

from .columns import UNITS
from .particle_lists import Particles, read_particles, write_particles
from .run import Run, grid_of, read_run
from .study import read_study
from .vtu import VtuFile, read_vtu

__all__ = (
    "UNITS",
    "Particles",
    "Run",
    "VtuFile",
    "grid_of",
    "read_particles",
    "read_run",
    "read_study",
    "read_vtu",
    "write_particles",
)
