# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Reads VTU and VTP files, Graupel's own and those of other programs, and PVD lists.

Arrays may be plain text, in base64, or appended (base64 or raw), compressed by zlib or not.
Source: VTK User's Guide, "XML file formats".
"""

import base64
import re
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

TYPES = {
    "Int8": "i1",
    "UInt8": "u1",
    "Int16": "i2",
    "UInt16": "u2",
    "Int32": "i4",
    "UInt32": "u4",
    "Int64": "i8",
    "UInt64": "u8",
    "Float32": "f4",
    "Float64": "f8",
}


@dataclass
class VtuFile:
    """What one file holds, all its pieces (a piece is of one MPI process) as one.

    points        positions, shape (points, 3) [m], in the file's own precision
    values        by name the values at the points: shape (points,), or (points, 3) of a vector
    cell_values   the same of the cells
    connectivity  the points of the cells, one cell behind another; none of a VTP file
    offsets       where each cell ends in it, shape (cells,)
    kinds         VTK's number of the kind of each cell, shape (cells,)
    """

    points: np.ndarray
    values: dict = field(default_factory=dict)
    cell_values: dict = field(default_factory=dict)
    connectivity: np.ndarray = None
    offsets: np.ndarray = None
    kinds: np.ndarray = None


class Decoder:
    """Makes arrays of the DataArrays of a file."""

    def __init__(self, root, appended, take):
        """@p appended are the bytes behind the underscore of AppendedData, or None; @p take is
        how to read them, as taken_from_base64 or taken_raw."""
        self.order = ">" if root.get("byte_order") == "BigEndian" else "<"
        self.header = np.dtype(self.order + TYPES[root.get("header_type", "UInt32")])
        compressor = root.get("compressor", "vtkZLibDataCompressor")
        if compressor != "vtkZLibDataCompressor":
            raise ValueError(f"arrays are compressed by {compressor}; only zlib is known")
        # Graupel's files, and deal.II's, name their compressor.
        self.is_compressed = root.get("compressor") is not None
        self.appended, self.take = appended, take

    def array(self, element):
        """The numbers of a DataArray, (n,) or (n, components)."""
        kind = np.dtype(self.order + TYPES[element.get("type")])
        if element.get("format", "ascii") == "ascii":
            numbers = np.array((element.text or "").split(), dtype=kind)
        else:
            numbers = np.frombuffer(self.bytes_of(element), kind)
        n_components = int(element.get("NumberOfComponents", 1))
        numbers = numbers.astype(kind.newbyteorder("="))
        return numbers if n_components == 1 else numbers.reshape(-1, n_components)

    def bytes_of(self, element):
        """The bytes of an array that is not plain text."""
        if element.get("format") == "appended":
            return self.unpacked(self.appended[int(element.get("offset")) :], self.take)
        return self.unpacked((element.text or "").strip().encode("ascii"), taken_from_base64)

    def unpacked(self, text, take):
        """The bytes behind their header; @p take gives n bytes of the text, and what is left."""
        if not text:
            return b""
        size = self.header.itemsize
        if not self.is_compressed:
            first, _ = take(text, size)
            n = int(np.frombuffer(first, self.header)[0])
            # In base64, header and data are one text.
            return take(text, size + n)[0][size:]
        n_blocks = int(np.frombuffer(take(text, size)[0], self.header)[0])
        header, text = take(text, size * (3 + n_blocks))
        sizes = [int(n) for n in np.frombuffer(header, self.header)[3:]]
        data, _ = take(text, sum(sizes))
        blocks, start = [], 0
        for size in sizes:
            blocks.append(zlib.decompress(data[start : start + size]))
            start += size
        return b"".join(blocks)


def taken_from_base64(text, n):
    """n bytes from the beginning of a text in base64, and the text behind them."""
    length = 4 * ((n + 2) // 3)
    return base64.b64decode(text[:length])[:n], text[length:]


def taken_raw(data, n):
    """The same of bytes as they are."""
    return data[:n], data[n:]


def parsed(path):
    """The root of the file's XML, and its Decoder."""
    data = Path(path).read_bytes()
    appended, take = None, taken_from_base64
    start = data.find(b"<AppendedData")
    if start >= 0:
        # Bytes that are no XML.
        begin = data.index(b"_", data.index(b">", start)) + 1
        end = data.rindex(b"</AppendedData>")
        take = taken_raw if b'"raw"' in data[start:begin] else take
        appended = data[begin:end] if take is taken_raw else data[begin:end].strip()
        data = data[:start] + b"</VTKFile>"
    # Some writers begin with a comment, before which XML allows nothing.
    text = re.sub(rb"<!--.*?-->", b"", data, flags=re.S).strip()
    root = ElementTree.fromstring(text)
    return root, Decoder(root, appended, take)


def joined(parts):
    """Arrays of the pieces as one; pieces without points say nothing of its shape."""
    parts = [part for part in parts if part.size] or parts[:1]
    return np.concatenate(parts) if parts else np.zeros(0)


def read_vtu(path):
    """The VTU or VTP file at @p path as a VtuFile."""
    root, decoder = parsed(path)
    pieces = root.findall("./*/Piece")

    def all_of(place):
        arrays = [[decoder.array(one) for one in piece.findall(place)] for piece in pieces]
        return [one[0] for one in arrays if one]

    def named(place):
        names = [one.get("Name") for one in (pieces[0].findall(place) if pieces else [])]
        return {name: joined(all_of(f"{place}[@Name='{name}']")) for name in names}

    points = joined(all_of("Points/DataArray")).reshape(-1, 3)
    file = VtuFile(points, named("PointData/DataArray"), named("CellData/DataArray"))
    if root.get("type") == "UnstructuredGrid":
        corners = all_of("Cells/DataArray[@Name='connectivity']")
        ends = all_of("Cells/DataArray[@Name='offsets']")
        # Every piece counts its own points from 0.
        counts = [len(one) for one in all_of("Points/DataArray")]
        firsts = np.concatenate(([0], np.cumsum(counts)[:-1]))
        sizes = [len(one) for one in corners]
        before = np.concatenate(([0], np.cumsum(sizes)[:-1]))
        file.connectivity = joined([one + first for one, first in zip(corners, firsts)])
        file.offsets = joined([one + first for one, first in zip(ends, before)])
        file.kinds = joined(all_of("Cells/DataArray[@Name='types']"))
    return file


def pvd_records(path):
    """The moments of a PVD file, in its order: (time [s], path of the file)."""
    path = Path(path)
    sets = ElementTree.parse(path).getroot().iter("DataSet")
    return [(float(one.get("timestep")), path.parent / one.get("file")) for one in sets]
