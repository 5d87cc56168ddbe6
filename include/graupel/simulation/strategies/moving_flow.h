#ifndef graupel_simulation_strategies_moving_flow_h
#define graupel_simulation_strategies_moving_flow_h

#include <graupel/simulation/strategies/flow_strategy.h>

namespace graupel
{
  /** Fluid and particles move through time together. */
  class MovingFlow : public FlowStrategy
  {
  public:
    explicit MovingFlow(FlowFrame &frame);

    bool        step() override;
    std::string save() const override;
    void        resume(const std::string &saved) override;

  private:
    double next_step(const double remaining);
    double step_fluid(double step);
    void   tell_what_rules(const std::string &rule, const double step);

    FlowFrame   &frame;
    const double duration;   // at most [s]
    double       step_limit; // after a step that failed [s]
    std::string  ruled_by;   // what the length of a step follows
  };

  /** Particles move without a fluid. */
  class ParticlesAlone : public FlowStrategy
  {
  public:
    explicit ParticlesAlone(FlowFrame &frame);

    bool        step() override;
    std::string save() const override;
    void        resume(const std::string &saved) override;

  private:
    FlowFrame &frame;
  };
} // namespace graupel

#endif
