// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/block_sums.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace graupel
{
  namespace
  {
    // An error from fewer blocks is too uncertain.
    constexpr std::uint64_t fewest_blocks = 8;
    // What chi-squared of 1, 2, ... degrees of freedom is below at 95 % (Abramowitz &
    // Stegun, table 26.8).
    constexpr double chi_squared[] = {
      3.841,  5.991,  7.815,  9.488,  11.070, 12.592, 14.067, 15.507, 16.919, 18.307,
      19.675, 21.026, 22.362, 23.685, 24.996, 26.296, 27.587, 28.869, 30.144, 31.410};

    // Sum of the products of (value - mean weight).
    double
    residual(const std::array<double, 3> &sums, const double mean)
    {
      return sums[0] - 2. * mean * sums[1] + mean * mean * sums[2];
    }
  } // namespace

  void
  BlockSums::add(double value, double weight)
  {
    if (weight > 0. && !(levels[0].weights > 0.))
      first = value / weight;
    value -= first * weight;
    for (Level &level : levels)
      {
        ++level.blocks;
        level.values += value;
        level.weights += weight;
        level.squares[0] += value * value;
        level.squares[1] += value * weight;
        level.squares[2] += weight * weight;
        level.neighbours[0] += value * level.value;
        level.neighbours[1] += 0.5 * (value * level.weight + weight * level.value);
        level.neighbours[2] += weight * level.weight;
        std::swap(value, level.value);
        std::swap(weight, level.weight);
        if (level.blocks % 2 == 1)
          return;
        value += level.value;
        weight += level.weight;
      }
  }

  std::optional<double>
  BlockSums::error_of_mean() const
  {
    std::vector<double> errors, correlations;
    for (const Level &level : levels)
      {
        if (level.blocks < fewest_blocks || !(level.weights > 0.))
          break;
        const double n       = level.blocks;
        const double mean    = level.values / level.weights;
        const double scatter = std::max(0., residual(level.squares, mean));
        errors.push_back(std::sqrt(scatter * n / (n - 1.)) / level.weights);
        // Independent ones correlate by -(n - 1)/n^2 in the mean, as they have the mean
        // in common, with the variance 1/n.
        const double away =
          scatter > 0. ? residual(level.neighbours, mean) / scatter + (n - 1.) / n / n
                       : 0.;
        correlations.push_back(n * away * away);
      }
    std::optional<double> error;
    double                sum = 0.;
    for (std::size_t k = errors.size(); k-- > 0;)
      {
        sum += correlations[k];
        if (sum <= chi_squared[errors.size() - 1 - k])
          error = errors[k];
      }
    return errors.size() > 1 ? error : std::nullopt;
  }
} // namespace graupel
