#include <graupel/coupling/particle_response.h>

namespace graupel
{
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
  particle_response(const Dem                  &dem,
                    const dealii::Tensor<1, 3> &gravity,
                    const double                density,
                    const double                step)
  {
    const ParticleArrays &particles = dem.particles();
    ParticleResponse      response  = held_response(particles);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const double mass    = particles.mass[row];
        const auto   outside = particles.external_force[row] + mass * gravity;
        const double square  = outside.norm_square();
        const double carried =
          square > 0. ? std::clamp(-(dem.contact_force(row) * outside) / square, 0., 1.)
                      : 0.;
        const double volume    = sphere_volume(particles.body[row].radius);
        response.mobility[row] = (1. - carried) * step / mass;
        response.velocity[row] +=
          response.mobility[row] * (mass - volume * density) * gravity;
      }
    return response;
  }
} // namespace graupel
