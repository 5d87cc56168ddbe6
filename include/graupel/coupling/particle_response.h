// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_particle_response_h
#define graupel_coupling_particle_response_h

#include <graupel/dem/particles/particle_arrays.h>

#include <functional>
#include <limits>

namespace graupel
{
  /**
   * How each own particle answers to the force F of the fluid on it [N], without
   * buoyancy: at the end of the fluid's step it moves with velocity + mobility F.
   */
  struct ParticleResponse
  {
    /** By row [m/s]. */
    std::vector<dealii::Tensor<1, 3>> velocity;
    /** By row, 0 for a particle that is held [s/kg]. */
    std::vector<double> mobility;
    /** By row: 1 for one that nothing holds, 0 for one that contacts hold [-]. */
    std::vector<double> looseness;
    /** The fluid's step [s]; infinite for one that seeks a steady flow. */
    double step = std::numeric_limits<double>::infinity();
    /** The one before it [s]; 0: none that this one goes on from; infinite: a steady
     * flow. */
    double step_before = 0.;
  };

  /** Of an own particle [N]. */
  using ForceOfRow = std::function<dealii::Tensor<1, 3>(const unsigned int row)>;

  /** They go on as they do, whatever the fluid does. */
  ParticleResponse held_response(const ParticleArrays &particles);

  /**
   * What particles do within @p step [s]. Under the last force of the fluid F_0 and the
   * weight in the fluid, A together, contacts with the force L carry the part
   * lambda = min(1, max(0, -L A / A^2)) now, and will carry it of any force:
   *
   *   v + (1 - lambda) step / m (F + m g).
   *
   * A free particle has lambda = 0, which makes this the implicit step. One that rests
   * has lambda = 1 and stays, so that a bed at rest has the same flow with any step.
   * Particles lighter than the fluid bounce, and the fluid's inertia with them: l =
   * min(1, rho V / m - 1) of one, if that is positive, also moves by
   *
   *   lambda l step / m (0.2 + 0.8 max(0, 1 - (A / (0.3 m g'))^2)) (F - F_0),
   *
   * with the weight in the fluid m g'. Nothing of it is left when the force no longer
   * changes. @p gravity [m/s^2]; buoyancy in a fluid of @p density [kg/m^3].
   */
  ParticleResponse particle_response(const ParticleArrays       &particles,
                                     const ForceOfRow           &contact_force,
                                     const dealii::Tensor<1, 3> &gravity,
                                     const double                density,
                                     const double                step);

  /**
   * Contacts push and do not pull: a particle that they hold comes loose where what acts
   * on it, A = F + m g, has turned around. All do where the sum of A turns against what
   * they press on walls with, or against their weight where that is small, and has
   * changed by a tenth of it; what the walls' friction holds adds to their weight then.
   * F is @p force, of the fluid with buoyancy by row [N], after a solution with
   * @p response; @p particles have that of the last step. Such rows of the response
   * become free, and how many did is returned, of all ranks. Collective.
   */
  unsigned int release(ParticleResponse                        &response,
                       const ParticleArrays                    &particles,
                       const ForceOfRow                        &contact_force,
                       const std::vector<dealii::Tensor<1, 3>> &force,
                       const dealii::Tensor<1, 3>              &gravity,
                       const double                             density,
                       MPI_Comm                                 communicator);
} // namespace graupel

#endif
