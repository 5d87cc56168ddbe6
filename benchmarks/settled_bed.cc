// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

// Cost of the particles' substep on a bed from a file: time and memory, and the
// forces and contacts that show what was computed.

#include "bed_file.h"

#include <graupel/dem/dem.h>
#include <graupel/dem/particles/dem_error.h>

#include <CLI/CLI.hpp>
#include <sys/resource.h>

#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>

using namespace graupel;
namespace mpi = dealii::Utilities::MPI;

namespace
{
  struct Options
  {
    std::string  bed, write_bed;
    std::string  rolling     = "spring-dashpot";
    double       velocity    = 0.;
    unsigned int warm_up     = 3000;
    unsigned int steps       = 2000;
    unsigned int synchronise = 0;
    unsigned int copies      = 1;
    double       cell_size   = 3.2e-3;
    double       rayleigh    = 0.2;
    double       skin        = 0.25;
  };

  // What the timed part cost, over all ranks.
  struct Cost
  {
    double        wall          = 0.; // of the slowest rank [s]
    double        cpu           = 0.; // of the rank that used most [s]
    std::uint64_t contact_steps = 0;
    unsigned int  list_builds   = 0;
  };

  void
  add_options(CLI::App &app, Options &o)
  {
    app
      .add_option(
        "--bed", o.bed, "One sphere a line, \"x y z radius\" [m]; may end in .gz")
      ->required()
      ->check(CLI::ExistingFile);
    app.add_option("--write-bed",
                   o.write_bed,
                   "Write the bed, with its copies, to this file, and stop");
    app.add_option("--velocity", o.velocity, "Upward velocity at the start [m/s]");
    app.add_option("--warm-up", o.warm_up, "Steps before the timed ones");
    app.add_option("--steps", o.steps, "Timed steps")->check(CLI::PositiveNumber);
    app.add_option("--synchronise",
                   o.synchronise,
                   "Steps between two sorts of the particles into the cells of the mesh, "
                   "as a step of the fluid brings one; 0: no sort");
    app.add_option("--copies", o.copies, "Stack the bed this many times above itself")
      ->check(CLI::PositiveNumber);
    app
      .add_option("--rolling", o.rolling, "Resistance to rolling, as in a parameter file")
      ->check(CLI::IsMember({"spring-dashpot", "constant-torque", "none"}));
    app.add_option("--cell-size", o.cell_size, "Edge length of the cells [m]");
    app.add_option("--rayleigh", o.rayleigh, "Step over the Rayleigh time");
    app.add_option("--skin", o.skin, "Skin of the neighbour list over the diameter");
    for (auto *option : app.get_options())
      option->capture_default_str();
  }

  void
  write_bed(const Bed &bed, const std::string &name)
  {
    std::ofstream file(name);
    file << std::setprecision(17);
    bed.visit_all(
      [&](const auto &center) { file << center << ' ' << bed.radius << '\n'; });
    if (!file.flush())
      throw std::runtime_error(name + " could not be written");
  }

  // The physics of the comparison with LIGGGHTS, named here in full so that no
  // change of a default changes it.
  DemParameters
  parameters_for(const Bed &bed, const Options &options)
  {
    DemParameters parameters;
    parameters.particles.diameter          = 2. * bed.radius;
    parameters.particles.scale             = 1.;
    parameters.particles.density           = 2700.;
    parameters.particles.gravity           = 9.81;
    parameters.contact.model               = "hertz-mindlin";
    parameters.contact.rolling_model       = options.rolling;
    parameters.contact.particle_elasticity = {1e7, 0.33};
    parameters.contact.wall_elasticity     = {1e7, 0.33};
    parameters.contact.particle_surface    = {0.5, 0.5, 0.1};
    parameters.contact.wall_surface        = {0.5, 0.5, 0.1};
    parameters.contact.time_fraction       = options.rayleigh;
    parameters.contact.substep             = 0.;
    parameters.contact.skin                = options.skin;
    return parameters;
  }

  void
  insert(Dem &dem, const Bed &bed, const double upward)
  {
    const dealii::Tensor<1, 3> velocity({0., 0., upward});
    Dem::Batch                 batch(dem);
    bed.visit_all([&](const auto &center) { batch.add({center, bed.radius, velocity}); });
    dem.insert(batch);
  }

  void
  advance(Dem &dem, const unsigned int steps, const unsigned int synchronise)
  {
    for (unsigned int done = 0; done < steps;)
      {
        const unsigned int now =
          synchronise > 0 ? std::min(synchronise, steps - done) : steps - done;
        if (synchronise > 0)
          dem.synchronise();
        dem.advance(now * dem.substep());
        done += now;
      }
  }

