# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What other programs read of a run: its files for ParaView, lists of particles, the report and
a picture. Called with the path of the binary.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import unittest

from runs import ROOT, Program, RunTest, main

import numpy as np

import graupel

SHORT = ROOT / "tests" / "cases" / "shallow.prm"
# Of numbers in four bytes.
SINGLE = 1e-6

DUMP = """ITEM: TIMESTEP
7000
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS ff ff ff
-0.01 0.01
-0.01 0.01
0 0.02
ITEM: ATOMS id type x y z radius vx vy vz
12 1 0.0033333333333333335 0.001 0.005 0.001 0 0 0
5 1 -0.004 -0.0012345678901234567 0.01 0.0011 0 0 0
40 1 0 0 0.015 0.0009 0 0 0
"""


def script(name, *arguments):
    """The finished process of a script."""
    return subprocess.run(
        ["/usr/bin/python3", ROOT / "scripts" / name, *arguments], capture_output=True, text=True
    )


class ParaView(unittest.TestCase):
    """The files of a short run on two ranks, on a mesh with two levels."""

    VALUES = {
        "Output/report": "false",
        "Flow/superficial velocities": "0.5",
        "Mesh adaption/initial passes": 1,
        "Mesh adaption/surface threshold": 0.1,
        "Mesh adaption/maximum levels": 1,
    }

    @classmethod
    def setUpClass(cls):
        cls.test = RunTest()
        cls.test.setUp()
        cls.addClassCleanup(cls.test.doCleanups)
        cls.run_of_two = cls.test.run_file(SHORT, cls.VALUES, ranks=2)
        assert cls.run_of_two.status == 0, cls.run_of_two
        cls.run_read = graupel.read_run(cls.run_of_two.directory)

    def test_ids_are_whole_numbers_and_places_are_exact(self):
        read = self.run_read.particles()
        self.assertEqual(read.points.dtype, np.float64)
        self.assertEqual(read.values["diameter"].dtype, np.float64)
        self.assertEqual(read.values["id"].dtype, np.int64)
        np.testing.assert_array_equal(np.sort(read.values["id"]), np.arange(150))
        for name in ("type", "coordination_number", "wall_contacts"):
            self.assertEqual(read.values[name].dtype, np.int32, name)
        # As parameter files and lists count types.
        self.assertEqual(set(read.values["type"]), {1})
        # Not a number of four bytes.
        self.assertTrue(np.all(read.values["diameter"] == 3.2e-3))
        self.assertTrue(np.any(read.points != read.points.astype(np.float32)))

    def test_contacts_are_those_of_the_monitors(self):
        contacts, particles = self.run_read.contacts(), self.run_read.particles()
        of_walls = contacts.values["with_wall"] == 1
        self.assertEqual(contacts.values["with_wall"].dtype, np.int32)
        # Each value at both ends of a line.
        pairs = np.count_nonzero(~of_walls) // 2
        self.assertEqual(2 * pairs, particles.values["coordination_number"].sum())
        self.assertEqual(
            np.count_nonzero(of_walls) // 2, particles.values["wall_contacts"].sum()
        )
        # What walls carry, along the axis.
        lifted = contacts.values["force"][of_walls][::2, 2].sum()
        carried = self.run_read.cases[-1]["support_force"]
        self.assertGreater(carried, 0.01)
        # The case's value is a mean of its last quarter.
        self.assertAlmostEqual(lifted / carried, 1.0, delta=0.01)
        distance = np.linalg.norm(contacts.points[::2] - contacts.points[1::2], axis=1)
        ball = (contacts.values["with_wall"] == 0)[::2]
        expected = 3.2e-3 - contacts.values["overlap"][::2]
        np.testing.assert_allclose(distance[ball], expected[ball], rtol=1e-5)

    def test_interstitial_velocity_is_flux_over_void_fraction(self):
        values = self.run_read.fields().values
        expected = values["flux"] / values["void_fraction"][:, None]
        self.assertGreater(np.abs(values["flux"]).max(), 0.3)
        self.assertLess(values["void_fraction"].min(), 0.6)
        np.testing.assert_allclose(values["velocity"], expected, rtol=10 * SINGLE, atol=1e-7)

    def test_cells_know_their_rank_and_level(self):
        fields = self.run_read.fields()
        self.assertEqual(set(fields.values["subdomain"]), {0.0, 1.0})
        levels = fields.values["refinement_level"]
        self.assertEqual(len(set(levels)), 2)
        # A cell of the next level has an eighth of the volume, here measured by its box.
        corners = fields.points[fields.connectivity].reshape(len(fields.offsets), 8, 3)
        sizes = np.ptp(corners, axis=1)[:, 2]
        of_cells = levels[fields.connectivity].reshape(-1, 8)[:, 0]
        self.assertAlmostEqual(
            sizes[of_cells == of_cells.min()].mean() / sizes[of_cells == of_cells.max()].mean(),
            2.0, delta=1e-3,
        )  # fmt: skip

    def test_hdf5_has_the_same_fields_at_each_node_once(self):
        run = self.test.run_file(SHORT, {**self.VALUES, "Output/field format": "hdf5"}, ranks=2)
        self.assertEqual(run.status, 0, run)
        self.assertFalse((run.directory / "solution.pvd").exists())
        read = graupel.read_run(run.directory)
        [(time, path)] = read.records("solution")
        self.assertAlmostEqual(time, self.run_read.records("solution")[0][0], delta=1e-6)
        self.assertTrue(path.exists())
        if importlib.util.find_spec("h5py") is None:
            with self.assertRaisesRegex(ImportError, "apt-get install python3-h5py"):
                read.fields()
            return
        once, corners = read.fields(), self.run_read.fields()
        self.assertEqual(len(corners.offsets), len(once.offsets))
        self.assertLess(len(once.points), 0.25 * len(corners.points))

        distance = np.linalg.norm(corners.points[:, None] - once.points[None], axis=2)
        nearest = distance.argmin(axis=1)
        # Nodes between two ranks are there twice.
        self.assertLess(max(distance.min(axis=axis).max() for axis in (0, 1)), 1e-8)
        for name in ("pressure", "void_fraction", "flux", "velocity", "drag_coefficient"):
            largest = np.abs(once.values[name]).max()
            self.assertGreater(largest, 0.0)
            np.testing.assert_allclose(
                once.values[name][nearest], corners.values[name], atol=SINGLE * largest
            )

    def test_picture(self):
        target = self.test.path / "bed.png"
        done = script("render", self.run_of_two.directory, target)
        if importlib.util.find_spec("vtkmodules") is None:
            self.assertIn("apt-get install python3-vtk9", done.stderr)
        elif "DISPLAY" not in os.environ and shutil.which("xvfb-run") is None:
            self.assertIn("apt-get install xvfb", done.stderr)
        else:
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(target.read_bytes().startswith(b"\x89PNG"))
            self.assertGreater(target.stat().st_size, 20000, "an empty picture")


