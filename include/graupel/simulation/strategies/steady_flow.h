// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_strategies_steady_flow_h
#define graupel_simulation_strategies_steady_flow_h

#include <graupel/simulation/strategies/moving_flow.h>

namespace graupel
{
  /**
   * The steady flow through the bed at rest, found in a dozen linear systems; then the
   * particles are held against its force, which grows on them over the ramp time.
   */
  class SteadyFlow : public FlowStrategy
  {
  public:
    /** With @p must_rest a bed that moves ends it: see has_failed(). */
    SteadyFlow(FlowFrame &frame, const bool must_rest);

    /** The whole case in one step. */
    bool step() override;

    bool
    is_steady() const override
    {
      return !failed;
    }

    /** The bed does not rest against the flow. */
    bool
    has_failed() const
    {
      return failed;
    }

    Progress::Way way() const override;
    std::string   told() const override;
    std::string   save() const override;
    void          resume(const std::string &saved) override;

  private:
    bool find();
    bool find_flow();
    // Holds the bed against the force of the steady flow, which grows from
    // @p force_before [N], so that the walls carry what the fluid leaves them; where it
    // must rest it ends when the bed rises, and goes on for a while if spheres move still.
    // Relative change of the top of the bed [-].
    double hold_particles(const double force_before);

    FlowFrame   &frame;
    const bool   must_rest;
    bool         done = false, failed = false;
    unsigned int systems = 0; // linear ones
  };

  /** Steady while the bed rests against the flow; fluid and particles move from where it
   * does not. */
  class AutomaticFlow : public FlowStrategy
  {
  public:
    explicit AutomaticFlow(FlowFrame &frame);

    bool          step() override;
    bool          is_steady() const override;
    Progress::Way way() const override;
    std::string   told() const override;
    std::string   save() const override;
    void          resume(const std::string &saved) override;

  private:
    FlowFrame                &frame;
    SteadyFlow                steady;
    std::optional<MovingFlow> moving; // from when the bed does not rest
  };
} // namespace graupel

#endif