  Cost
  timed(Dem &dem, const CostSheet &costs, const Options &options)
  {
    const auto contact_steps = costs.contact_steps;
    const auto list_builds   = dem.n_list_builds();
    MPI_Barrier(dem.communicator());
    const auto cpu  = std::clock();
    const auto wall = std::chrono::steady_clock::now();
    advance(dem, options.steps, options.synchronise);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - wall;
    const double cpu_seconds = 1. * (std::clock() - cpu) / CLOCKS_PER_SEC;

    return {mpi::max(seconds.count(), dem.communicator()),
            mpi::max(cpu_seconds, dem.communicator()),
            mpi::sum(costs.contact_steps - contact_steps, dem.communicator()),
            dem.n_list_builds() - list_builds};
  }

  unsigned int
  n_wall_contacts(const Dem &dem)
  {
    const auto  &p        = dem.particles();
    const double tube     = dem.cylinder().diameter / 2.;
    unsigned int contacts = 0;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const dealii::Point<3> center(p.body[i].position);
        contacts += std::hypot(center[0], center[1]) + p.body[i].radius > tube;
        contacts += center[2] < p.body[i].radius;
      }
    return mpi::sum(contacts, dem.communicator());
  }

  // Largest memory that a rank has held so far [bytes].
  mpi::MinMaxAvg
  peak_memory()
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return mpi::min_max_avg(1024. * usage.ru_maxrss, MPI_COMM_WORLD);
  }

  void
  print(const Dem &dem, const Cost &cost, const unsigned int steps, const double baseline)
  {
    const double n           = dem.n_global();
    const double pairs       = 0.5 * n * dem.coordination_number();
    const double wall_pairs  = n_wall_contacts(dem);
    const double speed       = dem.maximum_speed();
    const auto   peak        = peak_memory();
    const double step_ns     = 1e9 * cost.wall / (n * steps);
    const double step_cpu_ns = 1e9 * cost.cpu / (n * steps);
    const double bottom = dem.bottom_force(), wall = dem.wall_force();
    if (mpi::this_mpi_process(dem.communicator()) != 0)
      return;

    const auto line =
      [](const char *name, const double value, const char *unit, const char *note = "") {
        std::cout << std::left << std::setw(32) << name << ' ' << value << ' ' << unit
                  << note << '\n';
      };
    line("ranks", mpi::n_mpi_processes(dem.communicator()), "");
    line("particles", n, "");
    line("contacts per particle", pairs / n, "", "(each counted once)");
    line("wall contacts per particle", wall_pairs / n, "");
    line("largest speed", speed, "m/s");
    line("bottom force", bottom, "N");
    line("wall force", wall, "N");
    line("bottom + wall over weight", (bottom + wall) / dem.weight(), "");
    line("steps", steps, "");
    line("list rebuilds", cost.list_builds, "");
    line("wall-clock per contact-step", 1e9 * cost.wall / cost.contact_steps, "ns");
    line("CPU per contact-step", 1e9 * cost.cpu / cost.contact_steps, "ns");
    line("wall-clock per particle-step", step_ns, "ns");
    line("CPU per particle-step", step_cpu_ns, "ns");
    line("peak memory", 1e-6 * peak.sum, "MB", " (libraries and mesh included)");
    line("peak memory of a rank, mean", 1e-6 * peak.avg, "MB");
    line("peak memory of a rank, most", 1e-6 * peak.max, "MB");
    line("peak memory per particle",
         (peak.sum - baseline) / n,
         "B",
         " (beyond that before the bed was inserted)");
    std::cout << "particle-step " << step_ns << std::endl;
  }

  void
  run(const Options &options)
  {
    Bed bed = read_bed(options.bed);
    stack(bed, options.copies);
    const bool first      = mpi::this_mpi_process(MPI_COMM_WORLD) == 0;
    const auto parameters = parameters_for(bed, options);
    if (first)
      std::cout << std::left << std::setw(32) << "substep" << ' ' << std::setprecision(17)
                << parameters.substep() << " s\n"
                << std::setprecision(6);
    if (!options.write_bed.empty())
      {
        if (first)
          write_bed(bed, options.write_bed);
        return;
      }

    // Room above the bed: a lid would carry load.
    const Cylinder cylinder{0.025, top_of(bed) + 4. * bed.radius};
    VesselMesh     mesh(cylinder, {options.cell_size}, MPI_COMM_WORLD);
    CostSheet      costs;
    Dem            dem(parameters, mesh, costs);
    const double   baseline = peak_memory().sum;
    insert(dem, bed, options.velocity);

    advance(dem, options.warm_up, options.synchronise);
    const Cost cost = timed(dem, costs, options);
    // Loads are means of a call, and LIGGGHTS tells those of one step.
    dem.advance(dem.substep());
    print(dem, cost, options.steps, baseline);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
  Options                                  options;
  CLI::App app("Cost of the particles' substep on a bed from a file");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try
    {
      run(options);
    }
  catch (const std::exception &error)
    {
      std::cerr << "benchmark_settled_bed: " << error.what() << std::endl;
      return 1;
    }
}
