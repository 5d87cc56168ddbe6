// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_input_files_h
#define graupel_simulation_files_input_files_h

#include <graupel/simulation/parameters/run_parameters.h>

namespace graupel
{
  /**
   * Opens and reads every file that a run of @p parameters will need, and keeps none:
   * mesh, surfaces, particle list, the bed of another run. Throws InputError naming the
   * parameter of one that cannot be used. Before, check_size(). Collective.
   */
  void check_input_files(const RunParameters &parameters);
} // namespace graupel

#endif
