// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_numbers_period_h
#define graupel_dem_numbers_period_h

#include <cmath>

namespace graupel
{
  /**
   * The heights of particles in a vessel with periodic ends: they and the period are
   * whole numbers of a quantum, so that a period is added and taken away without
   * rounding. So the motion does not depend on when a particle is brought back from the
   * one end to the other.
   */
  class Period
  {
  public:
    /** No periodic ends: heights are left as they are. */
    Period() = default;

    /** @p height of the vessel [m], which the period is up to half a quantum; that is
     * 2^-48 of it or less. */
    explicit Period(const double height)
      // Of numbers around this one the quantum is the distance from one to the next, for
      // heights up to four times that of the vessel.
      : rounder(1.5 * std::ldexp(1., std::ilogb(4. * height) + 2))
      , period(rounded(height))
    {
    }

    bool
    exists() const
    {
      return period > 0.;
    }

    /** [m]; 0 without. */
    double
    length() const
    {
      return period;
    }

    /** The next whole number of quanta [m]. */
    template <class Number>
    Number
    rounded(const Number &z) const
    {
      return (z + rounder) - rounder;
    }

    /** @p z brought into the vessel, if it is less than a period outside [m]. */
    double
    within(const double z) const
    {
      return z < 0. ? z + period : exists() && z >= period ? z - period : z;
    }

  private:
    double rounder = 0.;
    double period  = 0.;
  };
} // namespace graupel

#endif
