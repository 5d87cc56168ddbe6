// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_studies_study_levels_h
#define graupel_simulation_studies_study_levels_h

#include <graupel/simulation/parameters/run_parameters.h>

namespace graupel
{
  /**
   * The parameters of each level of a study, in the order of its values: those of the
   * run with the value put in, and what follows it (the cell height follows the cell
   * size; number of particles and filter length follow the scale). Those of the run
   * alone if there is no study.
   */
  std::vector<RunParameters> study_levels(const RunParameters &parameters);

  /**
   * Throws InputError("Refinement study/values") if a level of the study cannot run,
   * with the value and the reason: a contradiction between its parameters, or a flow
   * case that ends while it still ramps up, whose pressure drop would not be that of its
   * velocity.
   */
  void check_levels(const RunParameters &parameters);
} // namespace graupel

#endif
