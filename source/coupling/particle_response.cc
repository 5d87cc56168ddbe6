#include <graupel/coupling/particle_response.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    // Mobility of a light particle that is held beyond doubt over that of a free one [-].
    constexpr double light_part = 0.2;
    // Where the force from outside is below this part of the weight, a particle is about
    // to lift or to come to rest, and contacts say little about what it will do [-].
    constexpr double clear_force = 0.3;
  }
  ParticleResponse
  held_response(const ParticleArrays &particles)
  {
    ParticleResponse response;
    response.mobility.assign(particles.n_owned, 0.);
    response.yielding.assign(particles.n_owned, 0.);
    response.looseness.assign(particles.n_owned, 0.);
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
    const double                                                       step)
  {
    ParticleResponse response = held_response(particles);
    response.step             = step;
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
        response.looseness[row] = 1. - carried;
        const double loose =
          std::max(0., 1. - square / (clear_force * clear_force * weight.norm_square()));
        const double light   = std::clamp(density * volume / mass - 1., 0., 1.);
        const double unbound = (1. - carried) * step / mass;
        const double giving =
          light * carried * (light_part + (1. - light_part) * loose) * step / mass;
        response.mobility[row] = unbound + giving;
        response.yielding[row] = (1. - light) * carried * loose * step / mass;
        response.velocity[row] += unbound * weight + giving * (buoyancy - before);
      }
    return response;
  }
} // namespace graupel
