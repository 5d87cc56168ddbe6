// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_convergence_h
#define graupel_base_convergence_h

#include <optional>
#include <vector>

namespace graupel
{
  /** A quantity computed with a discretisation of the size @p size (any unit). */
  struct Computation
  {
    double size;
    double value;
  };

  /** What three computations tell about the discretisation error of the finest. */
  struct GridConvergence
  {
    /** Observed order; absent where the values do not tell one [-]. */
    std::optional<double> order;
    /** Richardson's extrapolation to the size 0; absent without an order. */
    std::optional<double> extrapolated;
    /** |change from the second to the finest| over the finest [-]. */
    double relative_change = 0.;
    /** Grid-convergence index of the finest, with the factor of safety 1.25 [-]. */
    std::optional<double> index;
    /** Whether the two changes have opposite signs. */
    bool oscillates = false;
  };

  /**
   * Observed order p, Richardson's value and grid-convergence index of three
   * computations of sizes that may have unequal ratios r21, r32 > 1:
   *
   *   |e32 / e21| = r21^p (r32^p - s) / (r21^p - s),  s = sign(e32 / e21),
   *   value = (r21^p f1 - f2) / (r21^p - 1),  index = 1.25 |f1 - f2| / (|f1| (r21^p -
   * 1)).
   *
   * Source: Celik et al. (2008), doi:10.1115/1.2960953. Throws std::invalid_argument
   * unless sizes grow from @p fine to @p coarse.
   */
  GridConvergence grid_convergence(const Computation &fine,
                                   const Computation &medium,
                                   const Computation &coarse);

  /** A value with its error, one standard deviation where it is statistical. */
  struct Estimate
  {
    double value;
    double error;
  };

  /**
   * The value at the size @p to of the polynomial through two or more computations, with
   * their @p standard_errors propagated (by Lagrange's weights) and, added in
   * quadrature, the difference to the polynomial without the first, coarsest one, times
   * the same factor of safety 1.25, as the error of the form. Throws
   * std::invalid_argument for fewer than two, unequal numbers of both, or sizes that
   * repeat.
   */
  Estimate extrapolate(const std::vector<Computation> &computations,
                       const std::vector<double>      &standard_errors,
                       const double                    to);

  /**
   * Mean of computations each of which tells the value at the size @p to by itself, with
   * an error of its form that grows as the distance of its size from there: weights
   * 1 / (size - to)^2. Its error joins in quadrature the @p standard_errors and the
   * scatter about the mean, sqrt(sum w (x - mean)^2 / (n - 1)) with weights that sum to
   * 1. Throws std::invalid_argument for fewer than two, unequal numbers of both, or a
   * size that is @p to.
   */
  Estimate mean_at(const std::vector<Computation> &computations,
                   const std::vector<double>      &standard_errors,
                   const double                    to);

  /** Product of independent estimates; relative errors add in quadrature. */
  Estimate product(const Estimate &one, const Estimate &other);

  /** Order from two errors whose exact value 0 is known [-]; absent for zero errors. */
  std::optional<double> observed_order(const Computation &fine,
                                       const Computation &coarse);
} // namespace graupel

#endif
