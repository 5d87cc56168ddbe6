#ifndef graupel_simulation_packing_h
#define graupel_simulation_packing_h

#include <graupel/base/progress.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>

#include <string>

namespace graupel
{
  /**
   * Fills the vessel of @p dem, its mesh divided among the ranks anew as the bed grows.
   * @p bed precedes the name of the phase. Simulated time that it took [s]. Collective.
   */
  double fill_vessel(const FillingParameters &parameters,
                     Dem                     &dem,
                     Progress                &progress,
                     const std::string       &bed = "");

  /** Lets the bed settle, or taps it, as fill_vessel() fills. Collective. */
  double settle_bed(const SettlingParameters &parameters,
                    Dem                      &dem,
                    Progress                 &progress,
                    const std::string        &bed = "");
} // namespace graupel

#endif
