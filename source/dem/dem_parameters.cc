#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/dem_parameters.h>
#include <graupel/dem/particles/particle_arrays.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <limits>
#include <set>
#include <sstream>

namespace graupel
{
  using dealii::Patterns::Selection;

  namespace
  {
    void
    check_friction(const double friction, const double rolling, const std::string &which)
    {
      require(friction >= 0. && friction <= 10.,
              "Contact/" + which + " friction",
              "a coefficient of friction lies between 0 and about 1");
      require(rolling >= 0. && rolling <= 1.,
              "Contact/" + which + " rolling resistance",
              "a coefficient of rolling resistance lies between 0 and 1; 0.1 is usual");
    }

    void
    check_surface(const Surface &surface, const std::string &which)
    {
      require(surface.restitution >= 0.01 && surface.restitution <= 1.,
              "Contact/" + which + " restitution",
              "a collision returns between 0.01 and 1 of the approach speed");
      check_friction(surface.friction, surface.rolling_resistance, which);
      require(surface.adhesion >= 0. && surface.adhesion <= 100.,
              "Contact/" + which + " adhesion",
              "a work of adhesion is not negative, and far below 100 J/m^2");
    }

    void
    check_elasticity(const Elasticity &elasticity, const std::string &which)
    {
      require(elasticity.young_modulus > 0.,
              "Contact/" + which + " Young's modulus",
              "a solid needs a positive modulus, in pascal");
      require(elasticity.poisson_ratio >= 0. && elasticity.poisson_ratio <= 0.5,
              "Contact/" + which + " Poisson's ratio",
              "an isotropic solid has a ratio between 0 and 0.5");
    }

    std::string
    number(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace

  double
  ParticleParameters::simulated_mass() const
  {
    return density * sphere_volume(simulated_radius());
  }

  void
  ParticleParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Particles");
    prm.add_parameter("diameter",
                      diameter,
                      "Diameter of the original particles, those of the real bed [m].");
    prm.add_parameter(
      "scale",
      scale,
      "Diameter of a simulated particle over that of an original one; each "
      "simulated particle stands for scale^3 original ones [-].");
    prm.add_parameter("density", density, "Density of the solid [kg/m^3].");
    std::ostringstream size;
    size << gravity;
    prm.declare_entry("gravity",
                      size.str(),
                      dealii::Patterns::List(dealii::Patterns::Double(), 1, 3),
                      "Acceleration of gravity: one number for its size, downwards along "
                      "the axis, or the three components of a vector [m/s^2].");
    prm.add_action("gravity", [this](const std::string &text) { set_gravity(text); });
    sizes.declare(prm);
    for (unsigned int t = 0; t < further_types.size(); ++t)
      {
        prm.enter_subsection("Type " + std::to_string(t + 2));
        further_types[t].declare(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void
  ParticleParameters::set_gravity(const std::string &text)
  {
    const auto numbers =
      dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(text));
    gravity           = numbers[0];
    gravity_direction = dealii::Tensor<1, 3>({0., 0., -1.});
    if (numbers.size() == 1)
      return;
    // Two numbers are refused by check(), as no size is.
    dealii::Tensor<1, 3> vector;
    for (unsigned int d = 0; d < 3; ++d)
      vector[d] = numbers.size() == 3 ? numbers[d] : std::nan("");
    gravity = vector.norm();
    if (gravity != 0.)
      gravity_direction = vector / gravity;
  }

  void
  ParticleParameters::check() const
  {
    require(diameter > 0.,
            "Particles/diameter",
            "a sphere needs a positive diameter, in metres");
    require(scale >= 1.,
            "Particles/scale",
            "scaled particles are larger than the original ones: choose 1 or more");
    require(
      density > 0., "Particles/density", "a solid needs a positive density, in kg/m^3");
    require(
      gravity >= 0.,
      "Particles/gravity",
      "gravity is one number that is not negative, its size, as it points downwards "
      "already; or a vector of three numbers, as in \"0, 0, -9.81\"");
    sizes.check(diameter, "Particles");
    double others = 0.;
    for (unsigned int t = 0; t < further_types.size(); ++t)
      {
        further_types[t].check("Particles/Type " + std::to_string(t + 2));
        others += further_types[t].mass_fraction;
      }
    require(others < 1.,
            "Particles/Type 2/mass fraction",
            "nothing is left for the first type: the others must stay below 1 together");
  }

  void
  ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    declare_laws(prm);
    declare_surfaces(prm);
    declare_steps(prm);
    prm.leave_subsection();
  }

  void
  ContactParameters::declare_laws(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "model",
      model,
      "Law of the normal and tangential force: hertz-mindlin (elastic spheres), "
      "linear-spring, or jkr (elastic spheres with adhesion).",
      Selection("hertz-mindlin|linear-spring|jkr"));
    prm.add_parameter(
      "rolling model",
      rolling_model,
      "Law of the resistance to rolling: spring-dashpot (an elastic-plastic "
      "rolling spring, no viscous part), constant-torque, or none.",
      Selection("spring-dashpot|constant-torque|none"));
    prm.add_parameter(
      "particle Young's modulus",
      particle_elasticity.young_modulus,
      "Young's modulus of the particles, usually reduced far below that of the "
      "real solid so that substeps are longer [Pa].");
    prm.add_parameter("particle Poisson's ratio",
                      particle_elasticity.poisson_ratio,
                      "Poisson's ratio of the particles [-].");
    prm.add_parameter("wall Young's modulus",
                      wall_elasticity.young_modulus,
                      "Young's modulus of the walls [Pa].");
    prm.add_parameter("wall Poisson's ratio",
                      wall_elasticity.poisson_ratio,
                      "Poisson's ratio of the walls [-].");
    prm.add_parameter("normal stiffness",
                      normal_stiffness,
                      "Normal stiffness of the linear-spring model between original "
                      "particles; simulated ones have it times their scale [N/m].");
    prm.add_parameter("stiffness ratio",
                      stiffness_ratio,
                      "Tangential over normal stiffness of the linear-spring model [-].");
  }

