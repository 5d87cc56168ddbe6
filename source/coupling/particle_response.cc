#include <graupel/coupling/particle_response.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    // Mobility of a particle that contacts hold, over that of a free one [-]. Contacts
    // give way a little within a step; with none, light spheres at rest ring.
    constexpr double held_mobility = 0.2;
    // Where the force from outside is below this part of the weight, a particle is about
    // to lift or to come to rest, and contacts say little about what it will do [-].
    constexpr double clear_force = 0.3;
  }
  ParticleResponse
  held_response(const ParticleArrays &particles)
  {
    ParticleResponse response;
    response.mobility.assign(particles.n_owned, 0.);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      response.velocity.push_back(particles.body[row].velocity);
    return response;
  }

  ParticleResponse
  particle_response(
    const ParticleArrays                                              &particles,
    const std::function<dealii::Tensor<1, 3>(const unsigned int row)> &contact_force,
    const dealii::Tensor<1, 3>                                        &gravity,
    const double                                                       density,
    const double                                                       step,
    const double                                                       longest_step)
  {
    ParticleResponse response = held_response(particles);
    response.step             = step;
    const double     of_step  = std::clamp(4. * step / longest_step - 1., 0., 1.);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const double mass     = particles.mass[row];
        const double volume   = sphere_volume(particles.body[row].radius);
        const auto   buoyancy = -volume * density * gravity;
        const auto   weight   = mass * gravity + buoyancy;
        const auto   before   = particles.external_force[row];
        const auto   outside  = before + mass * gravity;
        const double square   = outside.norm_square();
        const double carried =
          square > 0. ? std::clamp(-(contact_force(row) * outside) / square, 0., 1.) : 0.;
        const double clear =
          std::min(1., square / (clear_force * clear_force * weight.norm_square()));
        const double of_fluid  = std::min(1., 10. * density * volume / mass);
        const double held      = held_mobility * std::max(of_step, of_fluid);
        const double mobility  = (1. - (1. - held) * clear * carried) * step / mass;
        response.mobility[row] = mobility;
        response.velocity[row] +=
          (1. - carried) * step / mass * outside + mobility * (buoyancy - before);
      }
    return response;
  }
} // namespace graupel
