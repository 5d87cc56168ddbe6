// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/dem/packing/filling.h>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  // A short rain with friction, rolling springs and wall contacts: 150 spheres,
  // a bed that reaches from one rank into the other.
  std::unique_ptr<SmallColumn>
  rain(MPI_Comm communicator, const std::function<void(Dem &)> &after_each_step = {})
  {
    auto column = std::make_unique<SmallColumn>(SmallColumn::parameters(), communicator);
    FillingParameters filling;
    filling.count      = 150;
    filling.bed_height = 0.;
    Filling phase(filling, column->dem);
    column->dem.use_packing_materials(false);
    while (phase.step())
      if (after_each_step)
        after_each_step(column->dem);
    for (unsigned int k = 0; k < 30; ++k)
      {
        column->dem.advance(1e-3);
        if (after_each_step)
          after_each_step(column->dem);
      }
    return column;
  }

  // Law: the motion is the same bit by bit on any number of ranks. No
  // tolerance. The bed must have contacts and lie on several ranks, or there
  // would be nothing to compare.
  TEST(Parallel, AnyNumberOfRanksIsTheSameBitByBit)
  {
    unsigned int steps   = 0;
    const auto   migrate = [&](Dem &dem) {
      if (++steps % 10 == 0)
        dem.synchronise();
    };
    const auto alone    = rain(MPI_COMM_SELF);
    const auto together = rain(MPI_COMM_WORLD, migrate);
    EXPECT_EQ(alone->state().size(), 150u);
    EXPECT_EQ(alone->state(), together->state());
    EXPECT_EQ(alone->dem.bottom_force(), together->dem.bottom_force());
    EXPECT_EQ(alone->dem.wall_force(), together->dem.wall_force());
    EXPECT_EQ(alone->dem.mean_kinetic_energy(), together->dem.mean_kinetic_energy());
    EXPECT_EQ(alone->dem.coordination_number(), together->dem.coordination_number());
    EXPECT_GT(together->dem.coordination_number(), 1.);
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      {
        EXPECT_LT(
          dealii::Utilities::MPI::max(together->dem.particles().n_owned, MPI_COMM_WORLD),
          150u);
      }
  }

  // Law: migration and the rebuilding of lists change nothing, not a bit: all
  // springs, velocities, forces survive them.
  TEST(Parallel, SynchronisingChangesNothing)
  {
    unsigned int n           = 0;
    const auto   undisturbed = rain(MPI_COMM_WORLD);
    const auto   disturbed   = rain(MPI_COMM_WORLD, [&](Dem &dem) {
      dem.synchronise();
      ++n;
    });
    EXPECT_GE(disturbed->dem.n_list_builds() + 1, n) << "one after each";
    EXPECT_EQ(undisturbed->state(), disturbed->state());
    EXPECT_EQ(undisturbed->dem.coordination_number(),
              disturbed->dem.coordination_number());
  }

  // The same with a skin of another width, hence other lists in another order.
  TEST(Parallel, TheSkinChangesNothing)
  {
    std::map<std::int64_t, std::vector<double>> states[2];
    for (const unsigned int k : {0, 1})
      {
        DemParameters p = SmallColumn::parameters();
        p.contact.skin  = k == 0 ? 0.1 : 0.5;
        SmallColumn column(p);
        column.dem.insert({Point<3>(1e-3, 2e-4, 0.002),
                           Point<3>(-1e-3, 1e-4, 0.0025),
                           Point<3>(1e-4, 3e-4, 0.0045),
                           Point<3>(2e-4, -1.9e-3, 0.0055)},
                          Vector({0.1, 0.05, -0.3}));
        column.dem.advance(0.05);
        states[k] = column.state();
      }
    EXPECT_EQ(states[0], states[1]);
  }

  // The middle of a face between two ranks, well inside, and its normal; of some
  // face if there is one rank only. The same on all ranks.
  std::pair<Point<3>, Vector>
  border(const VesselMesh &mesh)
  {
    std::vector<double> found;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      for (const auto f : cell->face_indices())
        if (cell->is_locally_owned() && !cell->at_boundary(f) && found.empty())
          {
            const auto   center = cell->face(f)->center();
            const Vector normal = cell->neighbor(f)->center() - cell->center();
            const bool   alone =
              dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
            if ((alone || cell->neighbor(f)->is_ghost()) &&
                std::hypot(center[0], center[1]) < 3e-3)
              for (unsigned int d = 0; d < 6; ++d)
                found.push_back(d < 3 ? center[d] : normal[d - 3] / normal.norm());
          }
    for (const auto &numbers : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, found))
      if (!numbers.empty())
        return {Point<3>(numbers[0], numbers[1], numbers[2]),
                Vector({numbers[3], numbers[4], numbers[5]})};
    return {};
  }

  // A pair on both sides of the border presses equally on both: the sum of the
  // forces on two squeezed spheres is exactly zero.
  TEST(Parallel, ContactAcrossTheBorder)
  {
    DemParameters p     = SmallColumn::parameters();
    p.particles.gravity = 0.;
    SmallColumn column(p);
    const auto [center, normal] = border(column.mesh);
    column.dem.insert({center - 0.99e-3 * normal, center + 0.99e-3 * normal});
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 2)
      {
        EXPECT_EQ(column.dem.particles().n_owned, 1u);
      }
    column.dem.advance(2. * column.dem.substep());
    const Vector first = column.force(0);
    EXPECT_LE(first * normal, -1e-6);
    EXPECT_EQ(first, -column.force(1));
    EXPECT_EQ(column.dem.coordination_number(), 1.);
    column.dem.synchronise();
    EXPECT_EQ(column.dem.coordination_number(), 1.);
  }

  // Every own row is visited once, in the right cell: its place in the unit
  // cell maps back to its position. Limit: Newton's tolerance in the mapping.
  TEST(Parallel, CellsHoldTheirRows)
  {
    const auto column = rain(MPI_COMM_WORLD);
    column->dem.synchronise();
    unsigned int next = 0;
    column->dem.store().visit_cells(
      [&](const auto &cell, const unsigned int first, const auto &at) {
        EXPECT_EQ(first, next);
        EXPECT_TRUE(cell->is_locally_owned());
        for (unsigned int k = 0; k < at.size(); ++k)
          {
            const auto x =
              column->mesh.mapping().transform_unit_to_real_cell(cell, at[k]);
            EXPECT_NEAR(
              x.distance(column->dem.particles().body[first + k].position), 0., 1e-9);
          }
        next += at.size();
      });
    EXPECT_EQ(next, column->dem.particles().n_owned);
    EXPECT_EQ(dealii::Utilities::MPI::sum(next, MPI_COMM_WORLD), column->dem.n_global());
  }

  // A particle shot through the whole column crosses ranks and is never lost,
  // nor is one that stays exactly on the axis, a line of the mesh.
  TEST(Parallel, FastParticleCrossesAllRanks)
  {
    DemParameters p     = SmallColumn::parameters();
    p.particles.gravity = 0.;
    SmallColumn column(p);
    column.dem.insert({Point<3>(0., 0., 0.0015), Point<3>(3e-3, 0., 0.0285)});
    column.set_velocity(0, Vector({0., 0., 1.}));
    if (column.row(1) >= 0)
      column.dem.particles().external_force[column.row(1)] = Vector({0., 0., -8e-4});
    column.dem.advance(0.025);
    EXPECT_NEAR(column.position(0)[2], 0.0265, 1e-12);
    const double acceleration = 8e-4 / p.particles.simulated_mass();
    EXPECT_NEAR(column.position(1)[2], 0.0285 - 0.5 * acceleration * 6.25e-4, 1e-12);
    EXPECT_EQ(dealii::Utilities::MPI::sum(column.dem.particles().n_owned, MPI_COMM_WORLD),
              2u);
  }
} // namespace
