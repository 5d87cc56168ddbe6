// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_same_rows_h
#define graupel_dem_particles_same_rows_h

#include <cstdint>
#include <numeric>
#include <vector>

namespace graupel
{
  /** The rows 0 to @p n - 1: all of them, or each with the number that it has. */
  inline std::vector<std::uint32_t>
  same_rows(const unsigned int n)
  {
    std::vector<std::uint32_t> rows(n);
    std::iota(rows.begin(), rows.end(), 0u);
    return rows;
  }
} // namespace graupel

#endif
