// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_particle_list_h
#define graupel_dem_particles_particle_list_h

#include <graupel/dem/particles/particle_arrays.h>

#include <functional>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * Reads particles from a CSV file and gives each to @p take. The first line names the
   * columns, in any order: x, y, z, diameter (of the simulated particle) [m], and if
   * wanted vx, vy, vz [m/s], wx, wy, wz [rad/s], type (1 to @p n_types). Empty lines and
   * what follows a # are left out. Throws InputError, with the number of the line; also
   * for a particle of which @p problem_of tells a problem, where that is given.
   */
  void read_particle_list(
    const std::string                                     &file,
    const unsigned int                                     n_types,
    const std::function<void(const NewParticle &)>        &take,
    const std::function<std::string(const NewParticle &)> &problem_of = {});
} // namespace graupel

#endif
