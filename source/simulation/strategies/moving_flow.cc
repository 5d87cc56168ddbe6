// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/parameters/step_limits.h>
#include <graupel/simulation/state/bytes.h>
#include <graupel/simulation/strategies/moving_flow.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>

namespace graupel
{
  namespace
  {
    const char *const response = "the particles' response to the drag";

    // A step of the fluid that fails is tried with its half, so often.
    constexpr unsigned int maximum_halvings = 6;

    // Steps of one length to the end, so that the last is not a tiny one.
    double
    even_step(const double remaining, const double longest)
    {
      return remaining / std::ceil(remaining / longest * (1. - 1e-12));
    }

    bool
    is_over(const double time, const double duration)
    {
      return !(time < duration * (1. - 1e-12));
    }

    void
    feed_particles(FlowFrame &frame, const double step)
    {
      frame.feeds.advance(frame.state.dem.clock(), step);
    }
  } // namespace

  MovingFlow::MovingFlow(FlowFrame &frame)
    : frame(frame)
    , duration(frame.state.parameters.sweep.case_duration(
        frame.velocity.value_or(0.), frame.state.parameters.cylinder.height))
    , step_limit(frame.state.parameters.sweep.longest_step())
  {
  }

  bool
  MovingFlow::step()
  {
    const SweepParameters &sweep = frame.state.parameters.sweep;
    if (is_over(frame.time(), duration) ||
        (sweep.stop_when == "steady" && frame.steady.is_steady()))
      return false;
    SimulationState &state = frame.state;
    const double     aim   = next_step(duration - frame.time());
    state.fluid->set_superficial_velocity(frame.velocity_at(frame.time() + aim));
    feed_particles(frame, aim);
    const double step = step_fluid(aim);
    state.adapt_if_due();
    frame.move_particles(step);
    state.progress.update(frame.time());
    return true;
  }

  std::vector<MovingFlow::Limit>
  MovingFlow::limits() const
  {
    const SweepParameters &sweep = frame.state.parameters.sweep;
    const CoupledFlow     &fluid = *frame.state.fluid;
    const double           rate  = fluid.fluid().courant_rate();
    std::vector<Limit>     result{{fluid.stable_step(), response}};
    if (sweep.courant_number > 0. && rate > 0.)
      result.push_back({sweep.courant_number / rate, "Flow/Courant number"});
    return result;
  }

  double
  MovingFlow::next_step(const double remaining)
  {
    const SweepParameters &sweep = frame.state.parameters.sweep;
    Limit                  rule{sweep.longest_step(),
               sweep.fixed_step() ? "Flow/time step" : "Flow/steady window"};
    const auto             keep_to = [&](const Limit &limit) {
      if (limit.step < rule.step)
        rule = limit;
    };
    if (sweep.fixed_step())
      warn_of_long_steps(rule.step);
    else
      for (const Limit &limit : limits())
        keep_to(limit);
    keep_to({step_limit, "a step that has failed"});
    ++steps_by[rule.name];
    return even_step(remaining, rule.step);
  }

  void
  MovingFlow::warn_of_long_steps(const double step)
  {
    const double limit = frame.state.fluid->stable_step();
    if (has_warned || !(step > limit))
      return;
    has_warned = true;
    std::ostringstream text;
    text << "warning: at " << frame.state.time << " s: " << long_step(step, limit);
    frame.state.progress.say(text.str());
  }

  Progress::Way
  MovingFlow::way() const
  {
    return {0., duration, "s", frame.state.parameters.sweep.stop_when == "steady"};
  }

  std::string
  MovingFlow::told() const
  {
    std::ostringstream text;
    text << (frame.steady.is_steady() ? "steady" : "not steady") << " after "
         << frame.time() << " s of simulated time; steps of the fluid";
    for (const auto &[rule, n] : steps_by)
      text << (&rule == &steps_by.begin()->first ? ": " : ", ") << n << " by " << rule;
    return text.str();
  }

  double
  MovingFlow::step_fluid(double step)
  {
    for (unsigned int halvings = 0;; ++halvings)
      try
        {
          frame.state.last_step = frame.state.fluid->step(step);
          step_limit            = 2. * step;
          return step;
        }
      catch (const SolverFailure &error)
        {
          if (halvings == maximum_halvings)
            throw;
          step *= 0.5;
          std::ostringstream text;
          text << "at " << frame.state.time << " s: " << error.what()
               << " Trying a step of " << step << " s.";
          frame.state.progress.say(text.str());
        }
  }

  std::string
  MovingFlow::save() const
  {
    return to_bytes(std::make_pair(std::make_pair(step_limit, has_warned), steps_by));
  }

  void
  MovingFlow::resume(const std::string &saved)
  {
    std::pair<double, bool> of_steps;
    std::tie(of_steps, steps_by) =
      from_bytes<std::pair<std::pair<double, bool>, std::map<std::string, unsigned int>>>(
        saved);
    std::tie(step_limit, has_warned) = of_steps;
  }

  ParticlesAlone::ParticlesAlone(FlowFrame &frame)
    : frame(frame)
  {
  }

  bool
  ParticlesAlone::step()
  {
    const SweepParameters &sweep = frame.state.parameters.sweep;
    if (is_over(frame.time(), sweep.duration))
      return false;
    const double step = even_step(sweep.duration - frame.time(), sweep.longest_step());
    feed_particles(frame, step);
    frame.move_particles(step);
    frame.state.progress.update(frame.time());
    return true;
  }

  Progress::Way
  ParticlesAlone::way() const
  {
    return {0., frame.state.parameters.sweep.duration, "s", false};
  }

  std::string
  ParticlesAlone::told() const
  {
    std::ostringstream text;
    text << frame.time() << " s of simulated time";
    return text.str();
  }

  std::string
  ParticlesAlone::save() const
  {
    return {};
  }

  void
  ParticlesAlone::resume(const std::string &)
  {
  }
} // namespace graupel
