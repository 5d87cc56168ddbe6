// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/base/parameters.h>
#include <graupel/base/stop_request.h>
#include <graupel/simulation/simulation.h>
#include <graupel/simulation/state/bytes.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cstring>
#include <numeric>
#include <sstream>

namespace graupel
{
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    // Of the time that a step and a checkpoint have taken so far, room for them before
    // the time limit [-].
    constexpr double room_to_stop = 2.;

    // What p4est's file has at most, beside what is attached to cells [bytes].
    constexpr std::uint64_t of_a_rank = 16384, of_a_cell = 128;

    // At most, of the mesh and what is attached to it [bytes].
    std::uint64_t
    size_of_fields(const VesselMesh::CellBytes &bytes)
    {
      return std::accumulate(bytes.begin(),
                             bytes.end(),
                             of_a_rank,
                             [](const std::uint64_t n, const auto &cell) {
                               return n + cell.size() + of_a_cell;
                             });
    }
  } // namespace

  void
  Simulation::set_time_limit(const double seconds)
  {
    stop_at = Progress::steady_seconds() + seconds;
  }

  void
  Simulation::resume()
  {
    checkpoint =
      read_checkpoint(files.path("checkpoint"), state.parameters, state.communicator);
    check_cases(checkpoint->state);
  }

  void
  Simulation::check_cases(const RunState &saved) const
  {
    const auto        velocities = state.parameters.sweep.cases();
    const std::string parameter  = "Flow/superficial velocities";
    const auto        expect     = [&](const std::size_t n, const Value &there) {
      const bool         is_same = n < velocities.size() && velocities[n] == there;
      std::ostringstream text;
      text << "case " << n + 1 << " of the checkpoint "
           << (n < saved.cases.size() ? "has ended" : "is under way") << " with ";
      if (there)
        text << *there << " m/s";
      else
        text << "no fluid";
      text << "; keep it in its place, or begin anew without --resume";
      require(is_same, parameter, text.str());
    };
    for (std::size_t n = 0; n < saved.cases.size(); ++n)
      expect(n, saved.cases[n]["nominal_velocity"]);
    if (saved.phase_number >= first_flow_phase && !saved.phase.empty())
      expect(saved.cases.size(), saved.velocity);
  }

  RunState
  Simulation::run_state() const
  {
    RunState saved;
    saved.parameters       = state.parameters.texts;
    saved.time             = state.time;
    saved.next_output      = next_output;
    saved.next_observation = next_observation;
    saved.next_adaption    = state.next_adaption;
    saved.rest             = state.rest;
    saved.cases            = series.results;
    saved.last_velocity    = series.last_velocity;
    saved.has_begun        = series.has_begun;
    saved.feeds            = to_bytes(series.feeds.state());
    saved.ledger           = state.ledger;
    saved.costs            = summary.costs;
    saved.wall_seconds     = Progress::steady_seconds() - started;
    saved.cpu_seconds      = mpi::sum(state.cpu_seconds(), state.communicator);
    saved.costs.particle_steps =
      mpi::sum(summary.costs.particle_steps, state.communicator);
    saved.costs.contact_steps = mpi::sum(summary.costs.contact_steps, state.communicator);
    saved.written             = files.written();
    saved.has_fluid           = state.fluid.has_value();
    if (state.fluid)
      {
        saved.fluid         = state.fluid->fluid().history();
        saved.stable_step   = state.fluid->stable_step();
        saved.averaged_time = state.averages.averaged_time();
        saved.partition     = state.mesh.partition();
      }
    saved.phase_number = phase_number;
    if (phase_now != nullptr)
      saved.phase = phase_now->save();
    if (phase_number >= first_flow_phase && phase_number < n_phases())
      saved.velocity = state.parameters.sweep.cases()[phase_number - first_flow_phase];
    return saved;
  }

  void
  Simulation::save()
  {
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    const double           begin = Progress::steady_seconds();
    files.check_log();
    write_checkpoint(
      files.path("checkpoint"),
      run_state(),
      state.dem.state(),
      [&](const std::string &file) {
        if (!state.fluid)
          return;
        auto bytes = state.fluid->fluid().cell_bytes();
        state.averages.append(state.fluid->nodes(), bytes);
        require_room(file, size_of_fields(bytes), state.communicator);
        state.mesh.save(file, bytes);
      },
      state.communicator);
    last_save        = state.time;
    const double now = Progress::steady_seconds();
    save_seconds     = now - begin;
    last_look        = now;
    next_save        = now + 60. * state.parameters.output.checkpoint_interval;
  }

  void
  Simulation::save_or_stop()
  {
    const double minutes = state.parameters.output.checkpoint_interval,
                 now     = Progress::steady_seconds();
    if (next_save == 0.)
      next_save = started + 60. * minutes;
    if (last_look > 0.)
      longest_step = std::max(longest_step, now - last_look);
    last_look           = now;
    const bool is_clock = mpi::this_mpi_process(state.communicator) == 0;
    const bool is_due   = is_clock && minutes > 0. && now >= next_save;
    const bool is_late =
      is_clock && now + room_to_stop * (longest_step + save_seconds) >= stop_at;
    // A signal may have reached any of the ranks.
    std::vector<int> asked{is_due, is_late, noted_signal()};
    mpi::max(asked, state.communicator, asked);
    if (asked[1] != 0 || asked[2] != 0)
      stop(asked[2]);
    else if (asked[0] != 0)
      save();
  }

  void
  Simulation::stop(const int signal)
  {
    save();
    const std::string why =
      signal != 0
        ? std::string("as it was asked to by a signal (") + strsignal(signal) + ")"
        : std::string("before its time limit");
    const std::string text = "stopped at " + std::to_string(state.time) + " s, " + why +
                             "; the state is in " + files.path("checkpoint") +
                             ": go on from there with --resume";
    state.progress.say(text);
    throw Stopped(text);
  }

  void
  Simulation::go_on_from(const RunState &saved)
  {
    VesselMesh::CellBytes bytes;
    if (saved.has_fluid)
      bytes = state.mesh.load(checkpoint_fields(checkpoint->folder), saved.partition);
    state.dem.restore(checkpoint->particles);

    state.time           = saved.time;
    last_save            = saved.time;
    next_output          = saved.next_output;
    next_observation     = saved.next_observation;
    state.next_adaption  = saved.next_adaption;
    state.rest           = saved.rest;
    series.results       = saved.cases;
    series.last_velocity = saved.last_velocity;
    series.has_begun     = saved.has_begun;
    series.feeds.restore(from_bytes<Feeds::State>(saved.feeds));
    state.ledger = saved.ledger;
    phase_number = saved.phase_number;
    if (mpi::this_mpi_process(state.communicator) == 0)
      {
        summary.costs    = saved.costs;
        state.cpu_before = saved.cpu_seconds;
      }
    summary.costs.fluid_steps = saved.costs.fluid_steps;
    started -= saved.wall_seconds;
    files.continue_from(saved.written, state.time);
    next_save =
      Progress::steady_seconds() + 60. * state.parameters.output.checkpoint_interval;
    if (saved.has_fluid)
      {
        state.make_fluid();
        state.averages.load(state.fluid->nodes(), saved.averaged_time, bytes);
        state.fluid->load(saved.fluid, bytes, saved.stable_step);
      }
    std::ostringstream text;
    text << "resumed at " << state.time << " s, " << state.dem.n_global()
         << " particles, " << series.results.size() << " flow case(s) done";
    state.progress.say(text.str());
    for (const std::string &text : checkpoint->told)
      state.progress.say(text);
  }
} // namespace graupel
