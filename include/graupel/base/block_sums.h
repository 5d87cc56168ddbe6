// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_block_sums_h
#define graupel_base_block_sums_h

#include <array>
#include <cstdint>
#include <optional>

namespace graupel
{
  /**
   * The standard error of a mean over time, from looks that hang together over some time
   * and come one by one: the mean is the sum of all `value` over the sum of all `weight`.
   * Neighbours are joined to blocks of 2, 4, 8, ..., whose means scatter the less by
   * chance the longer they are. Holds sums only; trivially copyable, for checkpoints.
   *
   * Source: Flyvbjerg & Petersen, Error estimates on averages of correlated data (1989),
   * doi:10.1063/1.457480; a ratio by its residuals, Cochran, Sampling techniques (1977),
   * section 6.4.
   */
  class BlockSums
  {
  public:
    /** The next look, as long as those before: a velocity summed over particles, and
     * their number; a fraction times a duration, and that duration. */
    void add(double value, double weight);

    /**
     * What the error comes to once blocks are independent: the first estimate that no
     * later one exceeds by more than its own uncertainty. Nothing where there is none, as
     * the looks hang together over too much of the time, and for fewer than 16.
     */
    std::optional<double> error_of_mean() const;

  private:
    /** Blocks of one length, in values less `first` times the weight, so that nothing
     * cancels where the scatter is small. */
    struct Level
    {
      std::uint64_t blocks = 0;
      double        values = 0., weights = 0.;
      double        values_squared = 0., product = 0., weights_squared = 0.;
      /** The last block while it has no neighbour. */
      double waiting_value = 0., waiting_weight = 0.;
    };

    /** Blocks of up to 2^19 looks. */
    std::array<Level, 20> levels{};
    /** The first mean of a look that there was. */
    double first     = 0.;
    bool   has_first = false;
  };
} // namespace graupel

#endif
