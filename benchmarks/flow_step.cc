// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

// CPU time of a step of the fluid against the number of cells: a bed that rests
// in the lower nine tenths of the vessel of Ricklick & Baran, with a void fraction
// that varies from place to place as in a packing, and gas through it.
//
//   benchmark_flow_step --cell-size 2.3e-3 --steps 10

#include <graupel/base/progress.h>
#include <graupel/closures/bed_correlations.h>
#include <graupel/fluid/flow_solver.h>

#include <CLI/CLI.hpp>
#include <deal.II/base/mpi.h>

#include <ctime>
#include <iostream>

using namespace graupel;

namespace
{
  constexpr double diameter = 1.6e-3;
  const Cylinder   vessel{0.025, 0.169};

  double
  void_fraction(const dealii::Point<3> &x)
  {
    const double wave = 2. * dealii::numbers::PI / (4. * diameter);
    const double solid =
      0.6 + 0.05 * std::sin(wave * x[0]) * std::sin(wave * x[1]) * std::sin(wave * x[2]);
    return 1. - 0.5 * solid * (1. - std::tanh((x[2] - 0.152) / (2. * diameter)));
  }

  // A resting bed with the drag of Ergun's equation (model A) at the superficial
  // velocity @p velocity.
  void
  fill(Medium                &medium,
       const NodalSpace      &nodes,
       const FluidProperties &gas,
       const double           velocity)
  {
    const auto &partitioner = *nodes.measure().get_partitioner();
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          if (const auto dof = cell->vertex_dof_index(v, 0);
              partitioner.in_local_range(dof))
            {
              const double alpha        = void_fraction(cell->vertex(v));
              medium.void_fraction(dof) = alpha;
              medium.drag(dof) =
                alpha > 0.999 ? 0.
                              : ergun_pressure_gradient(gas, diameter, alpha, velocity) *
                                  alpha * alpha / velocity;
            }
    medium.void_fraction.update_ghost_values();
    medium.drag.update_ghost_values();
  }

  double
  cpu_seconds()
  {
    return dealii::Utilities::MPI::sum(static_cast<double>(std::clock()) / CLOCKS_PER_SEC,
                                       MPI_COMM_WORLD);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  CLI::App                                 app("CPU time of a step of the fluid");
  std::vector<double>                      cell_sizes{2.3e-3};
  unsigned int                             n_steps = 10;
  double                                   step = 1e-3, velocity = 0.4;
  FlowParameters                           parameters;
  app.add_option("--cell-size", cell_sizes, "Cells of these sizes [m]");
  app.add_option("--steps", n_steps, "Steps that are measured, after three others");
  app.add_option("--step", step, "Time step [s]");
  app.add_option("--velocity", velocity, "Superficial velocity [m/s]");
  app.add_option("--tolerance", parameters.linear_tolerance, "Linear tolerance [-]");
  CLI11_PARSE(app, argc, argv);

  const bool first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  if (first)
    std::cout << "ranks cells pairs_of_nodes wall[s/step] cpu[s/step] cpu[us/cell/step] "
                 "iterations "
                 "mass_imbalance pressure_drop[Pa]"
              << std::endl;
  const FluidProperties gas;
  for (const double cell_size : cell_sizes)
    {
      CostSheet        costs;
      const VesselMesh mesh(vessel, {cell_size}, MPI_COMM_WORLD);
      const NodalSpace nodes(mesh);
      FlowSolver       flow(parameters, gas.density, gas.viscosity, nodes, costs);
      Medium           medium(nodes);
      fill(medium, nodes, gas, velocity);
      flow.set_superficial_velocity(velocity);
      for (unsigned int n = 0; n < 3; ++n)
        flow.step(medium, step);
      double       imbalance  = 0.;
      unsigned int iterations = 0;
      const double cpu = cpu_seconds(), wall = Progress::steady_seconds();
      for (unsigned int n = 0; n < n_steps; ++n)
        {
          const auto report = flow.step(medium, step);
          iterations += report.iterations;
          imbalance = std::max(imbalance, report.mass_imbalance);
        }
      const double wall_step = (Progress::steady_seconds() - wall) / n_steps,
                   cpu_step  = (cpu_seconds() - cpu) / n_steps,
                   drop      = flow.mean_pressure(VesselMesh::bottom) -
                          flow.mean_pressure(VesselMesh::top);
      const auto n_cells = mesh.triangulation().n_global_active_cells();
      if (first)
        std::cout << dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) << " "
                  << n_cells << " " << nodes.coupling_pattern.n_nonzero_elements() << " "
                  << wall_step << " " << cpu_step << " " << cpu_step / n_cells * 1e6
                  << " " << static_cast<double>(iterations) / n_steps << " " << imbalance
                  << " " << drop << std::endl;
    }
  return 0;
}
