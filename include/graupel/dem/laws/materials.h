// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_laws_materials_h
#define graupel_dem_laws_materials_h

#include <graupel/dem/laws/contact_laws.h>

#include <vector>

namespace graupel
{
  /** What the contacts need to know of all types of particles. */
  struct Materials
  {
    /** Density of each type [kg/m^3]. */
    std::vector<double> density;
    /** Of two types: entry first type * number of types + second type. */
    std::vector<PairMaterial> particles;
    /** Of a type and a wall: entry wall * number of types + type. */
    std::vector<PairMaterial> walls;

    unsigned int
    n_types() const
    {
      return density.size();
    }

    const PairMaterial &
    between(const unsigned int first, const unsigned int second) const
    {
      return particles[first * n_types() + second];
    }

    const PairMaterial &
    with_wall(const unsigned int wall, const unsigned int type) const
    {
      return walls[wall * n_types() + type];
    }
  };
} // namespace graupel

#endif
