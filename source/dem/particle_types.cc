#include <graupel/base/parameters.h>
#include <graupel/dem/particle_arrays.h>
#include <graupel/dem/particle_types.h>

#include <algorithm>
#include <sstream>

namespace graupel
{
  namespace
  {
    std::string
    text_of(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    // Accepts a number, or the word "auto".
    class NumberOrAuto : public dealii::Patterns::PatternBase
    {
    public:
      bool
      match(const std::string &text) const override
      {
        return text == "auto" || dealii::Patterns::Double().match(text);
      }

      std::string
      description(const OutputStyle) const override
      {
        return "a number or auto";
      }

      std::unique_ptr<PatternBase>
      clone() const override
      {
        return std::make_unique<NumberOrAuto>();
      }
    };

    void
    check_optional(const OptionalNumber &number,
                   const double          least,
                   const double          most,
                   const std::string    &name)
    {
      require(!number || (*number >= least && *number <= most),
              name,
              "it lies between " + text_of(least) + " and " + text_of(most) +
                "; auto takes that of the first type");
    }
  } // namespace

  void
  add_optional_number(dealii::ParameterHandler &prm,
                      const std::string        &name,
                      OptionalNumber           &number,
                      const std::string        &documentation)
  {
    std::ostringstream preset;
    if (number)
      preset.precision(17);
    if (number)
      preset << *number;
    else
      preset << "auto";
    prm.declare_entry(name, preset.str(), NumberOrAuto(), documentation);
    prm.add_action(name, [&number](const std::string &text) {
      number = text == "auto" ? OptionalNumber() : dealii::Utilities::string_to_double(text);
    });
  }

  double
  ParticleKind::simulated_mass() const
  {
    return density * sphere_volume(simulated_radius());
  }

  void
  ParticleKind::declare_kind(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("diameter",
                      diameter,
                      "Diameter of the original particles, those of the real bed [m].");
    prm.add_parameter(
      "scale",
      scale,
      "Diameter of a simulated particle over that of an original one; each "
      "simulated particle stands for scale^3 original ones [-].");
    prm.add_parameter("density", density, "Density of the solid [kg/m^3].");
    sizes.declare(prm);
  }

  void
  ParticleKind::check_kind(const std::string &section, const Cylinder &cylinder) const
  {
    require(diameter > 0.,
            section + "/diameter",
            "a sphere needs a positive diameter, in metres");
    require(scale >= 1.,
            section + "/scale",
            "scaled particles are larger than the original ones: choose 1 or more");
    require(
      density > 0., section + "/density", "a solid needs a positive density, in kg/m^3");
    sizes.check(section, diameter);
    const double largest = 2. * largest_radius();
    require(
      2. * largest < cylinder.diameter && largest < cylinder.height,
      section + (sizes.kind == "single" ? "/diameter" : "/size distribution"),
      "the (largest) simulated diameter " + text_of(largest) +
        " m does not go twice into the cylinder's diameter " + text_of(cylinder.diameter) +
        " m and once into its height " + text_of(cylinder.height) +
        " m: no bed fits. Lengths are in metres; is Particles/scale too large?");
  }

  void
  FurtherType::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("mass fraction",
                      mass_fraction,
                      "Share of this type in the mass that is filled in; the first type "
                      "makes up the rest. 0: there is no such type [-].");
    declare_kind(prm);
    add_optional_number(
      prm, "Young's modulus", young_modulus, "Young's modulus; auto: of type 1 [Pa].");
    add_optional_number(
      prm, "Poisson's ratio", poisson_ratio, "Poisson's ratio; auto: of type 1 [-].");
    add_optional_number(prm,
                        "restitution",
                        restitution,
                        "Coefficient of restitution within this type; auto: as within "
                        "type 1. Different types have the harmonic mean [-].");
    add_optional_number(prm,
                        "friction",
                        friction,
                        "Coefficient of friction within this type; auto: as within type "
                        "1. Different types have the harmonic mean [-].");
    add_optional_number(prm,
                        "rolling resistance",
                        rolling_resistance,
                        "Coefficient of rolling resistance within this type; auto: as "
                        "within type 1. Different types have the harmonic mean [-].");
    add_optional_number(prm,
                        "packing friction",
                        packing_friction,
                        "Coefficient of friction within this type while the bed is "
                        "filled and settles; auto: as within type 1 [-].");
    add_optional_number(prm,
                        "packing rolling resistance",
                        packing_rolling,
                        "Coefficient of rolling resistance within this type while the "
                        "bed is filled and settles; auto: as within type 1 [-].");
    add_optional_number(prm,
                        "adhesion",
                        adhesion,
                        "Work of adhesion within this type; auto: as within type 1. "
                        "Different types have the geometric mean [J/m^2].");
  }

