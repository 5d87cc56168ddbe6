#ifndef graupel_coupling_particle_response_h
#define graupel_coupling_particle_response_h

#include <graupel/dem/dem.h>

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
  };

  /** They go on as they do, whatever the fluid does. */
  ParticleResponse held_response(const ParticleArrays &particles);

  /**
   * Particles that are free answer within @p step [s] with step / mass; those that
   * contacts hold do not. Of the force from outside A (the last one, and the weight)
   * contacts with the force L carry the part lambda = min(1, max(0, -L A / A^2)) now,
   * and will do so:
   *
   *   v + (1 - lambda) step / m (m g - V rho g + F).
   *
   * @p gravity [m/s^2]; buoyancy of a fluid of @p density [kg/m^3].
   */
  ParticleResponse particle_response(const Dem                  &dem,
                                     const dealii::Tensor<1, 3> &gravity,
                                     const double                density,
                                     const double                step);
} // namespace graupel

#endif
