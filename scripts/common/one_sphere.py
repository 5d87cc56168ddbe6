# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""A sphere that is released in a fluid: its equation of motion, by the drag law alone."""

import math

from .force_balance import GRAVITY, wen_yu


class Sphere:
    """One sphere in a fluid that moves upwards; SI units, upward is positive."""

    def __init__(self, diameter, density, fluid=998.0, viscosity=1e-3, flow=0.0,
                 virtual_mass=0.0, gravity=GRAVITY):  # fmt: skip
        self.diameter, self.fluid, self.viscosity, self.flow = diameter, fluid, viscosity, flow
        volume = math.pi / 6 * diameter**3
        self.mass = (density + virtual_mass * fluid) * volume
        self.weight = (density - fluid) * volume * gravity

    def drag(self, velocity):
        """Of Schiller and Naumann, 0.44 from a Reynolds number of 1000 on [N]."""
        slip = self.flow - velocity
        reynolds = self.fluid * abs(slip) * self.diameter / self.viscosity
        return math.pi / 8 * self.viscosity * self.diameter * wen_yu(1.0, reynolds) * slip

    def acceleration(self, velocity):
        """dv/dt [m/s2]."""
        return (self.drag(velocity) - self.weight) / self.mass

    def velocity(self, time, steps=400):
        """At this time after a release at rest, by Runge and Kutta [m/s]."""
        v, h, f = 0.0, time / steps, self.acceleration
        for _ in range(steps):
            a = f(v)
            b = f(v + h / 2 * a)
            c = f(v + h / 2 * b)
            v += h / 6 * (a + 2 * b + 2 * c + f(v + h * c))
        return v
