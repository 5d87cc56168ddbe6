// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

// What the ranks send each other: messages, bytes and collectives of a substep of the
// particles and of a step of the fluid, in a settled bed with flow.
//
//   mpirun -np 4 benchmark_communication --bed benchmarks/beds/settled-1.6mm.txt.gz

#include "bed_file.h"

#include <graupel/simulation/state/simulation_state.h>

#include "../tests/mpi_counts.h"

#include <CLI/CLI.hpp>

#include <iomanip>
#include <iostream>

using namespace graupel;
namespace mpi = dealii::Utilities::MPI;

namespace
{
  constexpr double velocity = 0.3; // [m/s]

  struct Options
  {
    std::string  bed;
    unsigned int copies    = 1;
    unsigned int warm_up   = 3000;
    unsigned int substeps  = 200;
    unsigned int steps     = 3;
    double       time_step = 1e-3;
    double       cell_size = 3.2e-3;
  };

  void
  add_options(CLI::App &app, Options &o)
  {
    app.add_option("--bed", o.bed, "One sphere a line, \"x y z radius\" [m]")
      ->required()
      ->check(CLI::ExistingFile);
    app.add_option("--copies", o.copies, "Stack the bed this many times above itself")
      ->check(CLI::PositiveNumber);
    app.add_option("--warm-up", o.warm_up, "Substeps before the counted ones");
    app.add_option("--substeps", o.substeps, "Counted substeps")
      ->check(CLI::PositiveNumber);
    app.add_option("--steps", o.steps, "Counted steps of the fluid")
      ->check(CLI::PositiveNumber);
    app.add_option("--time-step", o.time_step, "Step of the fluid [s]");
    app.add_option("--cell-size", o.cell_size, "Edge length of the cells [m]");
    for (auto *option : app.get_options())
      option->capture_default_str();
  }

  RunParameters
  parameters_for(const Bed &bed, const Options &options)
  {
    RunParameters parameters;
    parameters.cylinder               = {0.025, top_of(bed) + 4. * bed.radius};
    parameters.mesh.cell_size         = options.cell_size;
    parameters.dem.particles.diameter = 2. * bed.radius;
    return parameters;
  }

  template <class Work>
  MpiCounts
  counted(const Work &work)
  {
    const MpiCounts before = mpi_counts();
    work();
    return mpi_counts() - before;
  }

  // One line a kind: the means over all ranks, and the most of any rank.
  void
  print(const std::string &what, MpiCounts counts, MPI_Comm communicator)
  {
    std::set<std::string>    kinds;
    std::vector<std::string> mine;
    for (const auto &[kind, count] : counts)
      mine.push_back(kind);
    for (const auto &of_rank : mpi::all_gather(communicator, mine))
      kinds.insert(of_rank.begin(), of_rank.end());
    const bool first = mpi::this_mpi_process(communicator) == 0;
    for (const auto &kind : kinds)
      {
        const auto calls = mpi::min_max_avg(counts[kind].calls, communicator);
        const auto bytes = mpi::min_max_avg(counts[kind].bytes, communicator);
        if (first && calls.max > 0.)
          std::cout << "| " << mpi::n_mpi_processes(communicator) << " | " << what
                    << " | " << kind << " | " << calls.avg << " | " << calls.max << " | "
                    << bytes.avg << " | " << bytes.max << " |\n";
      }
  }

  void
  run(const Options &options)
  {
    Bed bed = read_bed(options.bed);
    stack(bed, options.copies);
    const RunParameters parameters = parameters_for(bed, options);
    CostSheet           costs;
    Progress            progress;
    SimulationState     state(parameters, costs, progress, MPI_COMM_WORLD);
    Dem                &dem = state.dem;
    Dem::Batch          batch(dem);
    bed.visit_all([&](const auto &center) { batch.add({center, bed.radius}); });
    dem.insert(batch);
    const double substep = dem.substep();
    dem.advance(options.warm_up * substep);
    state.rest.original_diameter    = parameters.dem.particles.diameter;
    state.rest.original_solid_ratio = 1.;
    state.start_fluid();
    CoupledFlow &flow = *state.fluid;
    flow.set_superficial_velocity(velocity);
    flow.step(options.time_step);
    flow.move_particles(options.time_step);

    const auto substeps = [&](const unsigned int n) {
      return counted([&] { dem.advance(n * substep); });
    };
    const unsigned int builds     = dem.n_list_builds();
    const MpiCounts    one        = substeps(1);
    const MpiCounts    many       = substeps(1 + options.substeps);
    const MpiCounts    sort       = counted([&] { dem.synchronise(); });
    const MpiCounts    coupled    = counted([&] {
      for (unsigned int k = 0; k < options.steps; ++k)
        {
          flow.step(options.time_step);
          dem.advance(substep);
        }
    });
    const MpiCounts    of_substep = (1. / options.substeps) * (many - one);
    const double       ghosts =
      mpi::sum(1. * (dem.particles().n_rows() - dem.particles().n_owned), MPI_COMM_WORLD);
    const unsigned int n_ranks  = mpi::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int n_builds = mpi::max(dem.n_list_builds() - builds, MPI_COMM_WORLD);
    if (mpi::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << dem.n_global() << " particles on " << n_ranks << " ranks, "
                << state.mesh.triangulation().n_global_active_cells() << " cells, "
                << ghosts / n_ranks << " ghosts a rank, " << n_builds
                << " lists built meanwhile\n\n"
                << "| ranks | of what | kind | calls a rank | most | bytes a rank | most "
                   "|\n| --- | --- | --- | --- | --- | --- | --- |\n";
    print("substep", of_substep, MPI_COMM_WORLD);
    print("begin and end of the substeps", one - of_substep, MPI_COMM_WORLD);
    print("sort into cells", sort, MPI_COMM_WORLD);
    print(
      "step of the fluid", (1. / options.steps) * coupled - sort - one, MPI_COMM_WORLD);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
  Options                                  options;
  CLI::App app("Messages and collectives of a substep and of a step of the fluid");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try
    {
      run(options);
    }
  catch (const std::exception &error)
    {
      std::cerr << "benchmark_communication: " << error.what() << std::endl;
      return 1;
    }
}
