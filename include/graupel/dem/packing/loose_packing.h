// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_packing_loose_packing_h
#define graupel_dem_packing_loose_packing_h

namespace graupel
{
  /** What is known of packings before there is one to measure. */
  namespace loose_packing
  {
    /** Solid fraction up to which random places are found quickly; none are left beyond
     * 0.38 [-]. */
    constexpr double solid_fraction = 0.28;
    /** Tries to find such a place [-]. */
    constexpr unsigned int most_tries = 3000;
    /** Solid fraction of a random packing that has fallen together [-]. */
    constexpr double usual_solid_fraction = 0.6;
  } // namespace loose_packing
} // namespace graupel

#endif
