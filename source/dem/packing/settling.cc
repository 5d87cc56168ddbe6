// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/packing/settling.h>
#include <graupel/dem/particles/dem_error.h>

#include <deal.II/base/numbers.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // A tap: two periods of gravity g (1 + amplitude sin), in pieces short
    // against a period.
    constexpr double tap_frequency   = 30.;
    constexpr double tap_periods     = 2.;
    constexpr double tap_piece       = 1e-3;
    constexpr double first_amplitude = 0.8;
    constexpr double least_amplitude = 0.2;
    constexpr double most_amplitude  = 4.;
  } // namespace

  void
  SettlingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Settling");
    prm.add_parameter(
      "kinetic energy",
      kinetic_energy,
      "Mean kinetic energy per particle below which the bed is at rest, if the "
      "speed is low as well; spin does not count, as a sphere may spin on the bottom "
      "for long [J].");
    prm.add_parameter(
      "speed",
      speed,
      "Speed of the fastest particle below which the bed is at rest, if the "
      "kinetic energy is low as well [m/s].");
    prm.add_parameter(
      "interval", interval, "Time between two looks at whether the bed rests [s].");
    prm.add_parameter("maximum time",
                      maximum_time,
                      "Simulated time after which settling is given up [s].");
    prm.add_parameter(
      "target void fraction",
      target_void_fraction,
      "Mean void fraction that a looser bed is brought to by tapping, before the "
      "friction of the flow returns; 0 to take the bed as it comes [-].");
    prm.leave_subsection();
  }

  void
  SettlingParameters::check() const
  {
    require(kinetic_energy > 0.,
            "Settling/kinetic energy",
            "no bed ever rests completely; choose a positive energy, in joule");
    require(speed > 0.,
            "Settling/speed",
            "no bed ever rests completely; choose a positive speed, in m/s");
    require(interval > 0., "Settling/interval", "choose a positive time, in seconds");
    require(maximum_time > interval,
            "Settling/maximum time",
            "choose a time longer than Settling/interval, in seconds");
    require(
      target_void_fraction == 0. ||
        (target_void_fraction >= 0.36 && target_void_fraction < 1.),
      "Settling/target void fraction",
      "equal spheres cannot be tapped into less than about 0.36; 0 takes the bed as it "
      "comes");
  }

  bool
  SettlingParameters::is_met_by(const Dem &dem) const
  {
    return dem.maximum_speed() < speed &&
           dem.mean_translational_energy() < kinetic_energy;
  }

  Settling::Settling(const SettlingParameters &parameters, Dem &dem)
    : input(parameters)
    , dem(dem)
    , observables(dem.particles(), dem.vessel_shape(), dem.communicator())
  {
    at.amplitude = first_amplitude;
    dem.use_packing_materials(true);
  }

  void
  Settling::restore(const State &state)
  {
    at = state;
    dem.use_packing_materials(at.phase == Phase::packing || at.phase == Phase::tapping);
  }

  const char *
  Settling::activity() const
  {
    switch (at.phase)
      {
        case Phase::packing:
          return "settling";
        case Phase::tapping:
          return "tapping";
        case Phase::relaxing:
          return "settling with the friction of the flow";
        case Phase::settled:
          return "settled";
      }
    return "";
  }

  bool
  Settling::at_rest()
  {
    dem.advance(input.interval);
    at.elapsed += input.interval;
    return input.is_met_by(dem);
  }

  void
  Settling::end()
  {
    if (at.phase == Phase::tapping)
      dem.set_gravity(dem.parameters().particles.gravity);
    dem.use_packing_materials(false);
    at.phase = Phase::settled;
  }

  bool
  Settling::step()
  {
    if (dem.n_global() == 0)
      end();
    switch (at.phase)
      {
        case Phase::settled:
          return false;
        case Phase::tapping:
          tap();
          break;
        case Phase::packing:
          if (at_rest())
            leave_packing();
          break;
        case Phase::relaxing:
          if (at_rest())
            at.phase = Phase::settled;
          break;
      }
    finish_if_too_late();
    return at.phase != Phase::settled;
  }

  void
  Settling::leave_packing()
  {
    const double before = at.void_fraction;
    at.void_fraction    = observables.bed().mean_void_fraction;
    const double excess = at.void_fraction - input.target_void_fraction;
    if (input.target_void_fraction == 0. || excess <= 0.)
      {
        dem.use_packing_materials(false);
        at.phase = Phase::relaxing;
        return;
      }

    // Aim at a few more taps of the same size; the last ones must be gentle,
    // since what is too dense does not become looser again.
    if (at.taps > 0)
      {
        const double gain = before - at.void_fraction;
        if (gain > 0.5 * excess)
          at.amplitude = std::max(0.7 * at.amplitude, least_amplitude);
        else if (gain < 0.2 * excess)
          at.amplitude = std::min(1.2 * at.amplitude, most_amplitude);
      }
    at.phase    = Phase::tapping;
    at.tap_time = 0.;
    ++at.taps;
  }

  void
  Settling::tap()
  {
    const auto   g = dem.parameters().gravity();
    const double phi =
      2. * dealii::numbers::PI * tap_frequency * (at.tap_time + 0.5 * tap_piece);
    dem.set_gravity((1. + at.amplitude * std::sin(phi)) * g);
    dem.advance(tap_piece);
    at.elapsed += tap_piece;
    at.tap_time += tap_piece;
    if (at.tap_time >= tap_periods / tap_frequency)
      {
        dem.set_gravity(g);
        at.phase = Phase::packing;
      }
  }

  void
  Settling::finish_if_too_late() const
  {
    if (at.elapsed < input.maximum_time || at.phase == Phase::settled)
      return;
    std::ostringstream text;
    text << "the bed has not settled in " << at.elapsed << " s (Settling/maximum time): ";
    if (at.taps > 0)
      text << "after " << at.taps << " taps its mean void fraction is "
           << at.void_fraction << ", the target " << input.target_void_fraction
           << ". Allow more time, a higher target, or a lower packing friction.";
    else
      text << "mean kinetic energy " << dem.mean_translational_energy() << " J of "
           << input.kinetic_energy << " J, fastest particle " << dem.maximum_speed()
           << " m/s of " << input.speed << " m/s. Allow more time or higher limits.";
    throw DemError(text.str());
  }
} // namespace graupel