class Lists(RunTest):
    """Particles of another program."""

    def test_a_dump_becomes_the_spheres_of_a_run(self):
        dump, table = self.path / "a.dump", self.path / "a.csv"
        dump.write_text(DUMP)
        done = script("particles", dump, table)
        self.assertEqual(done.returncode, 0, done.stderr)
        # Without gravity and flow they stay where they are.
        values = {
            "Particles/gravity": 0,
            "Particles/scale": 1,
            "Particles/size distribution": "list",
            "Particles/size list": "1.8e-3: 1, 2e-3: 1, 2.2e-3: 1",
            "Filling/method": "list",
            "Filling/count": 0,
            "Filling/file": table,
            "Settling/kinetic energy": 1,
            "Settling/speed": 10,
            "Settling/interval": 0.01,
            "Flow/superficial velocities": "",
            "Output/report": "false",
        }
        run = self.run_file(SHORT, values)
        self.assertEqual(run.status, 0, run)
        given = graupel.read_particles(dump)
        found = graupel.read_particles(run.directory)
        order = np.argsort(given.position[:, 0]), np.argsort(found.position[:, 0])
        for key in ("position", "diameter", "velocity", "type"):
            np.testing.assert_array_equal(
                getattr(given, key)[order[0]], getattr(found, key)[order[1]], key
            )


