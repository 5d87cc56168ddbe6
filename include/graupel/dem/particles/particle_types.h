#ifndef graupel_dem_particles_particle_types_h
#define graupel_dem_particles_particle_types_h

#include <graupel/dem/laws/contact_laws.h>

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

    /** Mean volume of a particle [m^3], mean by number. */
    double mean_volume(const double diameter) const;

    /**
     * A diameter drawn by number [m]; @p random gives numbers even between 0 and 1.
     * From a distribution by mass, a diameter d is drawn by mass and taken with
     * probability (smallest / d)^3.
     */
    template <class Random>
    double
    draw(const double diameter, Random &random) const
    {
      const double least = smallest_diameter(diameter);
      for (;;)
        {
          const double d = kind == "single" ? diameter : quantile(random(), diameter);
          if (measure == "number" || kind == "single")
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
    // Of the list, which check() has found right: by ascending diameter, shares of 1
    // together.
    std::vector<Share> shares() const;
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

    /** Mean mass of a simulated particle [kg]. */
    double
    mean_mass() const
    {
      return density * scale * scale * scale * sizes.mean_volume(diameter);
    }

    /** Declares the entries of a subsection "Type n". */
    void declare(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;
  };

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
    explicit ParticleSource(const std::vector<ParticleType> &types);

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

  private:
    std::vector<ParticleType> types;
    std::vector<double>       number_fraction;
    double                    mass = 0.;
  };
} // namespace graupel

#endif
