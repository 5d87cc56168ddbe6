// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/ledger.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    // Not std::max: it drops a NaN on one of its two sides.
    void
    keep_worst(double &worst, const double error)
    {
      if (!(std::abs(error) <= worst))
        worst = std::abs(error);
    }
  } // namespace

  void
  Ledger::record(const double mass_imbalance,
                 const double momentum_imbalance,
                 const double solid_volume_error)
  {
    const std::array<std::pair<const char *, double>, 3> errors{
      {{"mass imbalance", mass_imbalance},
       {"momentum imbalance", momentum_imbalance},
       {"solid volume error", solid_volume_error}}};
    const std::array<double *, 3> worst{
      {&max_mass_imbalance, &max_momentum_imbalance, &max_solid_volume_error}};

    std::string broken;
    for (unsigned int i = 0; i < errors.size(); ++i)
      {
        if (!std::isnan(*worst[i]))
          keep_worst(*worst[i], errors[i].second);
        if (!std::isfinite(errors[i].second))
          broken += std::string(broken.empty() ? "" : ", ") + errors[i].first + " = " +
                    std::to_string(errors[i].second);
      }
    if (!broken.empty())
      throw std::runtime_error("The ledger cannot be kept: " + broken +
                               ". The run has diverged; smaller time steps may help.");
  }
} // namespace graupel
