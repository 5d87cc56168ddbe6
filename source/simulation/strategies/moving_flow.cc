#include <graupel/simulation/state/bytes.h>
#include <graupel/simulation/strategies/moving_flow.h>

#include <boost/serialization/utility.hpp>

namespace graupel
{
  namespace
  {
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
    , step_limit(frame.state.parameters.sweep.time_step)
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

  double
  MovingFlow::next_step(const double remaining)
  {
    const SweepParameters &sweep = frame.state.parameters.sweep;
    double                 step  = std::min(sweep.time_step, step_limit);
    std::string            rule;
    const auto             keep_to = [&](const double limit, const std::string &name) {
      if (limit < step)
        {
          step = limit;
          rule = name;
        }
    };
    const double rate = frame.state.fluid->fluid().courant_rate();
    if (sweep.courant_number > 0. && rate > 0.)
      keep_to(sweep.courant_number / rate, "Flow/Courant number");
    keep_to(frame.state.fluid->stable_step(), "the particles' response to the drag");
    tell_what_rules(rule, step);
    return even_step(remaining, step);
  }

  void
  MovingFlow::tell_what_rules(const std::string &rule, const double step)
  {
    if (rule == ruled_by)
      return;
    ruled_by = rule;
    std::ostringstream text;
    text << "at " << frame.state.time << " s: ";
    if (rule.empty())
      text << "steps of Flow/time step again";
    else
      text << "steps are shortened to " << step << " s by " << rule;
    frame.state.progress.say(text.str());
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
    return to_bytes(std::make_pair(step_limit, ruled_by));
  }

  void
  MovingFlow::resume(const std::string &saved)
  {
    std::tie(step_limit, ruled_by) = from_bytes<std::pair<double, std::string>>(saved);
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
    const double step = even_step(sweep.duration - frame.time(), sweep.time_step);
    feed_particles(frame, step);
    frame.move_particles(step);
    frame.state.progress.update(frame.time());
    return true;
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
