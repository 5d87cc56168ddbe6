// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_state_bed_result_h
#define graupel_simulation_state_bed_result_h

#include <optional>

namespace graupel
{
  /** The bed before the flow; lengths of the bed have no value where there is none. */
  struct BedResult
  {
    unsigned int          particle_count    = 0;
    double                particle_diameter = 0.;        // simulated, Sauter mean [m]
    double                original_diameter = 0.;        // Sauter mean [m]
    double                scale             = 1.;        // [-]
    double                solid_volume      = 0.;        // [m^3]
    std::optional<double> bottom;                        // [m]
    std::optional<double> height;                        // [m]
    std::optional<double> mean_void_fraction;            // [-]
    double                mean_coordination_number = 0.; // [-]
    double                vessel_diameter          = 0.; // [m]
    double                vessel_height            = 0.; // [m]
    /** That the original particles would have in this vessel, by the bed's wall layer;
     * none where there is no layer to go by [-]. */
    std::optional<double> original_void_fraction;
    /** Solid fraction at which the drag law is evaluated over that of the bed [-]. */
    double original_solid_ratio = 1.;
  };
} // namespace graupel

#endif
