// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_closures_self_disturbance_h
#define graupel_closures_self_disturbance_h

#include <graupel/closures/fluid_properties.h>

namespace graupel
{
  // What a particle that is spread over the mesh does to the fields that it feels. A drag
  // law wants those that were there without it.

  /**
   * exp(x^2) erfc(x) [-] for x >= 0, without overflow.
   */
  double scaled_erfc(const double x);

  /**
   * Velocity over the force [s/kg] in the middle of a steady force that is spread as a
   * Gaussian of standard deviation @p s [m] and past which clear fluid flows with @p slip
   * [m/s], along it:
   *
   *   u / F = g(x) / (3 pi mu s sqrt(2 pi)),   x = rho slip s / (sqrt(2) mu),
   *   g = 3 sqrt(pi) / (4 x) (1 - 2 / (sqrt(pi) x) + (1 - exp(x^2) erfc(x)) / x^2).
   *
   * It is the integral over all wave numbers k, with m the cosine between k and the
   * force, of Oseen's operator times the Gaussian's transform,
   *
   *   u / F = (2 pi)^-3 integral (1 - m^2) Re (mu k^2 + i rho slip k m)^-1 exp(-k^2 s^2 /
   * 2).
   *
   * In slow flow g = 1, in fast flow 3 sqrt(pi) / (4 x).
   * Source of the correction by regularised Stokeslets and Oseenlets: Evrard, Denner &
   * van Wachem (2020), doi:10.1016/j.jcp.2020.109561; Balachandar, Liu & Lakhote (2019),
   * doi:10.1016/j.jcp.2018.09.033. The closed form is that of the integral.
   */
  double gaussian_mobility(const FluidProperties &fluid,
                           const double           s,
                           const double           slip);

  /**
   * The same among other particles that do not move and take the momentum B u a volume
   * out of the fluid, @p drag_over_void = B / alpha [kg/m^3/s]. In slow flow that is
   * Brinkman's screening, the factor
   *
   *   h(y) = 1 - sqrt(pi) y exp(y^2) erfc(y),   y = s sqrt(B / (2 alpha mu));
   *
   * with inertia it is (g^-2 + h^-2 - 1)^-1/2 in place of g: right in both limits, and in
   * between within a fifth of the integral with mu k^2 + B / alpha.
   */
  double screened_mobility(const FluidProperties &fluid,
                           const double           s,
                           const double           slip,
                           const double           drag_over_void);

  /**
   * Structure factor [-] at long waves of hard spheres in equilibrium at the @p
   * solid_fraction phi, from their compressibility:
   *
   *   S = (1 - phi)^4 / ((1 + 2 phi)^2 + phi^3 (phi - 4)),
   *
   * 1 for a dilute cloud, 0.02 where they freeze, at 0.494. Spheres in disorder that are
   * denser are packed, not in equilibrium: from there to 0.545, where a crystal would
   * melt, it goes to 0. The mark of one sphere in a filtered field, less the hole that
   * its neighbours leave around it, is S times its own. Source: Carnahan & Starling
   * (1969), doi:10.1063/1.1672048.
   */
  double hard_sphere_structure_factor(const double solid_fraction);
} // namespace graupel

#endif
