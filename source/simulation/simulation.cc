// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/simulation/observers/wall_forces.h>
#include <graupel/simulation/parameters/run_size.h>
#include <graupel/simulation/parameters/step_limits.h>
#include <graupel/simulation/phases/original_bed.h>
#include <graupel/simulation/phases/packing_phases.h>
#include <graupel/simulation/simulation.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>

#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    // Simulated time between two rows of monitors.csv while the bed is packed [s].
    constexpr double packing_observation = 1e-2;

    // Three of flux and one of pressure at each node.
    unsigned long
    n_unknowns(const VesselMesh &mesh)
    {
      dealii::DoFHandler<3> dofs(mesh.triangulation());
      dofs.distribute_dofs(dealii::FE_Q<3>(1));
      return 4ul * dofs.n_dofs();
    }

    // What the run will be and cost, by the estimate of --check.
    std::string
    describe_size(const RunSize &size, const unsigned int n_ranks)
    {
      return "expected, within a factor of two or three: " + text_of(size.particles) +
             " particles, " + text_of(1e-9 * size.memory + memory_of_rank * n_ranks, 3) +
             " GB of memory, " + text_of(1e-9 * size.disk, 3) + " GB on the disk, " +
             (size.cases_may_end ? "at most " : "") + spoken_duration(size.cpu_seconds) +
             " of CPU time";
    }

    // Tells the height of the bed, its void fraction and how it is supported.
    std::string
    describe_bed(const BedResult &bed, const Dem &dem)
    {
      std::ostringstream text;
      text << std::setprecision(4) << "bed: " << bed.particle_count << " particles";
      if (bed.particle_count > 0)
        text << " of " << bed.particle_diameter * 1e3 << " mm, "
             << bed.mean_coordination_number << " contacts each";
      if (bed.height)
        text << ", height " << *bed.height * 1e3 << " mm, mean void fraction "
             << *bed.mean_void_fraction;
      if (dem.weight() > 0.)
        // A negative nothing is nothing.
        text << "; bottom " << dem.bottom_force() + 0. << " N + wall "
             << dem.wall_force() + 0. << " N of " << dem.supported_weight()
             << " N that all walls carry = "
             << dem.supported_weight() / dem.weight() * 100. << " % of the weight";
      return text.str();
    }
  } // namespace

  Simulation::Simulation(const RunParameters &parameters,
                         const std::string   &parameter_file,
                         ResultFiles         &files,
                         Progress            &progress,
                         MPI_Comm             communicator)
    : state(parameters, summary.costs, progress, communicator)
    , files(files)
    , series{Feeds(parameters.feeds, state.dem),
             Probes(read_probes(parameters.output.probes)),
             MidPlane(state.mesh, parameters.output.midplane_points),
             {},
             0.,
             false}
    , next_output(parameters.output.interval)
    , started(Progress::steady_seconds())
  {
    summary.parameter_file = parameter_file;
    summary.reference      = parameters.output.reference;
    summary.fluid          = parameters.fluid;
    if (!parameters.filling.start_from.empty())
      given_bed =
        read_bed(parameters.filling.start_from + "/bed.bin", parameters, communicator);
  }

  void
  Simulation::run()
  {
    std::ostringstream mesh_line;
    mesh_line << "mesh: " << state.mesh.triangulation().n_global_active_cells()
              << " cells";
    if (state.parameters.sweep.has_fluid())
      mesh_line << ", " << n_unknowns(state.mesh) << " unknowns of the flow";
    state.progress.say(mesh_line.str());
    const RunSize size = expected_size(state.parameters);
    state.progress.say(describe_size(size, mpi::n_mpi_processes(state.communicator)));
    if (const std::string difference = state.dem.vessel_shape().difference();
        !difference.empty())
      state.progress.say("warning: " + difference);
    for (const std::string &warning : warnings(state.parameters))
      state.progress.say("warning: " + warning);
    for (const std::string &note : notes(state.parameters))
      state.progress.say("note: " + note);
    warn_of_disk(size.disk);
    if (checkpoint)
      go_on_from(checkpoint->state);
    while (phase_number < n_phases())
      run_phase(*make_phase(phase_number));
    write_summary_file();
  }

  std::size_t
  Simulation::n_phases() const
  {
    return first_flow_phase + state.parameters.sweep.cases().size();
  }

  std::unique_ptr<Phase>
  Simulation::make_phase(const std::size_t number)
  {
    const RunParameters &parameters = state.parameters;
    if (number == 0 && given_bed)
      return std::make_unique<TakingBed>(*given_bed, state);
    if (number == 0)
      return std::make_unique<FillingPhase>(parameters.filling, state);
    if (number == 1)
      return std::make_unique<SettlingPhase>(parameters.settling, state);
    const auto flow_case = static_cast<unsigned int>(number - first_flow_phase + 1);
    return std::make_unique<FlowCase>(
      flow_case, parameters.sweep.cases()[flow_case - 1], state, series, files);
  }

  void
  Simulation::run_phase(Phase &phase)
  {
    if (checkpoint && !checkpoint->state.phase.empty())
      phase.resume(checkpoint->state.phase);
    else
      phase.begin();
    checkpoint.reset();
    phase_now = &phase;
    for (bool goes_on = true;;)
      {
        step_or_fail(phase, goes_on);
        if (!goes_on)
          break;
        observe(phase);
        save_or_stop();
      }
    phase_now = nullptr;
    phase.end();
    ++phase_number;
    if (phase_number == first_flow_phase)
      present_bed();
    save();
  }

  void
  Simulation::warn_of_disk(const double needed) const
  {
    const double room = room_on_disk(files.path("log.txt"), state.communicator);
    if (needed > room)
      state.progress.say(
        "warning: Output/directory = " + state.parameters.output.directory +
        " has room for " + text_of(1e-9 * room, 3) + " GB, and the run may write " +
        text_of(1e-9 * needed, 3) +
        " GB. Take another disk, or a longer Output/interval");
  }

  void
  Simulation::step_or_fail(Phase &phase, bool &goes_on)
  {
    const std::string where =
      std::string(phase.kind()) + ", step from " + text_of(state.time) + " s: ";
    try
      {
        goes_on = phase.step();
      }
    catch (const SolverFailure &error)
      {
        save();
        throw SolverFailure(
          where + error.what() + " The state before it is in " +
          files.path("checkpoint") +
          ": go on from there with --resume and other values, such as --set \"Flow/time "
          "step=...\".");
      }
    catch (const DemError &error)
      {
        // The particles have moved: their state is not one to go on from.
        throw DemError(where + error.what() +
                       (last_save
                          ? " The last checkpoint, of " + text_of(*last_save) +
                              " s, is in " + files.path("checkpoint") +
                              ": --resume goes on from there, also with other values."
                          : std::string()));
      }
  }

  void
  Simulation::observe(Phase &phase)
  {
    const bool is_flow = phase.flow_case() > 0;
    if (!is_flow && state.time < next_observation)
      return;
    next_observation = state.time + packing_observation;
    MonitorRow row{state.time, phase.kind(), phase.flow_case(), {}};
    {
      const CostSheet::Scope timing(summary.costs, CostSheet::output);
      row.values = Values(monitors(), phase.moment());
      files.add_monitor(row);
      files.add_wall_forces(wall_forces_header(state), wall_forces_row(state));
      if (state.fluid && series.probes.are_wanted())
        {
          series.probes.look(state);
          files.add_probes(series.probes.header(), series.probes.row(state.time));
        }
    }
    phase.note(row);
    if (is_flow)
      write_fields_if_due();
  }

  void
  Simulation::present_bed()
  {
    state.dem.synchronise();
    const auto bed                = state.bed();
    BedResult &rest               = state.rest;
    rest.particle_count           = state.dem.n_global();
    rest.particle_diameter        = state.parameters.simulated_diameter();
    rest.original_diameter        = state.dem.original_sauter_diameter();
    rest.scale                    = state.parameters.dem.particles.scale;
    rest.solid_volume             = state.dem.solid_volume();
    rest.mean_coordination_number = state.dem.coordination_number();
    rest.vessel_diameter          = state.parameters.cylinder.diameter;
    rest.vessel_height            = state.parameters.cylinder.height;
    if (bed.exists)
      {
        rest.bottom             = bed.bottom;
        rest.height             = bed.height;
        rest.mean_void_fraction = bed.mean_void_fraction;
      }
    state.progress.say(describe_bed(rest, state.dem));
    std::optional<OriginalPacking> packing;
    if (const auto scale = state.parameters.common_scale())
      packing = packing_of_smaller(state.dem, bed, rest.particle_diameter, *scale);
    if (packing)
      rest.original_void_fraction = packing->mean_void_fraction;
    if (state.parameters.sweep.has_fluid())
      rest.original_solid_ratio = original_solid_ratio(state.parameters,
                                                       bed,
                                                       packing,
                                                       state.progress,
                                                       summary.costs,
                                                       state.communicator);
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    write_bed(
      files.path("bed.bin"), state.parameters, state.dem.state(), state.communicator);
    files.add_particles(state.time, state.dem);
    if (bed.exists)
      files.write_bed(
        bed_profiles(state.dem, bed, state.parameters.simulated_diameter()));
    if (state.parameters.output.force_chains)
      files.add_contacts(state.time, state.dem);
  }

  void
  Simulation::write_fields_if_due()
  {
    if (state.parameters.output.interval <= 0. || state.time < next_output)
      return;
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    if (state.fluid)
      files.add_fields(state.time, *state.fluid);
    if (state.fluid && state.averages.averaged_time() > 0.)
      files.add_averages(state.time, state.fluid->nodes(), state.averages);
    files.add_particles(state.time, state.dem);
    next_output = state.time + state.parameters.output.interval;
  }

  void
  Simulation::write_summary_file()
  {
    summary.bed          = state.rest;
    summary.cases        = series.results;
    summary.ledger       = state.ledger;
    summary.wall_seconds = Progress::steady_seconds() - started;
    summary.cpu_seconds  = state.cpu_seconds();
    summary.cells        = state.mesh.triangulation().n_global_active_cells();
    summary.volume = state.mesh.mean_cross_section() * state.parameters.cylinder.height;
    files.check_log();
    write_summary(files.path("summary.json"), summary, state.communicator);
  }
} // namespace graupel
