// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_bed_wall_layer_h
#define graupel_dem_bed_wall_layer_h

#include <graupel/dem/bed/bed_profiles.h>

#include <optional>

namespace graupel
{
  /**
   * The layer at the wall of a tube in which a bed is looser than farther in. It ends
   * where the solid fraction at a distance from the wall first reaches the mean of all
   * that lies beyond. There that mean is largest, so that nothing that follows depends on
   * where exactly it ends: the layer has no parameter. About 0.3 diameters of the
   * particles, in dense beds and in loose ones.
   */
  struct WallLayer
  {
    /** [m] */
    double thickness = 0.;
    /** Solid fraction in it, and of the core that it encloses [-]. */
    double solid_fraction = 0., core_solid_fraction = 0.;
    /** Radius of the tube [m]. */
    double tube = 0.;

    /**
     * Solid fraction [-] over the section if the particles were @p times smaller: layer
     * and core keep their solid fractions, and the layer is that many times thinner,
     *
     *   phi_c + (phi_w - phi_c) (1 - (1 - t / (times R))^2).
     */
    double mean_solid_fraction(const double times = 1.) const;
  };

  /** @p shells from the wall to the axis, as shell_void_fractions() gives them. Throws
   * std::invalid_argument without any. */
  WallLayer find_wall_layer(const std::vector<RadialShell> &shells);

  /** The bed that smaller particles make, prepared in the same way in the same vessel. */
  struct OriginalPacking
  {
    /** Its solid fraction over that of the bed at hand, away from bottom and top [-]. */
    double solid_ratio = 1.;
    /** With its bottom and top, of which each is looser over some diameters [-]. */
    double mean_void_fraction = 1.;
  };

  /** Diameters of the vessel, in those of the particles, from which on there is a core.
   */
  constexpr double narrowest_tube = 3.;

  /**
   * What @p bed, whose particles have the mean @p diameter [m], tells of the bed of
   * particles that are @p times smaller, by its own wall layer; nothing where there is no
   * bed, where the vessel is not the whole cylinder, or narrower than narrowest_tube. Its
   * ends, two diameters each or a quarter of the height, are left out of the layer; what
   * they lack in the mean is as much thinner as the layer. Collective.
   */
  std::optional<OriginalPacking> packing_of_smaller(const Dem                 &dem,
                                                    const BedObservables::Bed &bed,
                                                    const double               diameter,
                                                    const double               times);
} // namespace graupel

#endif
