// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/state/bytes.h>
#include <graupel/simulation/strategies/steady_flow.h>

#include <boost/serialization/utility.hpp>

namespace graupel
{
  namespace
  {
    // A bed whose height changes by more [-] while it is held against the steady flow
    // has another flow: it is looked for again, so often.
    constexpr double       unmoved    = 1e-4;
    constexpr unsigned int most_looks = 5;
    // The bed does not rest if its height changes by more than this [-], or if the fluid
    // carries more than this part of the weight.
    constexpr double moved        = 2e-3;
    constexpr double most_carried = 0.93;
    // Between two looks at a bed that is held [s].
    constexpr double hold_piece = 5e-3;
    // A bed that keeps its height, but has spheres that move still, is held on for up to so
    // many times the ramp and the window.
    constexpr unsigned int patience = 4;
  } // namespace

  SteadyFlow::SteadyFlow(FlowFrame &frame, const bool must_rest)
    : frame(frame)
    , must_rest(must_rest)
  {
  }

  bool
  SteadyFlow::step()
  {
    if (done)
      return false;
    done   = true;
    failed = !find();
    return !failed;
  }

  Progress::Way
  SteadyFlow::way() const
  {
    const double most = frame.state.parameters.sweep.maximum_solves;
    return {0., most, "linear systems", true};
  }

  std::string
  SteadyFlow::told() const
  {
    return "steady flow after " + std::to_string(systems) + " linear systems";
  }

  bool
  SteadyFlow::find_flow()
  {
    SimulationState &state = frame.state;
    try
      {
        state.last_step = state.fluid->find_steady_state(
          [&](const double) { state.progress.update(++systems); });
        return true;
      }
    catch (const SolverFailure &)
      {
        if (!must_rest)
          throw;
        return false;
      }
  }

  bool
  SteadyFlow::find()
  {
    SimulationState &state        = frame.state;
    double           force_before = state.fluid->flow_force_against_gravity();
    state.fluid->set_superficial_velocity(frame.velocity.value_or(0.));
    for (unsigned int look = 0; look < most_looks; ++look)
      {
        if (!find_flow())
          return false;
        const double force = state.fluid->flow_force_against_gravity();
        if (must_rest && force > most_carried * state.dem.weight())
          return false;
        const double shift = std::abs(hold_particles(force_before));
        force_before       = force;
        if (must_rest &&
            (shift > moved || !state.parameters.settling.is_met_by(state.dem)))
          {
            frame.ramp_from = frame.velocity.value_or(0.);
            return false;
          }
        if (!must_rest || shift <= unmoved)
          return true;
      }
    return false;
  }

  double
  SteadyFlow::hold_particles(const double force_before)
  {
    SimulationState       &state = frame.state;
    const SweepParameters &sweep = state.parameters.sweep;
    const auto             top   = [&]() {
      const auto bed = state.bed();
      return bed.exists ? bed.top : 0.;
    };
    const double height = top();
    const auto   change = [&]() { return height > 0. ? top() / height - 1. : 0.; };
    const double force  = state.fluid->flow_force_against_gravity();
    const double before = std::clamp(force > 0. ? force_before / force : 0., 0., 1.);
    const double ramp   = sweep.ramp_time;
    const double end    = ramp + sweep.steady_window;
    const auto   n      = static_cast<unsigned int>(std::ceil(end / hold_piece));
    double       last   = 1.; // factor on the forces now
    for (unsigned int piece = 1; piece <= patience * n; ++piece)
      {
        if (piece > n && (!must_rest || state.parameters.settling.is_met_by(state.dem)))
          break;
        const double part   = ramp > 0. ? std::min(1., piece * end / n / ramp) : 1.;
        const double factor = part + (1. - part) * before;
        for (dealii::Tensor<1, 3> &f : state.dem.particles().external_force)
          f *= factor / last;
        last = factor;
        frame.move_particles(end / n);
        if (must_rest && change() > moved)
          break;
      }
    return change();
  }

  std::string
  SteadyFlow::save() const
  {
    return to_bytes(std::make_pair(done, failed));
  }

  void
  SteadyFlow::resume(const std::string &saved)
  {
    std::tie(done, failed) = from_bytes<std::pair<bool, bool>>(saved);
  }

  AutomaticFlow::AutomaticFlow(FlowFrame &frame)
    : frame(frame)
    , steady(frame, true)
  {
  }

  bool
  AutomaticFlow::step()
  {
    if (!moving)
      {
        if (steady.step())
          return true;
        if (!steady.has_failed())
          return false;
        frame.state.progress.say(
          "the bed does not rest against this flow: fluid and particles move");
        frame.begin = frame.state.time;
        moving.emplace(frame);
        frame.state.progress.go_on(way());
      }
    return moving->step();
  }

  Progress::Way
  AutomaticFlow::way() const
  {
    return moving ? moving->way() : steady.way();
  }

  std::string
  AutomaticFlow::told() const
  {
    return moving ? moving->told() : steady.told();
  }

  bool
  AutomaticFlow::is_steady() const
  {
    return !moving;
  }

  std::string
  AutomaticFlow::save() const
  {
    return to_bytes(
      std::make_pair(steady.save(), moving ? moving->save() : std::string()));
  }

  void
  AutomaticFlow::resume(const std::string &saved)
  {
    const auto [of_steady, of_moving] =
      from_bytes<std::pair<std::string, std::string>>(saved);
    steady.resume(of_steady);
    if (!of_moving.empty())
      moving.emplace(frame).resume(of_moving);
  }
} // namespace graupel
