// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_particle_types_h
#define graupel_dem_particles_particle_types_h

#include <graupel/dem/laws/contact_laws.h>
#include <graupel/dem/particles/particle_arrays.h>

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace graupel
{
  /** How the diameters of the original particles of one type are distributed. */
  struct SizeDistribution
  {
    /** "single", "list", "uniform", "normal" or "log-normal". */
    std::string kind = "single";
    /** Whether shares are of the "mass" or of the "number" of particles. */
    std::string measure = "mass";
    /** Diameters and shares of a list, "1e-3: 0.4, 2e-3: 0.6" [m: -]. */
    std::string list;
    /** Standard deviation of a normal distribution [m], or of ln d if log-normal [-]. */
    double deviation = 0.;
    /** Ends of the distribution [m]; 0: three deviations (not for uniform). */
    double smallest = 0., largest = 0.;

    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError; @p section is named in it. */
    void check(const double diameter, const std::string &section) const;

    double smallest_diameter(const double diameter) const;
    double largest_diameter(const double diameter) const;

    /**
     * The diameter below which the share @p share, 0 to 1, of the measure lies [m];
     * @p diameter: the mean, or the median if log-normal.
     */
    double quantile(const double share, const double diameter) const;

    /** Whether all particles have the same size. */
    bool
    is_one_size(const double diameter) const
    {
      return smallest_diameter(diameter) == largest_diameter(diameter);
    }

    /** Different sizes that there are; 0: of a continuous distribution. */
    unsigned int n_sizes(const double diameter) const;

    /** Mean volume of a particle [m^3], mean by number. */
    double mean_volume(const double diameter) const;

    /** Sauter mean diameter, six times volume over surface [m]. */
    double sauter_diameter(const double diameter) const;

    /**
     * A diameter drawn by number [m]; @p random gives numbers even between 0 and 1.
     * From a distribution by mass, a diameter d is drawn by mass and taken with
     * probability (smallest / d)^3. One size needs no random numbers, whichever way it
     * is given.
     */
    template <class Random>
    double
    draw(const double diameter, Random &random) const
    {
      const double least = smallest_diameter(diameter);
      if (is_one_size(diameter))
        return least;
      for (;;)
        {
          const double d = quantile(random(), diameter);
          if (measure == "number")
            return d;
          const double ratio = least / d;
          if (random() < ratio * ratio * ratio)
            return d;
        }
    }

  private:
    struct Share
    {
      double diameter;
      double share;
    };
    // "1e-3: 0.4"; nothing for any other text.
    static std::optional<Share> read_share(const std::string &entry);
    // Of the list, by ascending diameter, shares of 1 together; empty if it is no list.
    std::vector<Share> shares() const;
    // Diameters that stand for equal parts of the measure, or the list's.
    std::vector<Share> samples(const double diameter) const;
  };

  /** One kind of particles. */
  struct ParticleType
  {
    /** Share of the mass that is filled in [-]. */
    double mass_fraction = 0.;
    /** Diameter of the original particles: the one, the mean or the median [m]. */
    double diameter = 1.6e-3;
    /** Diameter of a simulated particle over that of an original one [-]. */
    double scale = 1.;
    /** Density of the solid [kg/m^3]. */
    double           density = 2700.;
    Elasticity       elasticity{1e7, 0.33};
    SizeDistribution sizes;

    /** Radius of the largest simulated particle [m]. */
    double
    largest_radius() const
    {
      return 0.5 * scale * sizes.largest_diameter(diameter);
    }

    /** Radius of the smallest simulated particle [m]. */
    double
    smallest_radius() const
    {
      return 0.5 * scale * sizes.smallest_diameter(diameter);
    }

    /** Mean volume of a simulated particle, by number [m^3]. */
    double
    mean_volume() const
    {
      return scale * scale * scale * sizes.mean_volume(diameter);
    }

    /** Mean mass of a simulated particle [kg]. */
    double
    mean_mass() const
    {
      return density * scale * scale * scale * sizes.mean_volume(diameter);
    }

    /** Whether a simulated particle of @p radius [m] is one of this type's, up to the
     * rounding of a text. */
    bool has_size(const double radius) const;

    /** How far a size may lie outside of those of its type, as written with few digits
     * [-]. */
    static constexpr double size_tolerance = 1e-4;

    /** Declares the entries of a subsection "Type n". */
    void declare(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;
  };

  /**
   * What is wrong with the size of a particle that is to be inserted, for a message:
   * its type does not have it. Empty if all is well.
   */
  std::string problem_of_size(const NewParticle               &particle,
                              const std::vector<ParticleType> &types);

  /** Type and size of a particle that is to be inserted. */
  struct DrawnParticle
  {
    /** Index of the type. */
    unsigned char type;
    /** Radius of the simulated particle [m]. */
    double radius;
  };

  /** Draws types by their mass fractions and sizes by their distributions. */
  class ParticleSource
  {
  public:
    /** @p only: number of the one type to draw, from 1; 0 for all. */
    explicit ParticleSource(const std::vector<ParticleType> &types,
                            const unsigned int               only = 0);

    /** @p random gives numbers even between 0 and 1. */
    template <class Random>
    DrawnParticle
    draw(Random &random) const
    {
      double        chance = random();
      unsigned char type   = 0;
      while (type + 1u < types.size() && chance >= number_fraction[type])
        chance -= number_fraction[type++];
      const auto &t = types[type];
      return {type, 0.5 * t.scale * t.sizes.draw(t.diameter, random)};
    }

    /** Mean mass of a drawn particle [kg]. */
    double
    mean_mass() const
    {
      return mass;
    }

    /** Mean volume of a drawn particle [m^3]. */
    double
    mean_volume() const
    {
      return volume;
    }

    /** Different sizes of what is drawn; 0: a continuous distribution is among them. */
    unsigned int n_sizes() const;

    /** Radius of the largest particle that can be drawn [m]. */
    double largest_radius() const;

  private:
    std::vector<ParticleType> types;
    std::vector<double>       number_fraction;
    double                    mass = 0., volume = 0.;
  };
} // namespace graupel

#endif
