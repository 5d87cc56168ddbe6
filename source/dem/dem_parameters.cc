// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/dem_parameters.h>
#include <graupel/dem/particles/particle_arrays.h>

#include <limits>

namespace graupel
{
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
            "the contacts are unstable or inaccurate above " + text_of(longest) + " s, " +
              text_of(largest_time_fraction) + " of the characteristic time " +
              text_of(characteristic_time()) +
              " s; choose a shorter substep (zero for the default) or a softer material");
  }

  void
  DemParameters::check_sizes(const Cylinder &cylinder) const
  {
    const double mean = mean_simulated_diameter();
    require(2. * mean < cylinder.diameter && mean < cylinder.height,
            "Particles/diameter",
            "the simulated diameter " + text_of(mean) +
              " m does not go twice into the cylinder's diameter " +
              text_of(cylinder.diameter) + " m and once into its height " +
              text_of(cylinder.height) +
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
                "its largest simulated particle, of " + text_of(largest) +
                  " m, does not fit into the cylinder, " + text_of(cylinder.diameter) +
                  " m wide and " + text_of(cylinder.height) +
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
