# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What `cmake --install` puts into an empty folder works there, and from there. Called with the
path of the binary, which lies in the folder of the build.
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from runs import ROOT, Program, environment, main, overrides

# Ergun's gradient of spheres of 2 mm in air at 0.5 m/s with a void fraction of 0.4.
SOURCE = """#include <graupel/closures/bed_correlations.h>
#include <cstdio>
int main()
{
  const graupel::FluidProperties air{1.2, 1.8e-5};
  std::printf("%.12g", graupel::ergun_pressure_gradient(air, 2e-3, 0.4, 0.5));
}
"""
PROJECT = """cmake_minimum_required(VERSION 3.22)
project(user LANGUAGES CXX)
find_package(Graupel 0.5 REQUIRED)
add_executable(user user.cc)
target_link_libraries(user PRIVATE Graupel::closures)
"""
QUICK = {"Filling/count": 20, "Mesh/cell size": 4.2e-3, "Flow/superficial velocities": 0.3}
UNREPORTED = {"Output/report": "false"}


class Installed(unittest.TestCase):
    """All tests share one folder, whose path has a space."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="graupel installed ")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.prefix = cls.folder / "prefix"
        build = Path(Program.path).parent
        subprocess.run(
            ["cmake", "--install", build, "--prefix", cls.prefix], check=True, capture_output=True
        )
        cls.program = cls.prefix / "bin" / "graupel"

    def call(self, *words):
        """A finished process that knows nothing of the sources."""
        clean = {k: v for k, v in environment().items() if k != "PYTHONPATH"}
        return subprocess.run(
            [str(word) for word in words],
            env=clean, cwd=self.folder, capture_output=True, text=True, timeout=300,
        )  # fmt: skip

    def run_short(self, output, values=None, program=None):
        example = self.prefix / "share" / "graupel" / "prm" / "packed-bed" / "short.prm"
        values = overrides({**QUICK, **(values or {})})
        return self.call(program or self.program, example, *values, "--output", output)

    def test_the_program_runs_and_reports(self):
        self.assertIn("graupel ", self.call(self.program, "--version").stdout)
        done = self.run_short("one")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("(open report.html)", done.stdout)
        self.assertGreater((self.folder / "one" / "report.html").stat().st_size, 10000)
        self.assertEqual(self.run_short("two", UNREPORTED).returncode, 0)
        compared = self.call(self.prefix / "bin" / "graupel-report", "one", "two")
        self.assertEqual(compared.returncode, 0, compared.stderr)
        self.assertIn("0.3", (self.folder / "comparison.html").read_text(encoding="utf-8"))
        listed = self.call(self.prefix / "bin" / "graupel-particles", "one", "bed.csv")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertEqual(len((self.folder / "bed.csv").read_text().splitlines()), 1 + 20)

    def test_without_its_report_it_says_so(self):
        alone = self.folder / "alone"
        alone.mkdir()
        shutil.copy(self.program, alone)
        done = self.run_short("unreported", program=alone / "graupel")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"{alone}/graupel-report is not there", done.stderr)
        self.assertNotIn("open report.html", done.stdout)
        self.assertTrue((self.folder / "unreported" / "cases.csv").exists())

    def test_the_program_does_not_know_where_it_was_built(self):
        for folder in {ROOT, Path(Program.path).parent}:
            paths = re.escape(os.fsencode(folder)) + rb"/[ -~]*"
            self.assertEqual(re.findall(paths, self.program.read_bytes())[:3], [])

    def test_a_project_of_ones_own(self):
        project = self.folder / "project"
        project.mkdir()
        (project / "user.cc").write_text(SOURCE)
        (project / "CMakeLists.txt").write_text(PROJECT)
        for step in (
            ["-S", "project", "-B", "project/build", f"-DCMAKE_PREFIX_PATH={self.prefix}"],
            ["--build", "project/build"],
        ):
            done = self.call("cmake", *step)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        viscous = 150 * 0.6**2 * 1.8e-5 * 0.5 / (0.4**3 * 2e-3**2)
        inertial = 1.75 * 0.6 * 1.2 * 0.5**2 / (0.4**3 * 2e-3)
        printed = float(self.call("project/build/user").stdout)
        self.assertTrue(abs(printed - viscous - inertial) < 1e-9 * printed, printed)

    def test_the_manual_has_every_option(self):
        manual = (self.prefix / "share" / "man" / "man1" / "graupel.1").read_text().replace("\\", "")
        options = set(re.findall(r"--[a-z-]+", self.call(self.program, "--help").stdout))
        self.assertGreater(len(options), 7)
        for option in options:
            self.assertIn(option, manual)

    def test_documentation_is_there(self):
        pages = self.prefix / "share" / "doc" / "graupel"
        for name in ("copyright", "README.md", "doc/index.md", "doc/images"):
            self.assertTrue((pages / name).exists(), name)


if __name__ == "__main__":
    main()
