# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Fields in HDF5 files, which XDMF describes: those of Output/field format = hdf5."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .vtu import VtuFile

HEXAHEDRON = 12  # as VTK counts kinds of cells
CORNERS = 8


def read_hdf5(path):
    """The file of fields at @p path as a VtuFile: each node once. Raises ImportError without
    Debian's python3-h5py."""
    try:
        import h5py
    except ImportError as error:
        raise ImportError(f"{error}. HDF5 needs h5py: apt-get install python3-h5py.") from error

    with h5py.File(path, "r") as file:
        values = {name: np.asarray(one) for name, one in file.items()}
    points, cells = values.pop("nodes"), values.pop("cells")
    values = {name: one[:, 0] if one.shape[1] == 1 else one for name, one in values.items()}
    read = VtuFile(points, values, {})
    read.connectivity = cells.reshape(-1)
    read.offsets = CORNERS * np.arange(1, len(cells) + 1)
    read.kinds = np.full(len(cells), HEXAHEDRON)
    return read


def xdmf_records(path):
    """The moments of an XDMF file, in its order: (time [s], path of the HDF5 file)."""
    path = Path(path)
    grids = ElementTree.parse(path).getroot().findall("./Domain/Grid/Grid")
    return [
        (
            float(grid.find("Time").get("Value")),
            path.parent / grid.find("Geometry/DataItem").text.strip().split(":")[0],
        )
        for grid in grids
    ]