  void
  ContactParameters::declare_surfaces(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("particle restitution",
                      particle_surface.restitution,
                      "Coefficient of restitution between particles [-].");
    prm.add_parameter("particle friction",
                      particle_surface.friction,
                      "Coefficient of friction between particles while fluid flows [-].");
    prm.add_parameter(
      "particle rolling resistance",
      particle_surface.rolling_resistance,
      "Coefficient of rolling resistance between particles while fluid flows [-].");
    prm.add_parameter("wall restitution",
                      wall_surface.restitution,
                      "Coefficient of restitution between particle and wall [-].");
    prm.add_parameter(
      "wall friction",
      wall_surface.friction,
      "Coefficient of friction between particle and wall while fluid flows [-].");
    prm.add_parameter(
      "wall rolling resistance",
      wall_surface.rolling_resistance,
      "Coefficient of rolling resistance between particle and wall while fluid "
      "flows [-].");
    prm.add_parameter("particle adhesion",
                      particle_surface.adhesion,
                      "Work of adhesion between particles, of the jkr model [J/m^2].");
    prm.add_parameter(
      "wall adhesion",
      wall_surface.adhesion,
      "Work of adhesion between particle and wall, of the jkr model [J/m^2].");
    prm.add_parameter(
      "pairs",
      pairs,
      "Pairs that differ from the above, separated by commas: two types, or a type and a "
      "wall (wall, bottom, top, plane 1, a name of Walls/planes or surfaces), then a "
      "quantity (restitution, friction, "
      "rolling resistance, adhesion) and its value, as in \"1-2 friction 0.3, 2-bottom "
      "restitution 0.9\"; they hold while packing too [-, J/m^2].");
    prm.add_parameter(
      "packing particle friction",
      packing_particle_friction,
      "Coefficient of friction between particles while the bed is filled and "
      "settles; it decides how dense the bed becomes [-].");
    prm.add_parameter(
      "packing particle rolling resistance",
      packing_particle_rolling,
      "Coefficient of rolling resistance between particles while the bed is "
      "filled and settles [-].");
    prm.add_parameter(
      "packing wall friction",
      packing_wall_friction,
      "Coefficient of friction between particle and wall while the bed is filled "
      "and settles [-].");
    prm.add_parameter(
      "packing wall rolling resistance",
      packing_wall_rolling,
      "Coefficient of rolling resistance between particle and wall while the bed "
      "is filled and settles [-].");
  }

