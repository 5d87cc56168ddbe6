// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/packing/feed.h>

namespace graupel
{
  void
  FeedParameters::declare(dealii::ParameterHandler &prm, const std::string &name)
  {
    prm.enter_subsection(name);
    prm.add_parameter("rate",
                      rate,
                      "Particles that come in in a second while the fluid flows; 0 for "
                      "none, or for a mass rate [1/s].");
    prm.add_parameter("mass rate",
                      mass_rate,
                      "Mass of particles that comes in in a second while the fluid "
                      "flows; 0 for none, or for a rate [kg/s].");
    prm.add_parameter("type",
                      type,
                      "Number of the one type of particles that comes in; 0 for all, by "
                      "their mass fractions [-].");
    prm.add_parameter(
      "from", from, "When it begins, from the beginning of the flow [s].");
    prm.add_parameter(
      "until", until, "When it ends, from the beginning of the flow; 0 for never [s].");
    prm.add_parameter(
      "lower",
      lower,
      "Lower end of the section in which particles appear at random places; with an "
      "upper end of 0 too, the section lies below the top [m].");
    prm.add_parameter(
      "upper", upper, "Upper end of the section in which particles appear [m].");
    prm.add_parameter("velocity", velocity, "Velocity at which they appear [m/s].");
    prm.add_parameter("most owed",
                      most_owed,
                      "Particles that may have fallen due and wait for a place before "
                      "the run stops with a message [-].");
    prm.add_parameter(
      "seed", seed, "Start of the random numbers that place particles [-].");
    prm.leave_subsection();
  }

  void
  FeedParameters::check(const Cylinder      &cylinder,
                        const DemParameters &particles,
                        const std::string   &name) const
  {
    require(rate >= 0., name + "/rate", "a rate is positive, in 1/s; 0 for none");
    require(mass_rate >= 0.,
            name + "/mass rate",
            "a mass rate is positive, in kg/s; 0 for none");
    require(rate == 0. || mass_rate == 0.,
            name + "/mass rate",
            "particles come in by number or by mass: set rate or mass rate to 0");
    const auto n_types = particles.types().size();
    require(type <= n_types,
            name + "/type",
            "types go from 1 to " + std::to_string(n_types) + "; 0 for all of them");
    require(from >= 0.,
            name + "/from",
            "a time of the flow is positive, in seconds from its beginning");
    require(until == 0. || until > from,
            name + "/until",
            "a feed ends after it begins, in seconds; 0 for never");
    require(velocity.norm_square() >= 0.,
            name + "/velocity",
            "three finite numbers in m/s are wanted");
    if (!is_wanted())
      return;
    const double d = 2. * ParticleSource(particles.types(), type).largest_radius();
    require((lower == 0. && upper == 0.) ||
              (lower >= 0. && upper <= cylinder.height && upper - lower > 1.1 * d),
            name + "/upper",
            "the section in which particles appear must lie in the vessel and be higher "
            "than a particle; 0 for both ends puts it below the top");
    require(cylinder.height > 2. * d,
            "Geometry/height",
            "the column is too low for the particles of the section " + name);
  }

  std::string
  FeedsParameters::name(const unsigned int number)
  {
    return number == 0 ? "Feed" : "Feed " + std::to_string(number + 1);
  }

  void
  FeedsParameters::declare(dealii::ParameterHandler &prm)
  {
    for (unsigned int n = 0; n < feeds.size(); ++n)
      feeds[n].declare(prm, name(n));
  }

  void
  FeedsParameters::check(const Cylinder &cylinder, const DemParameters &particles) const
  {
    for (unsigned int n = 0; n < feeds.size(); ++n)
      feeds[n].check(cylinder, particles, name(n));
  }

  bool
  FeedsParameters::is_wanted() const
  {
    return std::any_of(
      feeds.begin(), feeds.end(), [](const auto &feed) { return feed.is_wanted(); });
  }
} // namespace graupel
