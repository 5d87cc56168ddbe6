#ifndef graupel_simulation_phases_original_bed_h
#define graupel_simulation_phases_original_bed_h

#include <graupel/base/progress.h>
#include <graupel/dem/bed/bed_observables.h>
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
   * bed @p bed [-], as the section "Original bed" says; 1 without a correction. The
   * correlation is Benyahia & O'Neill's, of which only the ratio of its values for both
   * diameters is taken. Collective.
   */
  double original_solid_ratio(const RunParameters       &parameters,
                              const BedObservables::Bed &bed,
                              Progress                  &progress,
                              CostSheet                 &costs,
                              MPI_Comm                   communicator);
} // namespace graupel

#endif