  void
  ContactParameters::declare_steps(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "time fraction",
      time_fraction,
      "Substep as a fraction of the Rayleigh time, or of sqrt(m/k)/4 for the "
      "linear-spring model, whose impacts last 9 of these [-].");
    prm.add_parameter(
      "substep",
      substep,
      "Substep of the particles; zero takes it from the time fraction [s].");
    prm.add_parameter(
      "skin",
      skin,
      "Distance beyond touching up to which neighbours are listed, in particle "
      "diameters; a wider skin needs fewer, longer lists [-].");
  }

  void
  ContactParameters::check() const
  {
    check_elasticity(particle_elasticity, "particle");
    check_elasticity(wall_elasticity, "wall");
    check_surface(particle_surface, "particle");
    check_surface(wall_surface, "wall");
    check_friction(
      packing_particle_friction, packing_particle_rolling, "packing particle");
    check_friction(packing_wall_friction, packing_wall_rolling, "packing wall");
    require(normal_stiffness > 0.,
            "Contact/normal stiffness",
            "a spring needs a positive stiffness, in N/m");
    require(
      stiffness_ratio > 0. && stiffness_ratio <= 1.,
      "Contact/stiffness ratio",
      "the tangential spring is the softer one: choose between 0 and 1, 2/7 is usual");
    require(time_fraction > 0. && time_fraction <= DemParameters::largest_time_fraction,
            "Contact/time fraction",
            "contacts are integrated stably and accurately up to a fraction of " +
              number(DemParameters::largest_time_fraction) + "; 0.2 is usual");
    require(
      substep >= 0., "Contact/substep", "a step forward in time is positive, in seconds");
    require(skin > 0. && skin <= 2.,
            "Contact/skin",
            "without a skin the neighbour list is old at once, with a wide one it holds "
            "the whole "
            "bed; choose 0.2 to 0.3");
  }

  void
  DemParameters::declare(dealii::ParameterHandler &prm)
  {
    particles.declare(prm);
    contact.declare(prm);
    walls.declare(prm);
  }

  void
  DemParameters::check(const Cylinder &cylinder) const
  {
    particles.check();
    check_sizes(cylinder);
    contact.check();
    walls.check();
    check_pairs();
    require(!walls.is_periodic() || cylinder.height > 6. * largest_radius(),
            "Walls/top",
            "a periodic vessel must be higher than three particles, or one would touch "
            "its own image");
    const double longest = largest_time_fraction * characteristic_time();
    require(contact.substep <= longest,
            "Contact/substep",
            "the contacts are unstable or inaccurate above " + number(longest) + " s, " +
              number(largest_time_fraction) + " of the characteristic time " +
              number(characteristic_time()) +
              " s; choose a shorter substep (zero for the default) or a softer material");
  }

  void
  DemParameters::check_sizes(const Cylinder &cylinder) const
  {
    const double mean = mean_simulated_diameter();
    require(2. * mean < cylinder.diameter && mean < cylinder.height,
            "Particles/diameter",
            "the simulated diameter " + number(mean) +
              " m does not go twice into the cylinder's diameter " +
              number(cylinder.diameter) + " m and once into its height " +
              number(cylinder.height) +
              " m: no bed fits. Lengths are in metres; is Particles/scale too large?");

    std::vector<std::string> sections{"Particles"};
    for (unsigned int t = 0; t < particles.further_types.size(); ++t)
      if (particles.further_types[t].mass_fraction > 0.)
        sections.push_back("Particles/Type " + std::to_string(t + 2));
    const auto all = types();
    for (std::size_t t = 0; t < all.size(); ++t)
      {
        const std::string &kind    = all[t].sizes.kind;
        const double       largest = 2. * all[t].largest_radius();
        require(largest < 0.95 * cylinder.diameter && largest < 0.95 * cylinder.height,
                sections[t] + (kind == "single" ? "/diameter"
                               : kind == "list" ? "/size list"
                                                : "/largest diameter"),
                "its largest simulated particle, of " + number(largest) +
                  " m, does not fit into the cylinder, " + number(cylinder.diameter) +
                  " m wide and " + number(cylinder.height) +
                  " m high, with some room around it; lengths are in metres");
      }
  }

