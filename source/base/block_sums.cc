// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/block_sums.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace graupel
{
  namespace
  {
    // An error from fewer blocks is too uncertain.
    constexpr std::uint64_t fewest_blocks = 8;
  } // namespace

  void
  BlockSums::add(double value, double weight)
  {
    if (!has_first && weight > 0.)
      {
        first     = value / weight;
        has_first = true;
      }
    value -= first * weight;
    for (Level &level : levels)
      {
        ++level.blocks;
        level.values += value;
        level.weights += weight;
        level.values_squared += value * value;
        level.product += value * weight;
        level.weights_squared += weight * weight;
        if (level.blocks % 2 == 1)
          {
            level.waiting_value  = value;
            level.waiting_weight = weight;
            return;
          }
        value += level.waiting_value;
        weight += level.waiting_weight;
      }
  }

  std::optional<double>
  BlockSums::error_of_mean() const
  {
    std::vector<double> errors, lowest; // less their own uncertainty
    for (const Level &level : levels)
      {
        if (level.blocks < fewest_blocks || !(level.weights > 0.))
          break;
        const double n    = level.blocks;
        const double mean = level.values / level.weights;
        // Sum over the blocks of (value - mean weight)^2.
        const double residual = level.values_squared - 2. * mean * level.product +
                                mean * mean * level.weights_squared;
        errors.push_back(std::sqrt(std::max(0., residual) * n / (n - 1.)) /
                         level.weights);
        lowest.push_back(errors.back() * (1. - 1. / std::sqrt(2. * (n - 1.))));
      }
    for (std::size_t k = 0; k + 1 < errors.size(); ++k)
      if (*std::max_element(lowest.begin() + k + 1, lowest.end()) <= errors[k])
        return errors[k];
    return {};
  }
} // namespace graupel
