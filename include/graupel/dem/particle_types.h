#ifndef graupel_dem_particle_types_h
#define graupel_dem_particle_types_h

#include <graupel/dem/size_distribution.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace graupel
{
  /** A number that may be left to a rule: "auto" in the prm file. */
  using OptionalNumber = std::optional<double>;

  /** Size and density of one type of particles. */
  struct ParticleKind
  {
    /** Nominal diameter of the original particles, which the drag laws see [m]. */
    double diameter = 1.6e-3;
    /** Diameter of a simulated particle over that of an original one [-]. */
    double scale = 1.;
    /** Density of the solid [kg/m^3]. */
    double density = 2700.;
    /** How original diameters scatter around the nominal one. */
    SizeDistribution sizes;

    /** Radius of a simulated particle of the nominal diameter [m]. */
    double
    simulated_radius() const
    {
      return 0.5 * scale * diameter;
    }

    /** Radius of the smallest simulated particle [m]. */
    double
    smallest_radius() const
    {
      return 0.5 * scale * sizes.smallest_diameter(diameter);
    }

    /** Radius of the largest simulated particle [m]. */
    double
    largest_radius() const
    {
      return 0.5 * scale * sizes.largest_diameter(diameter);
    }

    /** Mass of a simulated particle of the nominal diameter [kg]. */
    double simulated_mass() const;

    /** Declares its entries in the section that is open. */
    void declare_kind(dealii::ParameterHandler &prm);
    /** @p section is the path of the entries, for errors. */
    void check_kind(const std::string &section, const Cylinder &cylinder) const;
  };

  /**
   * A second, third or fourth type of particles. What is left to "auto" is that of
   * the first type.
   */
  struct FurtherType : ParticleKind
  {
    /** Share in the mass that is filled in [-]; zero: there is no such type. */
    double         mass_fraction = 0.;
    OptionalNumber young_modulus;
    OptionalNumber poisson_ratio;
    /** Of contacts within this type, as Surface. */
    OptionalNumber restitution;
    OptionalNumber friction;
    OptionalNumber rolling_resistance;
    OptionalNumber packing_friction;
    OptionalNumber packing_rolling;
    OptionalNumber adhesion;

    /** Declares its entries in the section that is open. */
    void declare(dealii::ParameterHandler &prm);
    void check(const std::string &section, const Cylinder &cylinder) const;
  };

  /** The spheres: the first type, and up to three more. */
  struct ParticleParameters : ParticleKind
  {
    /** Acceleration of gravity, along -z [m/s^2]. */
    double gravity = 9.81;
    /** Types 2 to 4. */
    std::array<FurtherType, 3> further;

    /** Number of types in use; types are numbered from 0 in the program. */
    unsigned int n_types() const;
    /** Size and density of a type. */
    const ParticleKind &kind(const unsigned int type) const;
    /** Share of a type in the mass that is filled in [-]. */
    double mass_fraction(const unsigned int type) const;

    /** Radius of the smallest simulated particle of any type [m]. */
    double smallest_radius() const;
    /** Radius of the largest simulated particle of any type [m]. */
    double largest_radius() const;

    /** Declares the section "Particles". */
    void declare(dealii::ParameterHandler &prm);
    void check(const Cylinder &cylinder) const;
  };

  /** Declares an entry that is a number or "auto". */
  void add_optional_number(dealii::ParameterHandler &prm,
                           const std::string        &name,
                           OptionalNumber           &number,
                           const std::string        &documentation);
} // namespace graupel

#endif
