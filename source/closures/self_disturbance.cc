// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/self_disturbance.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    const double root_pi = std::sqrt(dealii::numbers::PI);

    // Below, the series serves: the closed form loses its digits [-].
    constexpr double small = 1e-2;

    // Solid fractions of hard spheres where the fluid freezes and the crystal melts [-].
    constexpr double freezing = 0.494, melting = 0.545;

    double
    oseen_factor(const double x)
    {
      if (x < small)
        return 1. - 3. * root_pi / 8. * x + 0.4 * x * x;
      return 3. * root_pi / (4. * x) *
             (1. - 2. / (root_pi * x) + (1. - scaled_erfc(x)) / (x * x));
    }

    double
    brinkman_factor(const double y)
    {
      // For large y the difference of two numbers near 1.
      return y > 20. ? 0.5 / (y * y) : 1. - root_pi * y * scaled_erfc(y);
    }

    double
    stokes_mobility(const FluidProperties &fluid, const double s)
    {
      return 1. / (3. * dealii::numbers::PI * fluid.viscosity * s *
                   std::sqrt(2. * dealii::numbers::PI));
    }

    double
    oseen_argument(const FluidProperties &fluid, const double s, const double slip)
    {
      return fluid.density * slip * s / (std::sqrt(2.) * fluid.viscosity);
    }
  } // namespace

  double
  scaled_erfc(const double x)
  {
    if (x < 10.)
      return std::exp(x * x) * std::erfc(x);
    const double z = 0.5 / (x * x);
    return (1. - z * (1. - 3. * z * (1. - 5. * z))) / (root_pi * x);
  }

  double
  gaussian_mobility(const FluidProperties &fluid, const double s, const double slip)
  {
    return oseen_factor(oseen_argument(fluid, s, slip)) * stokes_mobility(fluid, s);
  }

  double
  screened_mobility(const FluidProperties &fluid,
                    const double           s,
                    const double           slip,
                    const double           drag_over_void)
  {
    const double g = oseen_factor(oseen_argument(fluid, s, slip));
    const double h =
      brinkman_factor(s * std::sqrt(0.5 * drag_over_void / fluid.viscosity));
    return stokes_mobility(fluid, s) / std::sqrt(1. / (g * g) + 1. / (h * h) - 1.);
  }

  double
  hard_sphere_structure_factor(const double solid_fraction)
  {
    const double phi   = std::clamp(solid_fraction, 0., 1.);
    const double fluid = std::clamp((melting - phi) / (melting - freezing), 0., 1.);
    return fluid * std::pow(1. - phi, 4) /
           (std::pow(1. + 2. * phi, 2) + phi * phi * phi * (phi - 4.));
  }
} // namespace graupel
