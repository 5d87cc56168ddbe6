// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <gtest/gtest.h>

#include <filesystem>

#include "column.h"

// A flow that is saved and goes on, or fails and goes on, is the flow that was never
// interrupted.

namespace
{
  const Cylinder       vessel{0.012, 0.02};
  const MeshParameters coarse{3e-3, 0.};

  std::string
  scratch_file()
  {
    return std::filesystem::temp_directory_path() / "graupel-test-flow-restart";
  }

  FlowParameters
  parameters_with(const std::string &scheme)
  {
    FlowParameters parameters;
    parameters.time_scheme    = scheme;
    parameters.boundaries.top = "pressure 1000 + 50*t";
    return parameters;
  }

  // The flow past solids that rise and fall, on a mesh as it is.
  struct Flow
  {
    Flow(const VesselMesh &mesh, const std::string &scheme)
      : mesh(mesh)
      , nodes(mesh)
      , medium(nodes)
      , flow(parameters_with(scheme), air_density, air_viscosity, nodes, costs)
    {
    }

    void
    set(NodalVector &vector, const Column::Field &value) const
    {
      const auto &partitioner = *nodes.measure().get_partitioner();
      vector.zero_out_ghost_values();
      for (const auto &cell : nodes.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int v : cell->vertex_indices())
            if (const auto dof = cell->vertex_dof_index(v, 0);
                partitioner.in_local_range(dof))
              vector(dof) = value(cell->vertex(v));
      nodes.hanging_nodes.distribute(vector);
      vector.update_ghost_values();
    }

    FlowSolver::Report
    step(const unsigned int n, const double factor = 1.)
    {
      const double phase = 0.4 * n;
      const auto   solid = [&](const dealii::Point<3> &x) {
        return 0.3 * (1. - std::tanh((x[2] - 0.012 - 0.001 * std::sin(phase)) / 2e-3)) *
               (1. + 0.2 * std::sin(400. * x[0] + phase));
      };
      set(medium.void_fraction, [&](const auto &x) { return 1. - solid(x); });
      set(medium.drag, [&](const auto &x) { return 3000. * solid(x); });
      set(medium.drag_source[2],
          [&](const auto &x) { return 100. * solid(x) * std::sin(phase); });
      flow.set_superficial_velocity(factor * (0.2 + 0.01 * n));
      return flow.step(medium, (n % 3 == 0 ? 0.7 : 1.) * 2e-3);
    }

    // Largest difference of flux [m/s] and pressure [Pa] at the nodes.
    std::pair<double, double>
    difference(const Flow &other) const
    {
      std::pair<double, double> result;
      const auto largest = [](const NodalVector &a, const NodalVector &b, double &value) {
        for (unsigned int k = 0; k < a.locally_owned_size(); ++k)
          value = std::max(value, std::abs(a.local_element(k) - b.local_element(k)));
      };
      for (unsigned int i = 0; i < 3; ++i)
        largest(flow.flux()[i], other.flow.flux()[i], result.first);
      largest(flow.pressure(), other.flow.pressure(), result.second);
      return result;
    }

    CostSheet         costs;
    const VesselMesh &mesh;
    NodalSpace        nodes;
    Medium            medium;
    FlowSolver        flow;
  };

  bool
  in_a_corner(const dealii::Point<3> &x)
  {
    return x[0] > 0. && x[2] > 0.01;
  }
} // namespace

