// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_bed_bed_observables_h
#define graupel_dem_bed_bed_observables_h

#include <graupel/dem/bed/solid_below.h>
#include <graupel/dem/vessel/vessel.h>

#include <vector>

namespace graupel
{
  /**
   * What the particles as a bed look like from outside. All sums run over all
   * ranks and are exact: the same on any number of ranks.
   */
  class BedObservables
  {
  public:
    /** Both must outlive this object. The particles may move and change, and the vessel
     * may follow its walls. */
    BedObservables(const ParticleArrays &particles,
                   const Vessel         &vessel,
                   MPI_Comm              communicator);

    /** Volume of solid between two planes [m^3]. Collective. */
    double solid_volume_between(const double lower, const double upper) const;

    /** Height of the center of mass of all particles [m]; not a number without any.
     * Collective. */
    double center_of_mass() const;

    /**
     * Solid fraction [-] of the vessel between neighbouring ones of the ascending
     * @p planes; one value less than planes, 0 where the vessel has no space. Collective.
     */
    std::vector<double> solid_fractions(const std::vector<double> &planes) const;

    struct Bed
    {
      /**
       * Whether the particles make a bed: at least one diameter high, and not denser
       * than spheres can be. If not, nothing else has a meaning.
       */
      bool exists = false;
      /** The vessel's floor; where less than 5 % of the solid is below, as of the top:
       * of a bed under a lid, or a slug in the air [m]. */
      double bottom = 0.;
      /**
       * Where the solid fraction, averaged over a slab of one particle
       * diameter, falls to half of its bulk value for good: a gap that a bubble or slug
       * makes ends the bed only if less than 5 % of the solid is above it, or nothing as
       * dense. The ceiling for a bed that hangs there [m].
       */
      double top = 0.;
      /** From bottom to top [m]; 0 without a bed. */
      double height = 0.;
      /**
       * A height without jumps: over all levels of the vessel, the integral of how far
       * there is bed [m]. There is where the slab around a level has a solid fraction
       * above three quarters of the mean over the solid, none below one quarter, and
       * part of it between; and a gap counts by twice the part of the solid that lies
       * beyond it, above or below, whichever is less. So a slug that rises adds twice its
       * part of the solid times its way, as it does to twice the mean height, and a
       * bubble that passes changes nothing. As the height to 0.1 diameters for a bed at
       * rest.
       */
      double expanded_height = 0.;
      /** Solid fraction over the middle half of the bed [-]. */
      double bulk_solid_fraction = 0.;
      /**
       * 1 - volume of the solid over that of the vessel from bottom to top [-]; 1 without
       * a bed. Solid that is farther than a diameter from the bed does not count.
       */
      double mean_void_fraction = 1.;
    };

    /** Finds the bed. Particles that fall from above do not raise its top. Collective. */
    Bed bed() const;

  private:
    struct Profile;

    double  area_near(const double z) const;
    Profile profile(const SolidBelow &exact) const;
    Bed     standing_bed(const Profile &solid) const;
    bool    hangs(const Profile &solid) const;
    Bed     hanging_bed(const Profile &solid) const;
    bool    measure_middle(const Profile &solid, Bed &bed) const;
    double  expanded_height(const Profile &solid) const;
    // Where, from start on upwards or downwards, the slab's fraction falls below the
    // threshold for good.
    double edge_of_bed(const Profile &solid,
                       const double   start,
                       const double   threshold,
                       const bool     upwards) const;
    double edge_between(const Profile &solid,
                        double         bed,
                        double         beyond,
                        const double   threshold) const;
    double slab_fraction(const Profile &solid, const double middle) const;
    double fraction_at_level(const Profile &solid, const std::size_t k) const;

    const ParticleArrays &particles;
    const Vessel         &vessel;
    MPI_Comm              communicator;
  };
} // namespace graupel

#endif