  std::vector<ParticleType>
  DemParameters::types() const
  {
    ParticleType first;
    first.mass_fraction = 1.;
    first.diameter      = particles.diameter;
    first.scale         = particles.scale;
    first.density       = particles.density;
    first.elasticity    = contact.particle_elasticity;
    first.sizes         = particles.sizes;
    std::vector<ParticleType> all{first};
    for (const auto &type : particles.further_types)
      if (type.mass_fraction > 0.)
        {
          all.front().mass_fraction -= type.mass_fraction;
          all.push_back(type);
        }
    return all;
  }

  double
  DemParameters::largest_radius() const
  {
    double largest = 0.;
    for (const auto &type : types())
      largest = std::max(largest, type.largest_radius());
    return largest;
  }

  namespace
  {
    // Six times volume over surface of all; @p diameter_of a type its own such mean. In
    // ratios to the first, so that equal diameters give just that one.
    template <class DiameterOf>
    double
    sauter_mean(const std::vector<ParticleType> &types, const DiameterOf &diameter_of)
    {
      const double first  = diameter_of(types.front());
      double       volume = 0., surface = 0.;
      for (const auto &type : types)
        {
          const double part = type.mass_fraction / type.density;
          volume += part;
          surface += part / (diameter_of(type) / first);
        }
      return first * (volume / surface);
    }
  } // namespace

  double
  DemParameters::mean_original_diameter() const
  {
    return sauter_mean(types(), [](const ParticleType &type) {
      return type.sizes.sauter_diameter(type.diameter);
    });
  }

  double
  DemParameters::mean_simulated_diameter() const
  {
    return sauter_mean(types(), [](const ParticleType &type) {
      return type.scale * type.sizes.sauter_diameter(type.diameter);
    });
  }

  double
  DemParameters::normal_stiffness() const
  {
    return contact.normal_stiffness * particles.scale;
  }

  double
  DemParameters::characteristic_time() const
  {
    double shortest = std::numeric_limits<double>::max();
    for (const auto &type : types())
      {
        const double radius = type.smallest_radius();
        shortest            = std::min(
          shortest,
          contact.model == "linear-spring"
                       ? 0.25 * std::sqrt(type.density * sphere_volume(radius) / normal_stiffness())
                       : rayleigh_time(radius, type.density, type.elasticity));
      }
    return shortest;
  }

  double
  DemParameters::substep() const
  {
    return contact.substep > 0. ? contact.substep
                                : contact.time_fraction * characteristic_time();
  }

  double
  DemParameters::reference_force() const
  {
    const double r       = largest_radius();
    const double overlap = 0.1 * r;
    if (contact.model == "linear-spring")
      return normal_stiffness() * overlap;
    double stiffest = 0.;
    for (const auto &pair : materials(false, {}).particles)
      stiffest = std::max(stiffest, pair.young);
    return 4. / 3. * stiffest * std::sqrt(0.5 * r * overlap) * overlap;
  }

  double
  DemParameters::overlap_under(const double force) const
  {
    if (contact.model == "linear-spring")
      return force / normal_stiffness();
    return hertz_overlap(
      force, materials(false, {}).between(0, 0).young, 0.25 * mean_simulated_diameter());
  }

  NormalLaws
  DemParameters::normal_law() const
  {
    if (contact.model == "linear-spring")
      return LinearSpring{};
    if (contact.model == "jkr")
      return Jkr{};
    return HertzMindlin{};
  }

  RollingLaws
  DemParameters::rolling_law() const
  {
    if (contact.rolling_model == "none")
      return FreeRolling{};
    if (contact.rolling_model == "constant-torque")
      return ConstantRollingTorque{};
    return SpringRolling{};
  }

  namespace
  {
    // One entry of "Contact/pairs".
    struct PairEntry
    {
      std::string first, second, quantity;
      double      value = 0.;
    };

