// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/parameters/study_parameters.h>

#include <algorithm>
#include <functional>

namespace graupel
{
  void
  StudyParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Refinement study");
    prm.add_parameter(
      "vary",
      vary,
      "What a study varies: the run is repeated for each of the values below, in "
      "directories of their own, and study.csv and the report tell how the results "
      "converge. With the cell size the cell height is varied in proportion. With the "
      "scale the number of particles and the filter length follow, and the results are "
      "extrapolated to scale 1, with an error.",
      dealii::Patterns::Selection("none|cell size|filter length|time step|scale"));
    prm.add_parameter(
      "values",
      values,
      "The values, from the coarsest to the finest; three or more tell an "
      "order [m, s or -].");
    prm.add_parameter(
      "repetitions",
      repetitions,
      "Beds of different seeds (Filling/seed, and those after it) on each level; their "
      "mean counts, and its standard error goes into the extrapolation in scale [-].");
    prm.leave_subsection();
  }

  void
  StudyParameters::check() const
  {
    if (!is_wanted())
      return;
    require(values.size() >= 2,
            "Refinement study/values",
            "a study needs two values at least, and three to tell an order");
    require(repetitions >= 1, "Refinement study/repetitions", "must be at least 1");
    for (const double value : values)
      require(vary != "scale" || value >= 1.,
              "Refinement study/values",
              "a scale is at least 1, the original particle");
    for (const double value : values)
      require(value > 0., "Refinement study/values", "every value must be positive");
    require(std::is_sorted(values.begin(), values.end(), std::greater<double>()) &&
              std::adjacent_find(values.begin(), values.end()) == values.end(),
            "Refinement study/values",
            "the values must fall, from the coarsest to the finest");
  }
} // namespace graupel
