// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_drag_of_type_h
#define graupel_coupling_drag_of_type_h

#include <graupel/closures/scaling.h>

namespace graupel
{
  /** The drag on the particles of one type. */
  struct DragOfType
  {
    /** For a sphere of this radius. */
    Drag drag;
    /** Radius of that simulated sphere [m]. */
    double radius;
    /** Others: by polydisperse_drag_factor(), or each by the law for its own diameter. */
    bool is_mixture = false;

    /** beta_p [kg/s] of a simulated sphere of this @p particle_radius [m]; see
     * Drag::beta(). */
    double beta(const double alpha,
                const double slip,
                const double particle_radius) const;

    /**
     * dF/d|u - v| [kg/s] of F = beta_p |u - v| at this @p slip [m/s], by a finite
     * difference: beta_p in slow flow, twice that where the drag grows with the square.
     */
    double slope(const double alpha,
                 const double slip,
                 const double particle_radius) const;
  };

  /**
   * The step of the fluid [s] up to which a drag that is held over it, on a sphere of
   * this @p mass [kg], leaves a homogeneous bed that moves stable,
   *
   *   alpha min(2, 2 alpha / (1 - alpha)) m / F',
   *
   * with F' [kg/s] the @p slope of the drag. The bed answers a late velocity v of its
   * spheres with the fluid's velocity -(1 - alpha) / alpha v, as their volume must go
   * somewhere: with c = (1 - alpha) / alpha and k = dt F' / (alpha m) an error grows by
   * the roots of z^2 - z (1 - k - k c / 2) + k c / 2 = 0 from one step to the next.
   *
   * Exchange takes the answer of the spheres into the fluid's step (ParticleResponse),
   * and is stable beyond; there the limit says how long a step resolves that answer.
   */
  double stable_step(const double void_fraction, const double mass, const double slope);

  /**
   * The stable_step() [s] for spheres of this @p radius [m] and @p density [kg/m^3] in a
   * bed at rest of this @p void_fraction, through which fluid flows with @p velocity
   * [m/s], the superficial one.
   */
  double stable_step_at_rest(const DragOfType &drag,
                             const double      radius,
                             const double      density,
                             const double      void_fraction,
                             const double      velocity);
} // namespace graupel

#endif
