// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_original_bed_parameters_h
#define graupel_simulation_parameters_original_bed_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>

namespace graupel
{
  /**
   * The void fraction that the original particles would have in this vessel. Scaled
   * ones pack looser, as more of them touch the wall, and drop less pressure.
   */
  struct OriginalBedParameters
  {
    /** "simulated", "correlation", "measured" or the mean void fraction itself. */
    std::string void_fraction = "simulated";
    /** Height of the bed of original particles that is measured [m]. */
    double measured_height = 0.05;
    /** As Settling/target void fraction, for the measured bed [-]. */
    double target_void_fraction = 0.;

    /** Declares the section "Original bed". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;

    /** The mean void fraction [-], if it is given as a number. */
    std::optional<double> number() const;
  };
} // namespace graupel

#endif
