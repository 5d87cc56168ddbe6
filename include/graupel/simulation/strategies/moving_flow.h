// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_strategies_moving_flow_h
#define graupel_simulation_strategies_moving_flow_h

#include <graupel/simulation/strategies/flow_strategy.h>

#include <map>

namespace graupel
{
  /** Fluid and particles move through time together. */
  class MovingFlow : public FlowStrategy
  {
  public:
    explicit MovingFlow(FlowFrame &frame);

    bool          step() override;
    Progress::Way way() const override;
    std::string   told() const override;
    std::string   save() const override;
    void          resume(const std::string &saved) override;

  private:
    struct Limit
    {
      double      step; // [s]
      std::string name;
    };

    // What steps of "auto" keep to.
    std::vector<Limit> limits() const;
    double             next_step(const double remaining);
    double             step_fluid(double step);
    void               warn_of_long_steps(const double step);

    FlowFrame   &frame;
    const double duration;           // at most [s]
    double       step_limit;         // after a step that failed [s]
    bool         has_warned = false; // of a step beyond the particles' response
    // How many steps followed what.
    std::map<std::string, unsigned int> steps_by;
  };

  /** Particles move without a fluid. */
  class ParticlesAlone : public FlowStrategy
  {
  public:
    explicit ParticlesAlone(FlowFrame &frame);

    bool          step() override;
    Progress::Way way() const override;
    std::string   told() const override;
    std::string   save() const override;
    void          resume(const std::string &saved) override;

  private:
    FlowFrame &frame;
  };
} // namespace graupel

#endif
