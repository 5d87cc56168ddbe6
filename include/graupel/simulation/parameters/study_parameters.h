// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_study_parameters_h
#define graupel_simulation_parameters_study_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace graupel
{
  /** What a refinement study varies. */
  struct StudyParameters
  {
    /** "none", "cell size", "filter length", "time step" or "scale". */
    std::string vary = "none";
    /** Its values, from the coarsest to the finest [m], [s] or [-]. */
    std::vector<double> values;
    /** Beds of different seeds on each level, whose mean counts [-]. */
    unsigned int repetitions = 1;

    bool
    is_wanted() const
    {
      return vary != "none";
    }

    /** Declares the section "Refinement study". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };
} // namespace graupel

#endif
