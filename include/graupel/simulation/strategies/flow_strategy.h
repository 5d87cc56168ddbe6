// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_strategies_flow_strategy_h
#define graupel_simulation_strategies_flow_strategy_h

#include <graupel/dem/packing/feed.h>
#include <graupel/simulation/observers/steady_monitor.h>

namespace graupel
{
  /** A flow case as its strategy sees it. */
  struct FlowFrame
  {
    SimulationState &state;
    /** What brings in particles. */
    Feeds &feeds;
    /** V, which the velocity comes to [m/s]; nothing without a fluid. */
    Value velocity;
    /** Whether V has been reached, on a ramp from this one [m/s]. */
    double ramp_from = 0.;
    /** When the case began [s]. */
    double        begin = 0.;
    SteadyMonitor steady;

    /** V at @p time_in_case [s], on the ramp [m/s]. */
    double velocity_at(const double time_in_case) const;

    /** Since the case began [s]. */
    double
    time() const
    {
      return state.time - begin;
    }

    /** Takes the particles through @p duration [s] with the force of the fluid that they
     * have, and records the ledger of what moved them. Collective. */
    void move_particles(const double duration);
  };

  /** How the flow of a case is found. */
  class FlowStrategy
  {
  public:
    virtual ~FlowStrategy() = default;

    /** Goes on by a step; false, doing nothing, when the case has ended. Throws
     * SolverFailure where the flow cannot be found. Collective. */
    virtual bool step() = 0;

    /** Whether the flow is a steady one by how it was found. */
    virtual bool
    is_steady() const
    {
      return false;
    }

    /** Where it goes, for the progress line. */
    virtual Progress::Way way() const = 0;

    /** What has been done, for the log, once the case has ended. */
    virtual std::string told() const = 0;

    /** For a checkpoint. */
    virtual std::string save() const                     = 0;
    virtual void        resume(const std::string &saved) = 0;
  };

  /** The strategy that Flow/mode names. @p frame must outlive it. */
  std::unique_ptr<FlowStrategy> make_strategy(FlowFrame &frame);
} // namespace graupel

#endif
