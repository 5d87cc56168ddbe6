# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The examples prm/one-particle, each against the exact ordinary differential equation of its
laws, and the forces of prm's section Forces in runs of the program. Called with the path of
the binary.
"""

import math
import shutil

from runs import ROOT, RunTest, main

from common.one_sphere import Sphere

EXAMPLES = ROOT / "prm"
CASES = ROOT / "tests" / "cases"


class OneSphere(RunTest):
    """Speeds over time."""

    def speeds(self, name, values=None):
        """(time since its release, speed) in each step of an example."""
        run = self.run_file(EXAMPLES / name, {"Output/report": "false", **(values or {})})
        self.assertEqual(run.status, 0, run)
        rows = [row for row in run.rows("monitors.csv") if row["phase"] == "flow"]
        there = [n for n, row in enumerate(rows) if row["particles"] == 1]
        release = rows[there[0] - 1]["time"] if there[0] > 0 else 0.0
        return [(rows[n]["time"] - release, rows[n]["maximum_speed"]) for n in there]

    def assert_exact(self, name, sphere, tolerance, values=None):
        """Within the part @p tolerance of the last speed, all the time, and at the end the
        terminal velocity is reached but for 3 %."""
        speeds = self.speeds(name, values)
        end = abs(sphere.velocity(speeds[-1][0]))
        worst = max(abs(v - abs(sphere.velocity(t))) for t, v in speeds)
        print(f"{name}: {speeds[-1][1]} m/s of {end}, worst error {worst / end:.4f} of it")
        self.assertTrue(worst <= tolerance * end, f"{name}: off by {worst / end} of {end} m/s")
        self.assertLess(abs(sphere.acceleration(sphere.velocity(speeds[-1][0]))),
                        0.06 * abs(sphere.acceleration(0.0)))  # fmt: skip

    def test_the_terminal_velocity_of_mfix(self):
        sphere = Sphere(1e-4, 2000, 1.2, 1.8e-5, 0.4, gravity=9.80665)
        # MFiX's reference of DEM06, at 0.05, 0.1 and 0.24 s.
        for time, reference in ((0.05, -0.04078891), (0.1, -0.05263133), (0.24, -0.05725782)):
            self.assert_close(sphere.velocity(time), reference, 1e-5, "the equation itself")
        self.assert_exact("one-particle/terminal-velocity.prm", sphere, 0.005)

    def test_glass_in_air(self):
        self.assert_exact("one-particle/glass-in-air.prm", Sphere(1e-4, 2500, 1.18415, 1.85508e-5), 0.03)

    def test_glass_in_water(self):
        self.assert_exact("one-particle/glass-in-water.prm", Sphere(3e-3, 2500, virtual_mass=0.5), 0.03)

    def test_steel_in_oil(self):
        sphere = Sphere(3e-3, 7800, 870, 0.02, virtual_mass=0.5)
        self.assert_exact("one-particle/steel-in-oil.prm", sphere, 0.03)

    def test_foam_in_water(self):
        self.assert_exact("one-particle/foam-in-water.prm", Sphere(3e-3, 100, virtual_mass=0.5), 0.03)


class Forces(RunTest):
    """The section Forces, on a sphere in the flow of Poiseuille: tests/cases/sphere.prm."""

    DIAMETER, PLACE, RADIUS = 0.5e-3, 3e-3, 6e-3
    DENSITY, VISCOSITY, VELOCITY, SPIN = 998.0, 0.1, 0.01, 50.0
    VOLUME = math.pi / 6 * DIAMETER**3
    # Of pressure and friction on a volume of fluid.
    GRADIENT = 8 * VISCOSITY * VELOCITY / RADIUS**2

    def run_sphere(self, values):
        """The run with the overridden @p values, which must reach its end."""
        shutil.copytree(CASES, self.path, dirs_exist_ok=True)
        run = self.run_file("sphere.prm", values)
        self.assertEqual(run.status, 0, run)
        return run

    def force(self, values):
        """Of the fluid on the sphere at rest, three components [N]."""
        run = self.run_sphere(values)
        return run.particles(-1).values["fluid_force"][0]

    def test_friction_balances_pressure(self):
        push = self.VOLUME * self.GRADIENT
        # The mesh of 12 cells misses 4 % of Poiseuille's gradient.
        self.assert_close(self.force({})[2], push, 0.06, "pressure")
        self.assert_within(
            self.force({"Forces/viscous stress": "true"})[2], 0.0, 0.04 * push, "in sum"
        )

    def test_shear_lift_pushes_to_the_axis(self):
        vorticity = 4 * self.VELOCITY * self.PLACE / self.RADIUS**2
        # The filter, of a variance of 0.5 square millimetres, takes 3 % of the velocity.
        speed = 2 * self.VELOCITY * (1 - (self.PLACE**2 + 1e-6) / self.RADIUS**2)
        lift = (1.615 * self.DIAMETER**2 * speed
                * math.sqrt(self.DENSITY * self.VISCOSITY * vorticity))  # fmt: skip
        force = self.force({"Forces/shear lift": "saffman"})
        self.assert_close(force[0], -lift, 0.05, "Saffman's lift")

    def test_spin_lift_is_magnus(self):
        # Half a vorticity of 3.3 against a spin of 50 rad/s, across: along y the spin counts,
        # along x nothing does, as the flow has neither.
        slip = {"Forces/spin lift": "rubinow-keller", "Boundary conditions/bottom": "plug",
                "Boundary conditions/wall": "slip"}  # fmt: skip
        lift = math.pi / 8 * self.DENSITY * self.DIAMETER**3 * self.SPIN * self.VELOCITY
        force = self.force(slip)
        self.assert_close(force[1], lift, 0.02, "Magnus' lift")
        self.assert_within(force[0], 0.0, 0.01 * lift, "across it")

    def test_spin_decays_exponentially(self):
        tau = self.DENSITY * self.DIAMETER**2 / (60 * self.VISCOSITY)
        inertia = 0.1 * self.DENSITY * self.VOLUME * self.DIAMETER**2
        run = self.run_sphere({
            "Forces/rotational drag": "rubinow-keller", "Flow/superficial velocities": 0,
            "Flow/mode": "transient", "Flow/duration": 3 * tau, "Flow/time step": tau, "Flow/steady window": 3 * tau,
        })  # fmt: skip
        rows = [row for row in run.rows("monitors.csv") if row["phase"] == "flow"]
        self.assertEqual(len(rows), 3)
        for n, row in enumerate(rows):
            # Times are rounded to microseconds.
            energy = 0.5 * inertia * (self.SPIN * math.exp(-(n + 1))) ** 2
            # What the table rounds to.
            self.assert_close(row["kinetic_energy_per_particle"], energy, 1e-4, "energy of spin")

    def test_what_does_not_fit_is_refused(self):
        shutil.copytree(CASES, self.path, dirs_exist_ok=True)
        for values in (
            {"Forces/spin lift": "lun-liu", "Particles/scale": 2, "Particles/diameter": 2.5e-4},
            {"Forces/viscous stress": "true", "Coupling/model": "B"},
        ):
            run = self.run_file("sphere.prm", values, "--check")
            self.assertNotEqual(run.status, 0, run)
            self.assertIn(next(iter(values)), run.refusal)


if __name__ == "__main__":
    main()
