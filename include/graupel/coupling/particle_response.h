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
    /** The fluid's step [s]; infinite for one that seeks a steady flow. */
    double step = std::numeric_limits<double>::infinity();
  };

  /** They go on as they do, whatever the fluid does. */
  ParticleResponse held_response(const ParticleArrays &particles);

  /**
   * What particles do within @p step [s]. Under the last force of the fluid F_0 and the
   * weight in the fluid, A together, contacts with the force L carry the part
   * lambda = min(1, max(0, -L A / A^2)) now; another force moves a particle with the
   * mobility k:
   *
   *   v + (1 - lambda) step / m A + k (F - F_0).
   *
   * A free particle has lambda = 0 and k = step / m, which makes this the implicit step.
   * One that rests has lambda = 1, and whatever k is, its velocity is 0 when F no longer
   * changes: k then only delays the force by about dt beta / (m alpha^2) m k / dt steps.
   * It is small where a particle is held beyond doubt, and 0 there if the particle is
   * heavy beside the fluid and the step short beside @p longest_step [s], which the
   * particles' response bears without any (stable_step()): a bed that rests in a gas then
   * has the flow that it would have at any step. @p gravity [m/s^2]; buoyancy in a fluid
   * of
   * @p density [kg/m^3].
   */
  ParticleResponse particle_response(
    const ParticleArrays                                              &particles,
    const std::function<dealii::Tensor<1, 3>(const unsigned int row)> &contact_force,
    const dealii::Tensor<1, 3>                                        &gravity,
    const double                                                       density,
    const double                                                       step,
    const double                                                       longest_step = 0.);
} // namespace graupel

#endif
