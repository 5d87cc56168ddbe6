// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/dem_parameters.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <set>

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
  } // namespace

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
              text_of(DemParameters::largest_time_fraction) + "; 0.2 is usual");
    require(
      substep >= 0., "Contact/substep", "a step forward in time is positive, in seconds");
    require(skin > 0. && skin <= 2.,
            "Contact/skin",
            "without a skin the neighbour list is old at once, with a wide one it holds "
            "the whole "
            "bed; choose 0.2 to 0.3");
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
} // namespace graupel
