// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/particle_response.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    // Mobility of a light particle that is held beyond doubt over that of a free one [-].
    constexpr double light_part = 0.2;
    // Where the force from outside is below this part of the weight, a light particle is
    // about to lift or to come to rest, and contacts say little about what it will do
    // [-].
    constexpr double clear_force = 0.3;
    // A change of the force on all particles that may lift them, over their weight [-].
    constexpr double clear_change = 0.1;

    dealii::Tensor<1, 3>
    weight_in_fluid(const ParticleArrays       &particles,
                    const unsigned int          row,
                    const dealii::Tensor<1, 3> &gravity,
                    const double                density)
    {
      return (particles.mass[row] - density * sphere_volume(particles.body[row].radius)) *
             gravity;
    }

    void
    set_free(ParticleResponse           &response,
             const ParticleArrays       &particles,
             const unsigned int          row,
             const dealii::Tensor<1, 3> &gravity,
             const double                density)
    {
      response.looseness[row] = 1.;
      response.mobility[row]  = response.step / particles.mass[row];
      response.velocity[row] =
        particles.body[row].velocity +
        response.mobility[row] * weight_in_fluid(particles, row, gravity, density);
    }

    // Sums over all particles, of all ranks [N].
    struct Bed
    {
      /** In the fluid. */
      dealii::Tensor<1, 3> weight;
      /** F + m g, and how much it has changed. */
      dealii::Tensor<1, 3> outside, change;
      /** Of the walls on them: between particles contacts cancel. */
      dealii::Tensor<1, 3> walls;
    };

    Bed
    whole_bed(const ParticleArrays                    &particles,
              const ForceOfRow                        &contact_force,
              const std::vector<dealii::Tensor<1, 3>> &force,
              const dealii::Tensor<1, 3>              &gravity,
              const double                             density,
              MPI_Comm                                 communicator)
    {
      Bed bed;
      for (unsigned int row = 0; row < particles.n_owned; ++row)
        {
          bed.weight += weight_in_fluid(particles, row, gravity, density);
          bed.outside += force[row] + particles.mass[row] * gravity;
          bed.change += force[row] - particles.external_force[row];
          bed.walls += contact_force(row);
        }
      for (auto *sum : {&bed.weight, &bed.outside, &bed.change, &bed.walls})
        *sum = dealii::Utilities::MPI::sum(*sum, communicator);
      return bed;
    }

    // Whether it leaves the walls that carry it.
    bool
    lifts_off(const Bed &bed)
    {
      const double weight = bed.weight.norm();
      const auto load = bed.walls.norm() > clear_force * weight ? -bed.walls : bed.weight;
      return bed.outside * load < 0. &&
             bed.change * load < -clear_change * weight * load.norm();
    }
  } // namespace

  ParticleResponse
  held_response(const ParticleArrays &particles)
  {
    ParticleResponse response;
    response.mobility.assign(particles.n_owned, 0.);
    response.looseness.assign(particles.n_owned, 0.);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      response.velocity.push_back(particles.body[row].velocity);
    return response;
  }

  ParticleResponse
  particle_response(const ParticleArrays       &particles,
                    const ForceOfRow           &contact_force,
                    const dealii::Tensor<1, 3> &gravity,
                    const double                density,
                    const double                step)
  {
    ParticleResponse response = held_response(particles);
    response.step             = step;
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const double mass     = particles.mass[row];
        const double volume   = sphere_volume(particles.body[row].radius);
        const auto   weight   = weight_in_fluid(particles, row, gravity, density);
        const auto   buoyancy = weight - mass * gravity;
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
        response.velocity[row] += unbound * weight + giving * (buoyancy - before);
      }
    return response;
  }

  unsigned int
  release(ParticleResponse                        &response,
          const ParticleArrays                    &particles,
          const ForceOfRow                        &contact_force,
          const std::vector<dealii::Tensor<1, 3>> &force,
          const dealii::Tensor<1, 3>              &gravity,
          const double                             density,
          MPI_Comm                                 communicator)
  {
    const Bed bed =
      whole_bed(particles, contact_force, force, gravity, density, communicator);
    const bool all = lifts_off(bed);
    // Walls do not hold it any more, but friction may.
    const double friction =
      all && bed.walls * bed.outside < 0. ? bed.walls.norm() / bed.weight.norm() : 0.;
    unsigned int released = 0;
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const auto own = particles.mass[row] * gravity;
        const bool turned =
          (force[row] + own) * (particles.external_force[row] + own) < 0.;
        if (response.looseness[row] < 1. && (all || turned))
          {
            ++released;
            set_free(response, particles, row, (1. + friction) * gravity, density);
          }
      }
    return dealii::Utilities::MPI::sum(released, communicator);
  }
} // namespace graupel
