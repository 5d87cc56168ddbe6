# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What every script that runs the binary needs to know of it."""

import os
from pathlib import Path

# Exit statuses: all is done; the input is refused; the run has stopped by a fault, as it was asked
# to, or as a file could not be written.
DONE, REFUSED, FAULT, STOPPED, NOT_WRITTEN = range(5)


def environment():
    """What a run needs to be told by the machine: one thread a rank, also as root."""
    return dict(
        os.environ,
        OMPI_ALLOW_RUN_AS_ROOT="1",
        OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
        OMP_NUM_THREADS="1",
    )


def processes_in(folder):
    """The folders in /proc of the processes that work in a folder: of a run there all ranks and
    what started them."""

    def is_there(process):
        try:
            return os.readlink(process / "cwd") == os.path.realpath(folder)
        except OSError:  # another user's, or gone
            return False

    return [process for process in Path("/proc").glob("[0-9]*") if is_there(process)]