class Log(RunTest):
    """What log.txt says."""

    FRICTION = "Contact/particle friction"

    def log_of(self, run):
        return (run.directory / "log.txt").read_text(encoding="utf-8")

    def test_it_opens_with_what_the_run_is(self):
        run = self.run_file(SHORT, {"Output/report": "false", "Flow/superficial velocities": "0.3, 0.5"})
        self.assertEqual(run.status, 0, run)
        first, second, third, *_ = self.log_of(run).splitlines()
        self.assertRegex(
            first, r"^graupel \d+\.\d+\.\d+.*, 20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC, on \S+, 1 rank$"
        )
        self.assertIn(f"{Program.path} {SHORT} --set Output/report=false", second)
        self.assertIn("--set 'Flow/superficial velocities=0.3, 0.5'", second)
        self.assertIn("at most", self.log_of(run).splitlines()[3])  # the cases end when steady
        cells, unknowns = map(int, re.findall(r"\d+", third))
        self.assertEqual(cells, run.rows("monitors.csv")[-1]["cells"])
        # Three of flux and one of pressure in each corner, which cells have each for itself.
        points = np.round(graupel.Run(run.directory).fields().points, 7)
        self.assertEqual(unknowns, 4 * len(np.unique(points, axis=0)))

    def test_a_phase_is_a_line(self):
        values = {"Output/report": "false", "Filling/count": 20, "Flow/mode": "steady"}
        log = self.log_of(self.run_file(SHORT, values))
        for line in (
            r"^fill: 20 particles in [\d.]+ s of simulated time; took .*$",
            r"^settle: at rest after [\d.]+ s of simulated time; took .*$",
            r"^flow 1/2, superficial velocity 0.3 m/s: steady flow after \d+ linear systems; took .*$",
        ):
            self.assertEqual(len(re.findall(line, log, re.M)), 1, log)
        for start in ("fill:", "settle:", "flow 1/2", "flow 2/2"):
            self.assertEqual(log.count(start), 1, log)
        for word in ("V_s", "-0 N", "from 0"):
            self.assertNotIn(word, log)

    def test_a_moving_flow_tells_its_steps(self):
        values = {"Output/report": "false", "Filling/count": 20, "Flow/superficial velocities": 0.3,
                  "Flow/stop when": "flow-throughs", "Flow/duration": 0.05}  # fmt: skip
        log = self.log_of(self.run_file(SHORT, values))
        told = "after 0.05 s of simulated time; steps of the fluid: 5 by Flow/time step; took "
        self.assertIn(told, log)

    def test_what_is_to_be_known_is_noted(self):
        quick = {"Output/report": "false", "Filling/count": 20, "Flow/mode": "steady"}
        both = "while the bed is filled and settles: Contact/packing particle friction = 0.08; " \
               "from then on: Contact/particle friction = 0.3"  # fmt: skip
        no_rolling = {"Contact/particle rolling resistance": 0, "Contact/wall rolling resistance": 0}
        coarse = "cells of 0.0042 m are longer than a simulated particle (0.0032 m)"
        run = self.run_file(SHORT, {**quick, **no_rolling, self.FRICTION: 0.3})
        check = self.run_file(SHORT, {**no_rolling, self.FRICTION: 0.3}, "--check")
        for text in (self.log_of(run), check.said):
            self.assertIn(f"note: {both}", text)
            self.assertIn(f"note: {coarse}", text)
        resolved = self.run_file(SHORT, {**no_rolling, "Mesh/cell size": 2.1e-3}, "--check")
        self.assertNotIn("note:", resolved.said)


class Report(RunTest):
    """What the program says of its report."""

    def test_the_reference_is_in_the_summary(self):
        run = self.run_file(SHORT, {"Output/report": "false"})
        self.assertEqual(run.summary["reference"], "none")
        self.assertNotIn("report.html", run.said)

    def test_without_matplotlib_the_way_out_is_told(self):
        broken = self.path / "broken"
        broken.mkdir()
        (broken / "matplotlib.py").write_text("raise ImportError('No module named matplotlib')\n")
        environment = {**os.environ, "PYTHONPATH": str(broken)}
        output = self.path / "o"
        done = subprocess.run(
            [Program.path, SHORT, "--set", "Filling/count=20", "--output", output],
            capture_output=True, text=True, env=environment,
        )  # fmt: skip
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertFalse((output / "report.html").exists())
        self.assertNotIn("open report.html", done.stdout)
        self.assertIn(f"Results are in {output}", done.stdout)
        log = (output / "log.txt").read_text()
        for text in (done.stderr, log):
            self.assertIn("No report was made", text)
            self.assertIn("apt-get install python3-matplotlib", text)
            self.assertIn(f"graupel-report' '{output}'", text)


if __name__ == "__main__":
    main()
