// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_moments_h
#define graupel_base_moments_h

#include <cmath>

namespace graupel
{
  /**
   * Mean and scatter of numbers that come one by one, each with a weight: of a quantity
   * over time, weighted by the length of the steps. Nothing cancels where the scatter is
   * small beside the mean. Trivially copyable, for checkpoints.
   *
   * Source: West, Updating mean and variance estimates (1979), doi:10.1145/359146.359153.
   */
  struct Moments
  {
    double weight = 0.;
    double mean   = 0.;
    /** Sum of weight times squared distance from the mean. */
    double squares = 0.;

    /** @p more must be positive. */
    void
    add(const double value, const double more)
    {
      weight += more;
      const double away = value - mean;
      mean += more / weight * away;
      squares += more * away * (value - mean);
    }

    /** Root of the mean squared distance from the mean; 0 without weight. */
    double
    rms() const
    {
      return weight > 0. ? std::sqrt(squares / weight) : 0.;
    }
  };
} // namespace graupel

#endif
