// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/loose_packing.h>
#include <graupel/dem/particles/particle_list.h>

namespace graupel
{
  namespace
  {
    // A particle of a list may reach into a wall by this part of its radius; contacts
    // fail at a little more.
    constexpr double largest_reach_into_wall = 0.29;

    constexpr double densest_solid_fraction = 0.74;

    // What is placed at random leaves more room between than this, if of one size.
    constexpr double densest_random_places = 0.4;

    // No more of the space below the top can be taken by spheres that fall through it.
    constexpr double densest_rain = 0.5;

    // Of spheres of so many sizes: small ones fill the holes of large ones.
    double
    densest_packing(const unsigned int n_sizes)
    {
      return n_sizes == 0 ? 1. : 1. - std::pow(1. - densest_solid_fraction, n_sizes);
    }
  } // namespace

  void
  FillingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Filling");
    prm.add_parameter(
      "method",
      method,
      "How the bed is filled: rain (layer by layer from the top), packing (loose "
      "packings of the whole free space that fall; faster), volume (one loose packing "
      "between lower and upper), list (from a file), or none (nothing is filled in).",
      dealii::Patterns::Selection("rain|packing|volume|list|none"));
    prm.add_parameter(
      "type",
      type,
      "Number of the one type of particles that is filled in; 0 for all, by their mass "
      "fractions [-].");
    prm.add_parameter(
      "count",
      count,
      "Number of simulated particles to fill in; 0 to fill by mass or bed "
      "height [-].");
    prm.add_parameter(
      "mass",
      mass,
      "Mass of all particles to fill in; 0 to fill by count or bed height [kg].");
    prm.add_parameter(
      "bed height",
      bed_height,
      "Height of the bed at which filling ends, taking particles still in the air "
      "into account; 0 to fill by count or mass [m].");
    prm.add_parameter("drop speed",
                      drop_speed,
                      "Downward speed at which particles enter below the top [m/s].");
    prm.add_parameter(
      "interval",
      interval,
      "Time between two layers of particles; 0 for the shortest in which a layer "
      "makes room for the next [s].");
    prm.add_parameter("rate",
                      rate,
                      "Particles that rain in a second, whatever the layers; 0 for as "
                      "many as there is room for [1/s].");
    prm.add_parameter("lower", lower, "Lower end of the section that volume fills [m].");
    prm.add_parameter(
      "upper", upper, "Upper end of the section that volume fills; 0 for the top [m].");
    prm.add_parameter(
      "start from",
      start_from,
      "Output directory of another run: its settled bed is taken instead "
      "of filling, and settles again where it must. The vessel's diameter "
      "and the particles' must be the same; density, contacts, mesh and "
      "flow may differ. Empty: fill.");
    prm.add_parameter("file",
                      file,
                      "CSV file of the method list, with the columns x, y, z, diameter "
                      "and if wanted vx, vy, vz, wx, wy, wz, type (SI units).");
    prm.add_parameter(
      "seed", seed, "Start of the random numbers that place particles [-].");
    prm.leave_subsection();
  }

  void
  FillingParameters::check(const Cylinder &cylinder, const DemParameters &particles) const
  {
    require(drop_speed > 0.,
            "Filling/drop speed",
            "particles must leave the place where they enter; choose a positive speed, "
            "in m/s");
    require((method != "rain" && method != "packing") || !start_from.empty() ||
              particles.particles.gravity_is_axial(),
            "Filling/method",
            "particles fall from the top along the axis, but Particles/gravity points "
            "elsewhere; take the method volume or list");
    require(interval >= 0.,
            "Filling/interval",
            "a time is positive, in seconds; 0 for the default");
    require(rate >= 0., "Filling/rate", "a rate is positive, in 1/s; 0 for the fastest");
    require(mass >= 0., "Filling/mass", "a mass is positive, in kg; 0 if not used");
    require(bed_height >= 0.,
            "Filling/bed height",
            "a height is positive, in metres; 0 if not used");
    require(type <= particles.types().size(),
            "Filling/type",
            "types go from 1 to " + std::to_string(particles.types().size()) +
              "; 0 for all of them");
    check_method(cylinder, particles);
  }

  void
  FillingParameters::check_method(const Cylinder      &cylinder,
                                  const DemParameters &particles) const
  {
    require((method == "list") == !file.empty(),
            "Filling/file",
            "the method list needs a file, and no other method has one");
    require(rate == 0. || method == "rain",
            "Filling/rate",
            "particles come at a rate with the method rain only; set 0, or that method");
    const double end = upper > 0. ? upper : cylinder.height;
    require(method != "volume" || (lower >= 0. && end <= cylinder.height &&
                                   end - lower > 2.2 * particles.largest_radius()),
            "Filling/upper",
            "the section to fill must lie in the vessel and be higher than a particle");
    require(method != "none" || (count == 0 && mass == 0.),
            count > 0 ? "Filling/count" : "Filling/mass",
            "the method none fills nothing in; set 0, or another Filling/method");
    if (method == "none" || !start_from.empty())
      return;
    if (method == "list")
      read_list(
        cylinder, particles, particles.walls.walls(cylinder), [](const NewParticle &) {});
    else
      check_amount(cylinder, particles);
  }

  double
  FillingParameters::n_expected_particles(const Cylinder      &cylinder,
                                          const DemParameters &particles) const
  {
    if (method == "none" || !start_from.empty())
      return 0.;
    if (method == "list")
      {
        double n = 0.;
        read_list(cylinder,
                  particles,
                  particles.walls.walls(cylinder),
                  [&](const NewParticle &) { ++n; });
        return n;
      }
    const ParticleSource source(particles.types(), type);
    return std::round(solid_volume(cylinder, source) / source.mean_volume());
  }

  double
  FillingParameters::solid_volume(const Cylinder       &cylinder,
                                  const ParticleSource &source) const
  {
    if (count > 0)
      return count * source.mean_volume();
    if (mass > 0.)
      return mass / source.mean_mass() * source.mean_volume();
    return bed_height * cylinder.cross_section() * loose_packing::usual_solid_fraction;
  }

  void
  FillingParameters::check_amount(const Cylinder      &cylinder,
                                  const DemParameters &particles) const
  {
    require((count > 0) + (mass > 0.) + (bed_height > 0.) == 1,
            "Filling/bed height",
            "exactly one of count, mass and bed height must be set and the other two be "
            "zero; a run without particles has Filling/method = none");

    const ParticleSource source(particles.types(), type);
    const double         d = 2. * source.largest_radius();
    const double         room =
      cylinder.height - (1. + RandomInsertion::zone_thickness + RandomInsertion::gap) * d;
    require(
      room > d, "Geometry/height", "the column is too low to drop particles into it");
    require(bed_height <= room,
            "Filling/bed height",
            "the bed would reach the place where particles enter, 1.5 diameters below "
            "the top; "
            "choose a lower bed or a higher column");

    const std::string by    = count > 0 ? "count" : mass > 0. ? "mass" : "bed height";
    const double      solid = solid_volume(cylinder, source);
    require(std::round(solid / source.mean_volume()) >= 1.,
            "Filling/" + by,
            "that is less than one particle, of " + text_of(source.mean_mass()) +
              " kg in the mean; fill in more, or nothing with Filling/method = none");
    const bool   at_once = method == "volume";
    const double section =
      at_once ? (upper > 0. ? upper : cylinder.height) - lower : room;
    const double densest = at_once && source.n_sizes() == 1
                             ? densest_random_places
                             : densest_packing(source.n_sizes());
    require(solid <= densest * cylinder.cross_section() * section,
            "Filling/" + by,
            (at_once ? "random places do not become dense enough"
                     : "not even the densest packing has room") +
              std::string(" for so many particles in the ") +
              (at_once ? "section" : "column") + ": " + text_of(solid) +
              " m^3 of solid in " + text_of(cylinder.cross_section() * section) + " m^3");
    check_rate(cylinder, particles, source);
  }

  void
  FillingParameters::check_rate(const Cylinder       &cylinder,
                                const DemParameters  &particles,
                                const ParticleSource &source) const
  {
    // What leaves the section has fallen through all of it at most.
    const double way = section_below_top(cylinder, source.largest_radius()).height();
    const double speed =
      std::sqrt(drop_speed * drop_speed + 2. * particles.particles.gravity * way);
    const double most = densest_packing(source.n_sizes()) / densest_solid_fraction *
                        densest_rain * cylinder.cross_section() * speed /
                        source.mean_volume();
    require(rate <= most,
            "Filling/rate",
            "the section below the top can take " + text_of(most) +
              " particles a second at most; choose a lower rate or a higher "
              "Filling/drop speed");
  }

  void
  FillingParameters::read_list(const Cylinder                                 &cylinder,
                               const DemParameters                            &particles,
                               const std::vector<Wall>                        &vessel,
                               const std::function<void(const NewParticle &)> &take) const
  {
    const auto types      = particles.types();
    const auto problem_of = [&](const NewParticle &particle) -> std::string {
      const auto problem = problem_of_size(particle, types);
      if (!problem.empty())
        return problem;
      const double z = particle.position[2];
      if (!(z >= 0. && z <= cylinder.height))
        return "the particle lies beyond an end of the vessel, which goes from z = 0 "
               "to " +
               text_of(cylinder.height) + " m";
      for (const Wall &wall : vessel)
        if (!wall.is_admissible(particle.position,
                                (1. - largest_reach_into_wall) * particle.radius))
          return "the particle lies beyond the wall \"" + wall.name +
                 "\", or deeper in it than " + text_of(100. * largest_reach_into_wall) +
                 " % of its radius";
      return {};
    };
    read_particle_list(file, types.size(), take, problem_of);
  }
} // namespace graupel