  void
  FurtherType::check(const std::string &section, const Cylinder &cylinder) const
  {
    check_kind(section, cylinder);
    require(!young_modulus || *young_modulus > 0.,
            section + "/Young's modulus",
            "a solid needs a positive modulus, in pascal");
    check_optional(poisson_ratio, 0., 0.5, section + "/Poisson's ratio");
    check_optional(restitution, 0.01, 1., section + "/restitution");
    check_optional(friction, 0., 10., section + "/friction");
    check_optional(rolling_resistance, 0., 1., section + "/rolling resistance");
    check_optional(packing_friction, 0., 10., section + "/packing friction");
    check_optional(packing_rolling, 0., 1., section + "/packing rolling resistance");
    check_optional(adhesion, 0., 1e3, section + "/adhesion");
  }

  unsigned int
  ParticleParameters::n_types() const
  {
    return 1 + std::count_if(further.begin(), further.end(), [](const FurtherType &type) {
             return type.mass_fraction > 0.;
           });
  }

  const ParticleKind &
  ParticleParameters::kind(const unsigned int type) const
  {
    if (type == 0)
      return *this;
    return further[type - 1];
  }

  double
  ParticleParameters::mass_fraction(const unsigned int type) const
  {
    if (type > 0)
      return further[type - 1].mass_fraction;
    double rest = 1.;
    for (const auto &other : further)
      rest -= other.mass_fraction;
    return std::max(0., rest);
  }

  double
  ParticleParameters::smallest_radius() const
  {
    double smallest = ParticleKind::smallest_radius();
    for (unsigned int type = 1; type < n_types(); ++type)
      smallest = std::min(smallest, kind(type).smallest_radius());
    return smallest;
  }

  double
  ParticleParameters::largest_radius() const
  {
    double largest = ParticleKind::largest_radius();
    for (unsigned int type = 1; type < n_types(); ++type)
      largest = std::max(largest, kind(type).largest_radius());
    return largest;
  }

  void
  ParticleParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Particles");
    declare_kind(prm);
    prm.add_parameter(
      "gravity", gravity, "Acceleration of gravity, downwards along the axis [m/s^2].");
    for (unsigned int type = 1; type <= further.size(); ++type)
      {
        prm.enter_subsection("Type " + std::to_string(type + 1));
        further[type - 1].declare(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void
  ParticleParameters::check(const Cylinder &cylinder) const
  {
    check_kind("Particles", cylinder);
    require(gravity >= 0.,
            "Particles/gravity",
            "gravity points downwards already; its size cannot be negative");
    double sum = 0.;
    for (unsigned int type = 1; type <= further.size(); ++type)
      {
        const std::string section  = "Particles/Type " + std::to_string(type + 1);
        const double      fraction = further[type - 1].mass_fraction;
        require(fraction >= 0. && fraction <= 1.,
                section + "/mass fraction",
                "a share lies between 0 and 1");
        require((sum += fraction) <= 1. + 1e-12,
                section + "/mass fraction",
                "the types together have more than the whole mass");
        if (fraction == 0.)
          continue;
        require(type == 1 || further[type - 2].mass_fraction > 0.,
                section + "/mass fraction",
                "types are numbered without gaps: use the type before it first");
        further[type - 1].check(section, cylinder);
      }
  }
} // namespace graupel
