// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/case_result.h>
#include <graupel/simulation/phases/flow_case.h>
#include <graupel/simulation/state/bytes.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace graupel
{
  namespace
  {
    // Where a case is, beside particles and fluid.
    struct SavedCase
    {
      double              begin = 0., ramp_from = 0.;
      double              wall_seconds = 0., cpu_seconds = 0.;
      std::vector<double> times;
      std::vector<double> values; // of all rows, one after the other
      std::string         strategy, averages;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &begin &ramp_from &wall_seconds &cpu_seconds;
        archive &times &values &strategy        &averages;
      }
    };
  } // namespace

  FlowCase::FlowCase(const unsigned int number,
                     const Value       &velocity,
                     SimulationState   &state,
                     Series            &series,
                     ResultFiles       &files)
    : number(number)
    , state(state)
    , series(series)
    , files(files)
    , frame{state,
            series.feeds,
            velocity,
            series.last_velocity,
            state.time,
            SteadyMonitor(state.parameters.sweep.steady_window,
                          state.parameters.sweep.steady_tolerance,
                          state.dem.weight())}
    , strategy(make_strategy(frame))
    , averages(state)
    , wall_start(Progress::steady_seconds())
    , cpu_start(state.cpu_seconds())
  {
  }

  void
  FlowCase::start_progress()
  {
    const SweepParameters &sweep = state.parameters.sweep;
    std::ostringstream     name;
    name << "flow " << number << "/" << sweep.cases().size();
    if (frame.velocity)
      name << ", superficial velocity " << *frame.velocity << " m/s";
    state.progress.start_phase(name.str(), strategy->way());
  }

  void
  FlowCase::begin()
  {
    if (!series.has_begun)
      {
        state.dem.start_clock(0.);
        series.has_begun = true;
        if (frame.velocity)
          state.start_fluid();
      }
    averages.begin();
    start_progress();
  }

  bool
  FlowCase::step()
  {
    return strategy->step();
  }

  Moment
  FlowCase::moment() const
  {
    double fed = 0.;
    for (const unsigned long of_type : series.feeds.inserted())
      fed += of_type;
    Value velocity;
    if (frame.velocity)
      velocity = state.parameters.sweep.mode == "transient"
                   ? frame.velocity_at(frame.time())
                   : *frame.velocity;
    return Moment(state, velocity, fed);
  }

  void
  FlowCase::note(const MonitorRow &row)
  {
    keep(row);
    if (state.parameters.averages.are_wanted())
      average(row);
  }

  void
  FlowCase::keep(const MonitorRow &row)
  {
    rows.push_back(row);
    frame.steady.record(row);
  }

  void
  FlowCase::average(const MonitorRow &row)
  {
    const CostSheet::Scope timing(state.costs, CostSheet::output);
    const double before = rows.size() > 1 ? rows[rows.size() - 2].time - frame.begin : 0.;
    averages.record(row, frame.begin, series.probes);
    if (state.fluid && state.parameters.averages.is_snapshot_due(before, frame.time()))
      files.add_snapshot(
        state.time, number, series.mid_plane.values(fields_of(*state.fluid)));
  }

  void
  FlowCase::end()
  {
    state.progress.finish_phase(strategy->told());
    if (!strategy->is_steady() && frame.velocity &&
        frame.time() < state.parameters.sweep.ramp_time)
      state.progress.say("warning: the case ended while its velocity still ramped up");
    const CostSheet::Scope timing(state.costs, CostSheet::output);
    const double           cpu =
      dealii::Utilities::MPI::sum(state.cpu_seconds() - cpu_start, state.communicator);
    const CaseCourse course{number,
                            frame.velocity,
                            frame.begin,
                            frame.time(),
                            strategy->is_steady() || frame.steady.is_steady(),
                            Progress::steady_seconds() - wall_start,
                            cpu,
                            rows,
                            averages.averaged_time(),
                            averages.statistics()};
    const Moment     last = moment();
    const CaseView   view(last, course);
    CaseResult       result;
    result.values = Values(case_quantities(), view);
    series.results.push_back(result);
    series.last_velocity = frame.velocity.value_or(0.);
    write_results(view, result);
    std::ostringstream text;
    text << "flow " << number << ": " << told(case_quantities(), result.values);
    state.progress.say(text.str());
  }

  void
  FlowCase::write_results(const CaseView &view, const CaseResult &result)
  {
    if (state.fluid)
      {
        files.write_axial(number, view, result);
        files.write_radial(number, view.radial, state.parameters.cylinder.diameter / 2.);
        files.write_mid_plane(number, series.mid_plane.values(fields_of(*state.fluid)));
        files.add_fields(state.time, *state.fluid);
      }
    files.add_particles(state.time, state.dem);
    if (state.parameters.output.force_chains)
      files.add_contacts(state.time, state.dem);
    files.write_cases(series.results);
    if (state.parameters.averages.are_wanted())
      write_averages(view.course.window);
  }

  void
  FlowCase::write_averages(const std::vector<SeriesStatistics> &statistics)
  {
    const AveragesParameters &window = state.parameters.averages;
    if (!window.has_ended(frame.time()))
      {
        std::ostringstream text;
        text << "warning: the case ended after " << frame.time() << " s: means are over "
             << averages.averaged_time() << " s of the window from " << window.from
             << " to " << window.to << " s";
        state.progress.say(text.str());
      }
    files.write_averages(number, averages, statistics);
    if (!state.fluid || state.averages.averaged_time() == 0.)
      return;
    const NodalSpace &nodes = state.fluid->nodes();
    files.add_averages(state.time, nodes, state.averages);
    files.write_mid_plane(
      number,
      series.mid_plane.values({nodes,
                               state.averages.mean(FieldAverages::void_fraction),
                               state.averages.mean(FieldAverages::flux + 2),
                               state.averages.mean(FieldAverages::pressure)}),
      true);
  }

  std::string
  FlowCase::save() const
  {
    SavedCase saved;
    saved.begin        = frame.begin;
    saved.ramp_from    = frame.ramp_from;
    saved.wall_seconds = Progress::steady_seconds() - wall_start;
    saved.cpu_seconds =
      dealii::Utilities::MPI::sum(state.cpu_seconds() - cpu_start, state.communicator);
    for (const MonitorRow &row : rows)
      {
        saved.times.push_back(row.time);
        for (const double value : row.values.numbers())
          saved.values.push_back(value);
      }
    saved.strategy = strategy->save();
    saved.averages = averages.save();
    return to_bytes(saved);
  }

  void
  FlowCase::resume(const std::string &bytes)
  {
    const auto saved = from_bytes<SavedCase>(bytes);
    frame.begin      = saved.begin;
    frame.ramp_from  = saved.ramp_from;
    wall_start -= saved.wall_seconds;
    if (dealii::Utilities::MPI::this_mpi_process(state.communicator) == 0)
      cpu_start -= saved.cpu_seconds;
    strategy->resume(saved.strategy);
    auto value = saved.values.begin();
    for (const double time : saved.times)
      {
        MonitorRow row{time, kind(), number, {}};
        row.values = Values::of_numbers({value, value + monitors().size()});
        value += monitors().size();
        keep(row);
      }
    averages.resume(saved.averages);
    start_progress();
  }
} // namespace graupel
