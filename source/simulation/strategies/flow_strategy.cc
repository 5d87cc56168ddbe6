// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/strategies/steady_flow.h>

namespace graupel
{
  double
  FlowFrame::velocity_at(const double time_in_case) const
  {
    const double ramp = state.parameters.sweep.ramp_time;
    const double part = ramp > 0. ? std::min(1., time_in_case / ramp) : 1.;
    return ramp_from + part * (velocity.value_or(0.) - ramp_from);
  }

  void
  FlowFrame::move_particles(const double duration)
  {
    if (!state.fluid)
      state.dem.advance(duration);
    else
      state.fluid->move_particles(duration);
    state.time += duration;
    if (state.fluid)
      state.ledger.record(state.last_step.mass_imbalance,
                          state.fluid->exchange().momentum_imbalance(),
                          state.fluid->exchange().solid_volume_error());
  }

  std::unique_ptr<FlowStrategy>
  make_strategy(FlowFrame &frame)
  {
    const std::string &mode = frame.state.parameters.sweep.mode;
    if (mode == "steady")
      return std::make_unique<SteadyFlow>(frame, false);
    if (mode == "automatic")
      return std::make_unique<AutomaticFlow>(frame);
    if (mode == "particles alone")
      return std::make_unique<ParticlesAlone>(frame);
    return std::make_unique<MovingFlow>(frame);
  }
} // namespace graupel
