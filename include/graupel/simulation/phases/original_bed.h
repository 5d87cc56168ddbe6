// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_phases_original_bed_h
#define graupel_simulation_phases_original_bed_h

#include <graupel/base/progress.h>
#include <graupel/dem/bed/wall_layer.h>
#include <graupel/simulation/parameters/run_parameters.h>

namespace graupel
{
  /**
   * Settles a short bed of the original particles, prepared as the simulated one is,
   * and gives its solid fraction over its middle half [-]. Collective.
   */
  double measure_original_bed(const RunParameters &parameters,
                              Progress            &progress,
                              CostSheet           &costs,
                              MPI_Comm             communicator);

  /**
   * Solid fraction that the original particles would have over that of the simulated
   * bed @p bed [-], as the section "Original bed" says; 1 without a correction. @p
   * packing is what the bed itself tells of them. Throws InputError where that is wanted
   * and it tells nothing. Collective.
   */
  double original_solid_ratio(const RunParameters                  &parameters,
                              const BedObservables::Bed            &bed,
                              const std::optional<OriginalPacking> &packing,
                              Progress                             &progress,
                              CostSheet                            &costs,
                              MPI_Comm                              communicator);
} // namespace graupel

#endif
