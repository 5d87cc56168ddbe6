// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_phases_flow_case_h
#define graupel_simulation_phases_flow_case_h

#include <graupel/simulation/files/result_files.h>
#include <graupel/simulation/phases/phase.h>
#include <graupel/simulation/strategies/flow_strategy.h>

namespace graupel
{
  /** One of a run's flow cases: the fluid at one superficial velocity, or the particles
   * alone for a while. */
  class FlowCase : public Phase
  {
  public:
    /** What the cases of a run hand on to each other. */
    struct Series
    {
      Feeds    feeds;
      Probes   probes;
      MidPlane mid_plane;
      /** Those that have ended. */
      std::vector<CaseResult> results;
      /** V at the end of the last one [m/s]. */
      double last_velocity = 0.;
      /** The dem's clock has been started. */
      bool has_begun = false;
    };

    /** The case @p number, from 1, with the superficial velocity @p velocity [m/s], none
     * without a fluid; the references must outlive it. */
    FlowCase(const unsigned int number,
             const Value       &velocity,
             SimulationState   &state,
             Series            &series,
             ResultFiles       &files);

    const char *
    kind() const override
    {
      return "flow";
    }

    unsigned int
    flow_case() const override
    {
      return number;
    }

    void        begin() override;
    bool        step() override;
    void        end() override;
    Moment      moment() const override;
    void        note(const MonitorRow &row) override;
    std::string save() const override;
    void        resume(const std::string &saved) override;

  private:
    void start_progress();
    void keep(const MonitorRow &row);
    void average(const MonitorRow &row);
    void write_results(const CaseView &view, const CaseResult &result);
    void write_averages(const std::vector<SeriesStatistics> &statistics);

    const unsigned int            number;
    SimulationState              &state;
    Series                       &series;
    ResultFiles                  &files;
    FlowFrame                     frame;
    std::unique_ptr<FlowStrategy> strategy;
    CaseAverages                  averages;
    std::vector<MonitorRow>       rows;
    double wall_start, cpu_start; // before it those of a resumed run [s]
  };
} // namespace graupel

#endif
