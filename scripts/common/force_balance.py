# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What a homogeneous bed does whose drag carries its weight, by the drag law alone.

The forms of the program's closures, written a second time, for both phases sharing the
pressure gradient: the drag on a sphere is F = pi/8 mu d u N(alpha, Re) at the interstitial slip
u, Re = rho u d / mu. In a uniform suspension alpha (-dp/dz) = n F and -dp/dz =
(1 - alpha) (rho_p - rho) g, so that F = alpha V_p (rho_p - rho) g.
"""

import math
from dataclasses import dataclass

GRAVITY = 9.81


def dallavalle(x):
    """Of one sphere in clear fluid; Dallavalle, Micromeritics (1948)."""
    return (0.63 * math.sqrt(x) + 4.8) ** 2


def wen_yu(alpha, reynolds):
    """Wen & Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100, with Schiller and Naumann's drag."""
    x = alpha * reynolds
    one = 24.0 * (1.0 + 0.15 * x**0.687) if x < 1000.0 else 0.44 * x
    return one * alpha**-2.65


def ergun(alpha, reynolds):
    """Ergun, Chem. Eng. Prog. 48 (1952) 89."""
    return 4.0 / 3.0 * (150.0 * (1.0 - alpha) / alpha + 1.75 * reynolds)


def rong(alpha, reynolds):
    """Rong, Dong & Yu, Chem. Eng. Sci. 99 (2013) 44, doi:10.1016/j.ces.2013.05.036."""
    x = alpha * reynolds
    bell = math.exp(-0.5 * (1.5 - math.log10(x)) ** 2)
    exponent = 2.65 * (alpha + 1.0) - (5.3 - 3.5 * alpha) * alpha**2 * bell
    return dallavalle(x) * alpha ** (1.0 - exponent)


@dataclass
class Suspension:
    """Equal spheres in a fluid; SI units."""

    law: callable
    diameter: float
    density: float
    fluid_density: float
    viscosity: float

    def slip(self, alpha):
        """Interstitial velocity of the fluid past the spheres at which the drag carries them
        [m/s]."""
        volume = math.pi / 6.0 * self.diameter**3
        net = alpha * volume * abs(self.density - self.fluid_density) * GRAVITY
        scale = math.pi / 8.0 * self.viscosity * self.diameter

        def drag(u):
            reynolds = self.fluid_density * u * self.diameter / self.viscosity
            return scale * u * self.law(alpha, reynolds)

        return bisect(lambda u: drag(u) - net, 1e-12, 1e3)

    def superficial_velocity(self, alpha):
        """At which a bed that rests in the mean has the void fraction @p alpha [m/s]."""
        return alpha * self.slip(alpha)

    def void_fraction(self, velocity):
        """Of a bed fluidised at a superficial velocity [m/s]."""
        return bisect(lambda alpha: self.superficial_velocity(alpha) - velocity, 0.3, 0.9999)

    def settling_velocity(self, alpha):
        """At which the suspension sinks in a closed vessel [m/s]: without a net flux the
        fluid rises, alpha u = (1 - alpha) v, so that the slip is v / alpha."""
        return alpha * self.slip(alpha)


def bisect(rising, low, high):
    """The zero of a rising function."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rising(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)
