// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/parameters/original_bed_parameters.h>

namespace graupel
{
  void
  OriginalBedParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Original bed");
    prm.add_parameter(
      "void fraction",
      void_fraction,
      "Void fraction at which the drag law is evaluated. simulated: that of the "
      "simulated "
      "bed. The others correct for scaled particles packing looser than the original "
      "ones, so that the bed drops the pressure of the original bed of the same mass: "
      "correlation (the simulated bed's own wall layer, as much thinner as the original "
      "particles are smaller; in a cylinder; in the mean within 1 % of the pressure drop "
      "where that is eight simulated diameters wide, 4 % at four), measured "
      "(a short bed of original particles is settled first), or the mean void fraction "
      "of the original bed as a number [-].");
    prm.add_parameter("measured height",
                      measured_height,
                      "Height of the bed of original particles that is measured [m].");
    prm.add_parameter(
      "target void fraction",
      target_void_fraction,
      "Mean void fraction that the measured bed is tapped to if it is looser; 0 to take "
      "it as it comes [-].");
    prm.leave_subsection();
  }

  std::optional<double>
  OriginalBedParameters::number() const
  {
    return number_or_word("Original bed/void fraction",
                          void_fraction,
                          {"simulated", "correlation", "measured"});
  }

  void
  OriginalBedParameters::check() const
  {
    const double value = number().value_or(0.4);
    require(value >= 0.26 && value < 1.,
            "Original bed/void fraction",
            "a bed of equal spheres has a void fraction from 0.26 (the densest order) to "
            "1");
    require(measured_height > 0.,
            "Original bed/measured height",
            "a height is positive, in metres; one and a half vessel diameters suffice");
    require(target_void_fraction == 0. ||
              (target_void_fraction >= 0.36 && target_void_fraction < 1.),
            "Original bed/target void fraction",
            "equal spheres cannot be tapped into less than about 0.36; 0 takes the bed "
            "as it comes");
  }
} // namespace graupel
