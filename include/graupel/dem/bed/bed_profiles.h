// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_bed_bed_profiles_h
#define graupel_dem_bed_bed_profiles_h

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/dem.h>

#include <unordered_map>
#include <vector>

namespace graupel
{
  /** Contacts of the own particles, entry by row. */
  struct ContactCounts
  {
    /** Contacts with other particles. */
    std::vector<unsigned int> particles;
    /** Contacts with walls. */
    std::vector<unsigned int> walls;
  };

  /** Rows by id of the own particles. */
  std::unordered_map<std::int64_t, unsigned int> rows_by_id(
    const ParticleArrays &particles);

  /** @p contacts must hold all contacts of own particles, those with ghosts too. */
  ContactCounts count_contacts(const ParticleArrays            &particles,
                               const std::vector<ContactState> &contacts);

  /** What a bed looks like inside a shell around the axis. */
  struct RadialShell
  {
    /** Distances from the wall [m]. */
    double from, to;
    /** [-] */
    double void_fraction;

    double
    middle() const
    {
      return 0.5 * (from + to);
    }
  };

  /**
   * Void fraction between the heights @p lower and @p upper [m] in shells of equal
   * wall distance, @p width thick [m]; the last one ends at the axis and may be
   * thinner. Spheres are cut exactly; what an overlap pushes beyond the wall is
   * left out. Collective; the same on any number of ranks.
   */
  std::vector<RadialShell> shell_void_fractions(const ParticleArrays &particles,
                                                const Cylinder       &cylinder,
                                                const double          width,
                                                const double          lower,
                                                const double          upper,
                                                MPI_Comm              communicator);

  /** How the weight above a plane is carried. */
  struct LoadLevel
  {
    /** Height of the plane [m]. */
    double height;
    /** Vertical force that the particles with centers above the plane press on
     * those below it, and on the vessel's floor [N]. */
    double load = 0.;
    /** Vertical force by which other walls hold the particles above it [N]. */
    double wall_load = 0.;
    /** Weight of the particles above it less the forces from outside on them [N]. */
    double weight = 0.;
  };

  /**
   * The load at each of the ascending @p planes [m]. Particles count by their
   * centers, so that at rest weight = load + wall load, for any plane and
   * whatever the packing. @p contacts are those whose first particle is own;
   * @p gravity along -z [m/s^2]. Level planes below @p vessel are its floor. Collective;
   * the same on any number of ranks.
   */
  std::vector<LoadLevel> load_profile(const ParticleArrays            &particles,
                                      const Vessel                    &vessel,
                                      const std::vector<ContactState> &contacts,
                                      const std::vector<double>       &planes,
                                      const double                     gravity,
                                      MPI_Comm                         communicator);

  /** Contacts of the particles in a slab. */
  struct CoordinationSlab
  {
    /** Heights [m]. */
    double from, to;
    /** Particles with their center in it. */
    unsigned long n_particles;
    /** Mean contacts with particles [-]; 0 without any. */
    double particles;
    /** Mean contacts with walls [-]; 0 without any. */
    double walls;
  };

  /** Contacts in the slabs between ascending @p planes [m]. Collective. */
  std::vector<CoordinationSlab> coordination_profile(const ParticleArrays      &particles,
                                                     const ContactCounts       &counts,
                                                     const std::vector<double> &planes,
                                                     MPI_Comm communicator);

  /**
   * Entry n is the number of particles with n contacts, walls included if
   * @p with_walls. Collective.
   */
  std::vector<unsigned long> coordination_histogram(const ContactCounts &counts,
                                                    const bool           with_walls,
                                                    MPI_Comm             communicator);

  /** All that is written of a bed at rest. */
  struct BedProfiles
  {
    /** Particle diameter in which the resolution is measured [m]. */
    double diameter;
    /** The cylinder around the vessel. */
    Cylinder cylinder;
    /** Area of the vessel's section, if it is the same at all heights [m^2]. */
    std::optional<double> section;
    /** Four times the section's area over its perimeter, if there is one [m]. */
    std::optional<double> hydraulic_diameter;
    /** Of the bed, from its bottom [m]. */
    double bottom, height;
    /** Slabs of a quarter of a diameter: middle [m] and void fraction [-]. */
    std::vector<std::pair<double, double>> axial;
    /** Shells of a twentieth of a diameter, over the middle half of the bed; none unless
     * the vessel is the whole cylinder. */
    std::vector<RadialShell> radial;
    /** Every half diameter. */
    std::vector<LoadLevel> loads;
    /** Slabs of one diameter. */
    std::vector<CoordinationSlab> coordination;
    /** Number of particles by contacts with particles, and by all contacts. */
    std::vector<unsigned long> histogram, histogram_with_walls;
  };

  /**
   * Of @p bed in @p dem, which must have been synchronised, from its bottom on; the
   * resolution is by @p diameter [m]. Collective.
   */
  BedProfiles bed_profiles(const Dem                 &dem,
                           const BedObservables::Bed &bed,
                           const double               diameter);
} // namespace graupel

#endif
