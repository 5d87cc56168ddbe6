"""Reads the particles that a run wrote for ParaView."""

import base64
import re
import zlib
from xml.etree import ElementTree

import numpy as np


def decode(text):
    """Bytes of a DataArray of VTK's binary format, compressed by blocks.

    Source: VTK file formats, "appended and compressed data": a header of 32-bit numbers
    (blocks, their size, the size of the last, compressed sizes) in base64 of its own.
    """
    text = text.strip()
    n_blocks = int(np.frombuffer(base64.b64decode(text[:8])[:4], "<u4")[0])
    header_bytes = 4 * (3 + n_blocks)
    header_text = 4 * ((header_bytes + 2) // 3)
    header = np.frombuffer(base64.b64decode(text[:header_text]), "<u4")
    data = base64.b64decode(text[header_text:])
    blocks, start = [], 0
    for size in header[3 : 3 + n_blocks]:
        blocks.append(zlib.decompress(data[start : start + int(size)]))
        start += int(size)
    return b"".join(blocks)


def vectors(directory, place, number=0):
    """What each particle of the set @p number has at the @p place, an XPath, in a piece, as
    an array of shape (n, 3)."""
    file = directory / "vtu" / f"particles_{number:04d}.vtu"
    text = re.sub(r"<!--.*?-->", "", file.read_text(encoding="ascii"), flags=re.S)
    parts = []
    # A piece for each rank.
    for array in ElementTree.fromstring(text.strip()).findall(f".//{place}"):
        kind = "<f4" if array.get("type") == "Float32" else "<f8"
        parts.append(np.frombuffer(decode(array.text), kind).reshape(-1, 3).astype(float))
    return np.concatenate(parts)


def positions(directory, number=0):
    """Centers [m] of all particles of the set @p number, as an array of shape (n, 3)."""
    return vectors(directory, "Points/DataArray", number)


def fluid_forces(directory, number=0):
    """Forces of the fluid [N] on them, likewise."""
    return vectors(directory, "PointData/DataArray[@Name='fluid_force']", number)
