// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_parcel_h
#define graupel_dem_particles_parcel_h

#include <graupel/dem/particles/particle_arrays.h>

namespace graupel
{
  /** A particle without its id, on its way to another rank or into a checkpoint. */
  struct Parcel
  {
    unsigned char               type = 0;
    double                      mass = 0.;         // [kg]
    std::array<double, 16>      body{};            // as Body
    std::array<std::int64_t, 8> load{};            // as Load
    std::array<double, 3>       external_force{};  // [N]
    std::array<double, 3>       external_torque{}; // [N m]
    double                      solid_fraction = 0.;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &type &mass &body &load &external_force &external_torque;
      archive                                         &solid_fraction;
    }
  };

  /** An own row of @p particles. */
  Parcel pack(const ParticleArrays &particles, const unsigned int row);

  /** The opposite. */
  void unpack(const Parcel &parcel, ParticleArrays &particles, const unsigned int row);

  /** Place and motion in a parcel. */
  Body body_of(const Parcel &parcel);
} // namespace graupel

#endif
