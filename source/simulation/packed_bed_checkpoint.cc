#include <graupel/simulation/packed_bed.h>

#include <sstream>

namespace graupel
{
  namespace mpi = dealii::Utilities::MPI;

  RunState
  PackedBed::run_state() const
  {
    RunState state;
    state.identity             = identity_of_run(parameters);
    state.time                 = time;
    state.next_output          = next_output;
    state.bed                  = summary.bed;
    state.cases                = summary.cases;
    state.ledger               = summary.ledger;
    state.costs                = summary.costs;
    state.wall_seconds         = Progress::steady_seconds() - started;
    state.cpu_seconds          = mpi::sum(cpu_seconds(), communicator);
    state.costs.particle_steps = mpi::sum(summary.costs.particle_steps, communicator);
    state.costs.contact_steps  = mpi::sum(summary.costs.contact_steps, communicator);
    state.written              = files.written();
    state.has_fluid            = coupled.has_value();
    state.fluid                = coupled ? coupled->fluid().history() : FlowHistory();
    state.in_case              = in_case;
    state.velocity             = case_velocity;
    state.ramp_from            = ramp_from;
    state.case_begin           = case_begin;
    state.case_rows            = case_rows;
    return state;
  }

  void
  PackedBed::save()
  {
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    write_checkpoint(
      files.path("checkpoint"),
      run_state(),
      dem.state(),
      [&](const std::string &file) {
        if (coupled)
          coupled->save(file);
      },
      communicator);
    next_save = Progress::steady_seconds() + 60. * parameters.output.checkpoint_interval;
  }

  void
  PackedBed::save_if_due()
  {
    const bool due = parameters.output.checkpoint_interval > 0. &&
                     Progress::steady_seconds() >= next_save;
    // One clock for all ranks.
    if (mpi::broadcast(communicator, due, 0))
      save();
  }

  void
  PackedBed::fail_with_checkpoint(const SolverFailure &error)
  {
    save();
    throw SolverFailure(
      std::string(error.what()) + " The state before it is in " +
      files.path("checkpoint") +
      ": go on from there with --resume and other values, such as --set \"Flow/time "
      "step=...\".");
  }

  void
  PackedBed::restore()
  {
    const auto [state, particles] =
      read_checkpoint(files.path("checkpoint"), identity_of_run(parameters));
    if (state.has_fluid)
      mesh.load(checkpoint_fields(files.path("checkpoint")));
    dem.restore(particles);

    time           = state.time;
    next_output    = state.next_output;
    next_adaption  = time + parameters.adaption.interval;
    summary.bed    = state.bed;
    summary.cases  = state.cases;
    summary.ledger = state.ledger;
    if (mpi::this_mpi_process(communicator) == 0)
      {
        summary.costs = state.costs;
        cpu_before    = state.cpu_seconds;
      }
    summary.costs.fluid_steps = state.costs.fluid_steps;
    started -= state.wall_seconds;
    files.continue_from(state.written, time);
    next_save = Progress::steady_seconds() + 60. * parameters.output.checkpoint_interval;

    std::ostringstream text;
    text << "resumed at " << time << " s, " << dem.n_global() << " particles, "
         << summary.cases.size() << " flow case(s) done";
    progress.say(text.str());
    if (!state.has_fluid)
      return;
    coupled.emplace(
      parameters, summary.bed.original_solid_ratio, mesh, dem, summary.costs);
    coupled->set_superficial_velocity(state.velocity);
    coupled->load(state.fluid);
    if (!state.in_case)
      return;
    begin_case(state.velocity);
    case_begin = state.case_begin;
    ramp_from  = state.ramp_from;
    for (const MonitorRow &row : state.case_rows)
      {
        case_rows.push_back(row);
        steady.record(row);
      }
  }

  void
  PackedBed::take_bed()
  {
    const std::string file = parameters.filling.start_from + "/bed.bin";
    dem.restore(read_bed(file, identity_of_bed(parameters)));
    progress.say("the settled bed is taken from " + file);
  }
} // namespace graupel
