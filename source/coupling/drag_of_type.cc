// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/drag_of_type.h>
#include <graupel/dem/particles/particle_arrays.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    // Relative width of the difference, and the least one [m/s].
    constexpr double difference = 1e-3, least_difference = 1e-9;
  } // namespace

  double
  DragOfType::beta(const double alpha,
                   const double slip,
                   const double particle_radius) const
  {
    const double y = particle_radius / radius;
    return is_mixture ? polydisperse_drag_factor(alpha, y) * drag.beta(alpha, slip)
                      : drag.beta(alpha, slip, y);
  }

  double
  DragOfType::slope(const double alpha,
                    const double slip,
                    const double particle_radius) const
  {
    const double more = slip + std::max(difference * slip, least_difference);
    return (beta(alpha, more, particle_radius) * more -
            beta(alpha, slip, particle_radius) * slip) /
           (more - slip);
  }

  double
  stable_step(const double void_fraction, const double mass, const double slope)
  {
    const double dense = void_fraction < 0.5 ? void_fraction / (1. - void_fraction) : 1.;
    return 2. * void_fraction * dense * mass / slope;
  }

  double
  stable_step_at_rest(const DragOfType &drag,
                      const double      radius,
                      const double      density,
                      const double      void_fraction,
                      const double      velocity)
  {
    return stable_step(void_fraction,
                       density * sphere_volume(radius),
                       drag.slope(void_fraction, velocity / void_fraction, radius));
  }
} // namespace graupel
