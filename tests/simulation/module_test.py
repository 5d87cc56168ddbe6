#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Tests of the Python module graupel, without the program; run with Debian's python3."""

import base64
import contextlib
import io
import re
import struct
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "python"))

import numpy as np

import graupel
from graupel import particle_lists
from graupel.parameters import read_parameters

POINTS = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0], [6.0, 7.0, 8.1]])
IDS = np.array([2**40 + 1, 2**24 + 1, 7])


class FolderTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def write(self, name, content):
        """A file of the folder; returns its path."""
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path


def block(data, header="<I"):
    """An array as it stands in a file that is not compressed, before base64."""
    return struct.pack(header, len(data)) + data


def compressed(data, size=16):
    """The same in compressed blocks of @p size bytes, the header apart."""
    parts = [zlib.compress(data[k : k + size]) for k in range(0, len(data), size)]
    header = [len(parts), size, len(data) % size, *map(len, parts)]
    return struct.pack(f"<{len(header)}I", *header), b"".join(parts)


def in_base64(data):
    return base64.b64encode(data).decode()


class Vtu(FolderTest):
    """Every way in which VTK writes an array comes back as the numbers that were written."""

    def file_of(self, arrays, attributes="", appended=b"", kind="UnstructuredGrid"):
        """A file with a piece of each (points, ids) of DataArrays."""
        pieces = "".join(
            f"<Piece><Points>{points}</Points><PointData>{ids}</PointData></Piece>"
            for points, ids in arrays
        )
        text = (
            f'<?xml version="1.0" ?>\n<!-- made -->\n<VTKFile type="{kind}" {attributes}>'
            f"<{kind}>{pieces}</{kind}>"
        )
        return self.write("a.vtu", text.encode() + appended + b"</VTKFile>")

    @staticmethod
    def arrays(how, points, ids):
        return (
            f'<DataArray type="Float64" NumberOfComponents="3" {how} {points}</DataArray>',
            f'<DataArray type="Int64" Name="id" {how} {ids}</DataArray>',
        )

    def expect(self, path):
        read = graupel.read_vtu(path)
        np.testing.assert_array_equal(read.points, POINTS)
        np.testing.assert_array_equal(read.values["id"], IDS)
        self.assertEqual(read.values["id"].dtype, np.int64)

    def test_plain_text(self):
        points = " ".join(map(str, POINTS.ravel()))
        ids = " ".join(map(str, IDS))
        self.expect(self.file_of([self.arrays('format="ascii">', points, ids)]))

    def test_base64(self):
        points, ids = (in_base64(block(a.tobytes(), "<Q")) for a in (POINTS, IDS))
        arrays = self.arrays('format="binary">', points, ids)
        self.expect(self.file_of([arrays], 'header_type="UInt64"'))

    def test_compressed_in_two_pieces(self):
        pieces = []
        for part in (slice(0, 2), slice(2, 3)):
            texts = ("".join(map(in_base64, compressed(a[part].tobytes()))) for a in (POINTS, IDS))
            pieces.append(self.arrays('format="binary">', *texts))
        self.expect(self.file_of(pieces, 'compressor="vtkZLibDataCompressor"'))

    def test_appended_raw(self):
        first, second = (block(a.tobytes()) for a in (POINTS, IDS))
        arrays = self.arrays('format="appended"', 'offset="0">', f'offset="{len(first)}">')
        appended = b'<AppendedData encoding="raw">\n_' + first + second + b"\n</AppendedData>"
        self.expect(self.file_of([arrays], "", appended, "PolyData"))

    def test_appended_in_base64(self):
        first, second = (in_base64(block(a.tobytes())) for a in (POINTS, IDS))
        arrays = self.arrays('format="appended"', 'offset="0">', f'offset="{len(first)}">')
        appended = f'<AppendedData encoding="base64">_{first}{second}</AppendedData>'
        self.expect(self.file_of([arrays], "", appended.encode()))

    def test_cells_count_on_over_the_pieces(self):
        def piece(first, connectivity, ends):
            return (
                f'<Piece><Points><DataArray type="Float64" NumberOfComponents="3">{first} 0 0'
                f" {first} 1 0</DataArray></Points><Cells>"
                f'<DataArray type="Int32" Name="connectivity">{connectivity}</DataArray>'
                f'<DataArray type="Int32" Name="offsets">{ends}</DataArray>'
                '<DataArray type="UInt8" Name="types">3</DataArray></Cells></Piece>'
            )

        text = piece(0, "0 1", "2") + piece(1, "1 0", "2")
        path = self.write(
            "b.vtu",
            f'<VTKFile type="UnstructuredGrid"><UnstructuredGrid>{text}</UnstructuredGrid>'
            "</VTKFile>",
        )
        read = graupel.read_vtu(path)
        np.testing.assert_array_equal(read.connectivity, [0, 1, 3, 2])
        np.testing.assert_array_equal(read.offsets, [2, 4])

    def test_another_compressor_is_refused_by_name(self):
        path = self.file_of([], 'compressor="vtkLZ4DataCompressor"')
        with self.assertRaisesRegex(ValueError, "LZ4"):
            graupel.read_vtu(path)


DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z radius
1 1 0.5 0.5 0.5 0.1
ITEM: TIMESTEP
1000
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
-0.01 0.01
-0.02 0.02
0.0 0.1
ITEM: ATOMS id type element xs ys zs radius vx vy vz omegax omegay omegaz
9 2 Fe 0.5 0.75 0.1 0.0015 0.1 0.2 0.3 4 5 6
3 1 Si 0.25 0.5 0.5 0.001 0 0 -1 0 0 0
"""


class Lists(FolderTest):
    """Particles of other programs."""

    def expect_two(self, particles):
        np.testing.assert_allclose(
            particles.position, [[-0.005, 0.0, 0.05], [0.0, 0.01, 0.01]], rtol=0.0, atol=1e-17
        )
        np.testing.assert_array_equal(particles.diameter, [0.002, 0.003])
        np.testing.assert_array_equal(particles.velocity, [[0, 0, -1], [0.1, 0.2, 0.3]])
        np.testing.assert_array_equal(particles.spin, [[0, 0, 0], [4, 5, 6]])
        np.testing.assert_array_equal(particles.type, [1, 2])

    def test_last_moment_of_a_dump_by_id_and_to_scale(self):
        self.expect_two(graupel.read_particles(self.write("a.dump", DUMP)))

    def test_round_trip_keeps_every_digit(self):
        first = graupel.read_particles(self.write("a.dump", DUMP))
        first.position[0, 0] = -0.1 / 3.0
        for name in ("b.csv", "c.dump", "d.csv"):
            graupel.write_particles(self.folder / name, first)
            again = graupel.read_particles(self.folder / name)
            for key in ("position", "velocity", "spin", "type"):
                np.testing.assert_array_equal(getattr(again, key), getattr(first, key), name)
            np.testing.assert_array_equal(again.diameter, first.diameter)

    def test_paraviews_table(self):
        path = self.write("t.csv", "radius,Points:0,Points:1,Points:2,velocity:2\n1e-3,1,2,3,-1\n")
        particles = graupel.read_particles(path)
        np.testing.assert_array_equal(particles.position, [[1, 2, 3]])
        np.testing.assert_array_equal(particles.velocity, [[0, 0, -1]])
        np.testing.assert_array_equal(particles.diameter, [2e-3])

    def test_what_is_lacking_is_said(self):
        for name, content, word in (
            ("a.csv", "x,y,diameter\n0,0,1\n", "column z"),
            ("b.csv", "x,y,z\n0,0,1\n", "--diameter"),
            ("c.csv", "x,y,z,diameter\n", "no particles"),
            ("d.dump", DUMP.rsplit("\n", 2)[0], "not complete"),
            ("e.txt", "hello\n", "ITEM: ATOMS"),
        ):
            with self.assertRaisesRegex(particle_lists.NoParticles, word):
                graupel.read_particles(self.write(name, content))

    def call(self, *arguments):
        """Exit status of the command, and what it says of errors."""
        argv, sys.argv = sys.argv, ["particles", *map(str, arguments)]
        errors = io.StringIO()
        try:
            with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
                return particle_lists.main(), errors.getvalue()
        finally:
            sys.argv = argv

    def test_command_in_millimetres(self):
        source = self.write("mm.csv", "x,y,z\n5,0,10\n")
        target = self.folder / "m.csv"
        status, _ = self.call(source, target, "--unit", "1e-3", "--diameter", "2e-3")
        self.assertEqual(status, 0)
        particles = graupel.read_particles(target)
        np.testing.assert_allclose(particles.position, [[0.005, 0.0, 0.01]], rtol=1e-15)
        np.testing.assert_allclose(particles.diameter, [0.002], rtol=1e-15)
        status, errors = self.call(self.folder / "absent.csv", target)
        self.assertEqual(status, 1)
        self.assertIn("absent.csv", errors)


class Columns(FolderTest):
    """The module and doc/output-files.md say the same."""

    def test_units_are_those_of_the_documentation(self):
        text = (ROOT / "doc" / "output-files.md").read_text(encoding="utf-8")
        # The tables of the CSV files, which have a unit in their second column. In spectra
        # it is a density of the column's name, and names of probes are the user's.
        tables = re.findall(r"^## (?!spectra)\S+\.csv.*?(?=^## )", text, flags=re.M | re.S)
        rows = re.findall(r"^\| `(\w+)` \| (\S+) \|", "\n".join(tables), flags=re.M)
        self.assertGreater(len(rows), 80)
        for name, unit in rows:
            if name.startswith("NAME_"):
                continue
            # "contacts", "particles" and the like have one unit wherever they are.
            self.assertEqual(graupel.UNITS.get(name), unit, name)

    def test_version_is_that_of_the_program(self):
        project = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(graupel VERSION (\S+)", project).group(1)
        package = (ROOT / "python" / "pyproject.toml").read_text(encoding="utf-8")
        self.assertIn(f'version = "{version}"', package)

    def test_parameters_by_path(self):
        path = self.write(
            "parameters.prm",
            "# made\nsubsection Flow\n  # Step [s].\n  set time step = 1e-2  # auto\nend\n"
            "subsection Particles\n  subsection Type 2\n    set scale = 3\n  end\n"
            "  set density = \nend\n",
        )
        expected = {"Flow/time step": "1e-2", "Particles/Type 2/scale": "3"}
        self.assertEqual(read_parameters(path), {**expected, "Particles/density": ""})


if __name__ == "__main__":
    unittest.main()
