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
   * Neighbours are joined to blocks of 2, 4, 8, ... looks until neighbouring blocks no
   * longer know of each other; then the scatter of their means tells the error. Blocks of
   * half a period of what swings, bubbles say, scatter most, but do know of each other.
   * Holds sums only; trivially copyable, for checkpoints.
   *
   * Source: Flyvbjerg & Petersen, Error estimates on averages of correlated data (1989),
   * doi:10.1063/1.457480; the length of the blocks: Jonsson, Standard error estimation by
   * an automated blocking method (2018), doi:10.1103/PhysRevE.98.043304; a ratio by its
   * residuals: Cochran, Sampling techniques (1977), section 6.4.
   */
  class BlockSums
  {
  public:
    /** The next look, as long as those before: a velocity summed over particles, and
     * their number; a fraction times a duration, and that duration. */
    void add(double value, double weight);

    /**
     * By the shortest blocks that, like all longer ones of which there are eight, are
     * independent by their correlation, at a confidence of 95 %. Nothing where there are
     * none, as the looks hang together over too much of the time, and for fewer than 16
     * looks.
     */
    std::optional<double> error_of_mean() const;

  private:
    /** Blocks of one length, in values less `first` times the weight, so that nothing
     * cancels where the scatter is small. */
    struct Level
    {
      std::uint64_t blocks = 0;
      double        values = 0., weights = 0.;
      /** Sums over the blocks, and over neighbours, of value by value, value by weight,
       * and weight by weight. */
      std::array<double, 3> squares{}, neighbours{};
      /** The last block. */
      double value = 0., weight = 0.;
    };

    /** Blocks of up to 2^19 looks. */
    std::array<Level, 20> levels{};
    /** The first mean of a look that there was. */
    double first = 0.;
  };
} // namespace graupel

#endif
