// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/phases/original_bed.h>
#include <graupel/simulation/phases/packing_phases.h>

#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    const char *const bed_name = "original bed: ";
    const char *const no_wall_layer =
      "the correlation follows the layer at the wall of the settled bed, but there is no "
      "bed, or other walls are in it now; choose measured, or the void fraction itself";

    void
    run_whole(Phase &phase)
    {
      phase.begin();
      while (phase.step())
        ;
      phase.end();
    }
  } // namespace

  double
  measure_original_bed(const RunParameters &parameters,
                       Progress            &progress,
                       CostSheet           &costs,
                       MPI_Comm             communicator)
  {
    SimulationState state(
      parameters.of_original_bed(), costs, progress, communicator, bed_name);
    FillingPhase filling(state.parameters.filling, state);
    run_whole(filling);
    SettlingPhase settling(state.parameters.settling, state);
    run_whole(settling);

    const auto         bed = state.bed();
    std::ostringstream text;
    text << std::setprecision(4) << bed_name << state.dem.n_global()
         << " particles, height " << bed.height * 1e3 << " mm, mean void fraction "
         << bed.mean_void_fraction << ", in the middle half "
         << 1. - bed.bulk_solid_fraction;
    progress.say(text.str());
    return bed.bulk_solid_fraction;
  }

  double
  original_solid_ratio(const RunParameters                  &parameters,
                       const BedObservables::Bed            &bed,
                       const std::optional<OriginalPacking> &packing,
                       Progress                             &progress,
                       CostSheet                            &costs,
                       MPI_Comm                              communicator)
  {
    const auto &choice = parameters.original_bed;
    if (choice.void_fraction == "simulated" || !bed.exists)
      return 1.;
    double ratio;
    if (const auto given = choice.number())
      ratio = (1. - *given) / (1. - bed.mean_void_fraction);
    else if (choice.void_fraction == "correlation")
      {
        require(packing.has_value(), "Original bed/void fraction", no_wall_layer);
        ratio = packing->solid_ratio;
      }
    else
      ratio = measure_original_bed(parameters, progress, costs, communicator) /
              bed.bulk_solid_fraction;
    std::ostringstream text;
    text << std::setprecision(4) << "drag law at the original bed's solid fraction, "
         << ratio << " of the simulated one's";
    progress.say(text.str());
    return ratio;
  }
} // namespace graupel