    PairEntry
    read_pair(const std::string &text)
    {
      const std::string advice =
        "\"" + text +
        "\" is not a pair: write \"1-2 friction 0.3\" or \"2-bottom restitution 0.9\"";
      PairEntry entry;
      for (const std::string quantity :
           {"restitution", "friction", "rolling resistance", "adhesion"})
        {
          const auto at = text.find(" " + quantity + " ");
          if (at == std::string::npos)
            continue;
          // A type has no dash in its name, but a wall may.
          const auto bodies = text.substr(0, at);
          const auto first = bodies.find('-'), last = bodies.rfind('-');
          require(first != std::string::npos, "Contact/pairs", advice);
          const bool wall_leads = !number_in(bodies.substr(0, first)).has_value();
          const auto dash       = wall_leads ? last : first;
          entry.first           = dealii::Utilities::trim(bodies.substr(0, dash));
          entry.second          = dealii::Utilities::trim(bodies.substr(dash + 1));
          entry.quantity        = quantity;
          const auto value      = number_in(text.substr(at + quantity.size() + 2));
          require(value.has_value(), "Contact/pairs", advice);
          entry.value = *value;
          return entry;
        }
      require(false, "Contact/pairs", advice);
      return entry;
    }
  } // namespace

  void
  DemParameters::check_pairs() const
  {
    const auto            n_types = types().size();
    std::set<std::string> all_types;
    for (std::size_t type = 1; type <= n_types; ++type)
      all_types.insert(std::to_string(type));
    const auto        walls_here = walls.names();
    const std::string known      = boost::algorithm::join(walls_here, ", ");
    for (const auto &text : dealii::Utilities::split_string_list(contact.pairs))
      {
        const auto entry = read_pair(text);
        for (const auto &body : {entry.first, entry.second})
          require(all_types.count(body) > 0 ||
                    std::count(walls_here.begin(), walls_here.end(), body) > 0,
                  "Contact/pairs",
                  "\"" + body + "\" is neither a type from 1 to " +
                    std::to_string(n_types) + " nor a wall of this vessel: " + known);
        require(all_types.count(entry.first) + all_types.count(entry.second) > 0,
                "Contact/pairs",
                "\"" + text + "\" names two walls, which do not touch");
        Surface surface = contact.particle_surface;
        override_surface(entry.first + "-" + entry.second, surface);
        check_surface(surface, "pair " + entry.first + "-" + entry.second);
      }
  }

  void
  DemParameters::override_surface(const std::string &pair, Surface &surface) const
  {
    for (const auto &text : dealii::Utilities::split_string_list(contact.pairs))
      {
        const auto entry = read_pair(text);
        if (entry.first + "-" + entry.second != pair &&
            entry.second + "-" + entry.first != pair)
          continue;
        if (entry.quantity == "restitution")
          surface.restitution = entry.value;
        if (entry.quantity == "friction")
          surface.friction = entry.value;
        if (entry.quantity == "rolling resistance")
          surface.rolling_resistance = entry.value;
        if (entry.quantity == "adhesion")
          surface.adhesion = entry.value;
      }
  }

  Materials
  DemParameters::materials(const bool packing, const std::vector<Wall> &vessel) const
  {
    Surface between = contact.particle_surface, with_wall = contact.wall_surface;
    if (packing)
      {
        between.friction             = contact.packing_particle_friction;
        between.rolling_resistance   = contact.packing_particle_rolling;
        with_wall.friction           = contact.packing_wall_friction;
        with_wall.rolling_resistance = contact.packing_wall_rolling;
      }
    const auto pair_material = [&](const Elasticity  &first,
                                   const Elasticity  &second,
                                   Surface            surface,
                                   const std::string &pair) {
      override_surface(pair, surface);
      return PairMaterial(
        first, second, surface, normal_stiffness(), contact.stiffness_ratio);
    };

    const auto all = types();
    Materials  result;
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        result.density.push_back(all[i].density);
        for (std::size_t j = 0; j < all.size(); ++j)
          result.particles.push_back(
            pair_material(all[i].elasticity,
                          all[j].elasticity,
                          between,
                          std::to_string(i + 1) + "-" + std::to_string(j + 1)));
      }
    for (const auto &wall : vessel)
      for (std::size_t i = 0; i < all.size(); ++i)
        result.walls.push_back(pair_material(all[i].elasticity,
                                             contact.wall_elasticity,
                                             with_wall,
                                             std::to_string(i + 1) + "-" + wall.name));
    return result;
  }
} // namespace graupel