TEST(Restart, ASavedFlowGoesOnBitByBit)
{
  for (const std::string scheme : {"bdf1", "bdf2"})
    for (const unsigned int saved_at : {0u, 2u, 5u})
      {
        VesselMesh first(vessel, coarse, MPI_COMM_WORLD);
        Column::refine(first, in_a_corner);
        // As particles divide it: the ranks have other numbers of cells.
        first.repartition(
          [](const auto &cell) { return cell->center()[2] < 6e-3 ? 9u : 1u; });
        Flow whole(first, scheme);
        for (unsigned int n = 0; n < saved_at; ++n)
          whole.step(n);
        first.save(scratch_file(), whole.flow.cell_bytes());
        const FlowHistory history = whole.flow.history();

        VesselMesh second(vessel, coarse, MPI_COMM_WORLD);
        const auto bytes = second.load(scratch_file(), first.partition());
        ASSERT_EQ(first.partition(), second.partition());
        Flow resumed(second, scheme);
        resumed.flow.restore(history, bytes);
        EXPECT_EQ(resumed.difference(whole), std::make_pair(0., 0.));
        for (unsigned int n = saved_at; n < saved_at + 3; ++n)
          {
            const auto one = whole.step(n), other = resumed.step(n);
            EXPECT_EQ(one.iterations, other.iterations);
            EXPECT_EQ(resumed.difference(whole), std::make_pair(0., 0.))
              << scheme << ", step " << n << " after " << saved_at;
          }
      }
}

TEST(Restart, AnyNumberOfRanksReadsASavedFlow)
{
  VesselMesh first(vessel, coarse, MPI_COMM_WORLD);
  Column::refine(first, in_a_corner);
  first.repartition([](const auto &cell) { return cell->center()[2] < 6e-3 ? 9u : 1u; });
  Flow whole(first, "bdf2");
  // The next step would not need a new preconditioner.
  for (unsigned int n = 0; n < 5; ++n)
    whole.step(n);
  first.save(scratch_file(), whole.flow.cell_bytes());
  // All of it on each rank.
  VesselMesh second(vessel, coarse, MPI_COMM_SELF);
  const auto bytes = second.load(scratch_file(), {});
  Flow       resumed(second, "bdf2");
  resumed.flow.restore(whole.flow.history(), bytes);
  for (unsigned int n = 5; n < 8; ++n)
    {
      const auto one = whole.step(n), other = resumed.step(n);
      EXPECT_LE(other.iterations, 2 * one.iterations + 20);
      const double drop = whole.flow.mean_pressure(VesselMesh::bottom) - 1000.;
      EXPECT_NEAR(
        resumed.flow.mean_pressure(VesselMesh::bottom) - 1000., drop, 1e-6 * drop);
      EXPECT_NEAR(resumed.flow.force_on(VesselMesh::wall)[0],
                  whole.flow.force_on(VesselMesh::wall)[0],
                  1e-6 * drop * 1e-4);
    }
}

TEST(Restart, AStepThatFailsLeavesNoTrace)
{
  VesselMesh mesh(vessel, coarse, MPI_COMM_WORLD), second(vessel, coarse, MPI_COMM_WORLD);
  for (const unsigned int failing : {1u, 5u})
    {
      Flow whole(mesh, "bdf2"), failed(mesh, "bdf2");
      for (unsigned int n = 0; n < failing; ++n)
        {
          whole.step(n);
          failed.step(n);
        }
      for (const double factor : {1e300, -1e300})
        EXPECT_THROW(failed.step(failing, factor), SolverFailure);
      EXPECT_EQ(failed.difference(whole), std::make_pair(0., 0.));
      EXPECT_EQ(failed.flow.outflow(), whole.flow.outflow());
      EXPECT_EQ(failed.flow.inflow(), whole.flow.inflow());

      mesh.save(scratch_file(), failed.flow.cell_bytes());
      const auto bytes = second.load(scratch_file(), mesh.partition());
      Flow       resumed(second, "bdf2");
      resumed.flow.restore(failed.flow.history(), bytes);
      for (unsigned int n = failing; n < failing + 4; ++n)
        {
          whole.step(n);
          failed.step(n);
          resumed.step(n);
          EXPECT_EQ(failed.difference(whole), std::make_pair(0., 0.)) << "step " << n;
          EXPECT_EQ(resumed.difference(whole), std::make_pair(0., 0.)) << "step " << n;
        }
    }
}
