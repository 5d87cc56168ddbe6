#include <graupel/base/parameters.h>
#include <graupel/coupling/exchange.h>
#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // A short column of air with particles of 2 mm at given places.
  struct Column
  {
    static constexpr double particle = 2e-3;

    Column(const std::vector<dealii::Point<3>> &positions,
           const double                         filter_length,
           const bool                           shares_pressure = true,
           const double                         cell            = 2e-3)
      : mesh({0.012, 0.02}, {cell, 0.}, MPI_COMM_WORLD)
      , nodes(mesh)
      , dem(parameters(), mesh, costs)
      , exchange(filter_length, shares_pressure, {}, {drag()}, nodes, costs)
      , flow({}, air.density, air.viscosity, nodes, costs)
    {
      dem.insert(positions);
      dem.synchronise();
    }

    static DemParameters
    parameters()
    {
      DemParameters result;
      result.particles.diameter = particle;
      return result;
    }

    static DragOfType
    drag()
    {
      DragParameters choice;
      choice.law = "wen-yu";
      return {Drag(choice, FluidProperties(), particle, 1.), 0.5 * particle};
    }

    void
    flow_past(const double velocity, const bool answering = false)
    {
      flow.set_superficial_velocity(velocity);
      for (unsigned int n = 0; n < 6; ++n)
        {
          exchange.update_bed(dem.store(), dem.particles());
          if (answering)
            exchange.update_drag(
              dem.particles(),
              particle_response(
                dem.particles(),
                [&](const unsigned int row) { return dem.contact_force(row); },
                {},
                air.density,
                1e-3));
          else
            exchange.update_drag(dem.particles());
          flow.step(exchange.medium(), answering ? 1e-3 : FlowSolver::steady);
          force = exchange.forces(dem.particles(), flow, air.density, {});
        }
    }

    const FluidProperties             air;
    CostSheet                         costs;
    VesselMesh                        mesh;
    NodalSpace                        nodes;
    Dem                               dem;
    Exchange                          exchange;
    FlowSolver                        flow;
    std::vector<dealii::Tensor<1, 3>> force;
  };
} // namespace

TEST(FewParticles, WithoutAnyTheFluidIsClear)
{
  for (const bool shares_pressure : {true, false})
    for (const bool answering : {true, false})
      {
        Column column({}, 1.4e-3, shares_pressure);
        column.flow_past(0.3, answering);
        const Exchange &exchange = column.exchange;
        for (unsigned int k = 0; k < column.nodes.measure().locally_owned_size(); ++k)
          {
            EXPECT_EQ(exchange.medium().void_fraction.local_element(k), 1.);
            EXPECT_EQ(exchange.medium().drag.local_element(k), 0.);
          }
        EXPECT_TRUE(column.force.empty());
        EXPECT_EQ(exchange.total_force().norm(), 0.);
        EXPECT_EQ(exchange.solid_volume_error(), 0.);
        EXPECT_EQ(exchange.momentum_imbalance(), 0.);
        EXPECT_TRUE(std::isinf(exchange.stable_step(column.dem.particles())));
        EXPECT_NEAR(column.flow.outflow() / column.flow.inflow(), 1., 1e-8);
      }
}

TEST(FewParticles, OneFeelsTheLawInClearFluidWhateverTheMesh)
{
  // Held in the middle of the column, with the default filter. What is left is the
  // section that it takes from the column, some 2 %.
  const double velocity = 1.;
  for (const double cell : {4e-3, 2e-3, 1e-3})
    {
      Column column({dealii::Point<3>(0.3e-3, -0.4e-3, 0.0105)},
                    Column::particle / std::sqrt(2.),
                    true,
                    cell);
      column.flow_past(velocity);
      const double expected =
        Column::drag().beta(1., velocity, 0.5 * Column::particle) * velocity;
      const double force = column.exchange.total_force()[2];
      std::cout << "cells of " << cell << " m: " << force << " N of " << expected << " N"
                << std::endl;
      EXPECT_NEAR(force, expected, 0.03 * expected) << cell;
      EXPECT_LE(column.exchange.momentum_imbalance(), 1e-10);
      EXPECT_LE(column.exchange.solid_volume_error(), 1e-12);
    }
}

TEST(FewParticles, ItsOwnMarkIsKnownOnALattice)
{
  // The cells in the middle of the cylinder are nearly a lattice: 5e-3.
  for (const unsigned int times : {1u, 2u})
    {
      const double length = 6e-4;
      Column column({dealii::Point<3>(0.3e-3, -0.4e-3, 0.0105)}, length, true, 5e-4);
      const Filter     filter(column.nodes, length);
      ParticleTransfer transfer(column.nodes);
      transfer.update(column.dem.store());
      NodalVector mark, field;
      column.nodes.initialize(mark);
      column.nodes.initialize(field);
      transfer.deposit(field, std::vector<double>(column.dem.particles().n_owned, 1.));
      filter.spread(mark, field);
      for (unsigned int n = 1; n < times; ++n)
        {
          filter.smooth(field, mark);
          mark.swap(field);
        }
      const auto found = transfer.sample(mark);
      for (unsigned int row = 0; row < found.size(); ++row)
        {
          const auto  &place = transfer.places()[row];
          const double expected =
            OwnMark(length, times, transfer.edges()[place.cell]).density(place.x);
          EXPECT_NEAR(found[row] / expected, 1., 5e-3) << found[row];
        }
      if (times > 1)
        continue;
      const auto gradient = transfer.sample_gradient(mark);
      for (unsigned int row = 0; row < found.size(); ++row)
        {
          const auto &place = transfer.places()[row];
          const auto  expected =
            place.by_x *
            OwnMark(length, times, transfer.edges()[place.cell]).slopes(place.x);
          EXPECT_LT((gradient[row] - expected).norm(), 0.05 * gradient[row].norm());
          EXPECT_GT(gradient[row].norm(), 10. * found[row]);
        }
    }
}

TEST(FewParticles, AGradientIsThatOfALinearField)
{
  Column           column({dealii::Point<3>(0.3e-3, -0.4e-3, 0.0105),
                           dealii::Point<3>(2.1e-3, 3.2e-3, 0.006)},
                1.4e-3);
  ParticleTransfer transfer(column.nodes);
  transfer.update(column.dem.store());
  const dealii::Tensor<1, 3> slope({3., -2., 5.});
  NodalVector                field;
  column.nodes.initialize(field);
  for (const auto &cell : column.nodes.owned_cells())
    for (const unsigned int a : cell->vertex_indices())
      if (const auto k = cell->vertex_dof_index(a, 0); column.nodes.owned.is_element(k))
        field(k) = slope * cell->vertex(a);
  field.update_ghost_values();
  for (const auto &found : transfer.sample_gradient(field))
    EXPECT_LT((found - slope).norm(), 1e-10);
}

TEST(FewParticles, AFilterThatDoesNotSpreadThemIsNamed)
{
  // A sphere of 2 mm on cells of 1 mm without a filter takes more than all of a node.
  Column column({dealii::Point<3>(0., 0., 0.01)}, 0., true, 1e-3);
  try
    {
      column.exchange.update_bed(column.dem.store(), column.dem.particles());
      FAIL() << "a void fraction below 0 passed";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.parameter, "Coupling/filter length");
      const std::string what = error.what();
      EXPECT_NE(what.find("Mesh/cell size"), std::string::npos) << what;
    }
}
