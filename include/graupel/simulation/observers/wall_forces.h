// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_wall_forces_h
#define graupel_simulation_observers_wall_forces_h

#include <graupel/simulation/state/simulation_state.h>

namespace graupel
{
  /** Columns of wall-forces.csv: time, then particles_on_NAME_x, _y, _z of each wall of
   * the particles and, in a run with a fluid, fluid_on_NAME_x, _y, _z of each boundary of
   * the mesh [N]. */
  std::string wall_forces_header(const SimulationState &state);

  /** The forces of particles (mean of the last step) and fluid (pressure and viscosity)
   * on the walls. Collective. */
  std::string wall_forces_row(const SimulationState &state);
} // namespace graupel

#endif
