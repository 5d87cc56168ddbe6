// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>

#include <gtest/gtest.h>

#include "column.h"

// What enters and leaves a short column under each boundary condition.

namespace
{
  const Cylinder short_column{0.025, 0.03};

  double
  wavy(const dealii::Point<3> &x)
  {
    return 0.6 + 0.2 * std::sin(200. * x[0]) * std::cos(150. * x[1]);
  }

  Column
  column_with(const std::string &bottom, const bool weigh = false)
  {
    FlowParameters parameters;
    parameters.boundaries.bottom       = bottom;
    parameters.boundaries.weigh_inlets = weigh;
    return Column(short_column, parameters, 3.2e-3, air_density, air_viscosity);
  }

  double
  mean_at_bottom(const Column &column, const NodalVector &field)
  {
    const FlowSpace space(column.nodes, {});
    double          area = 0., sum = 0.;
    for (const auto &point : space.boundary(VesselMesh::bottom))
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        {
          area += point.weight * point.value[a];
          sum += point.weight * point.value[a] *
                 field.local_element(space.cell_nodes[point.cell][a]);
        }
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD) /
           dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD);
  }

  // Not exact: the mesh's circle is one to the fourth order, of 12 cells around.
  constexpr double area_tolerance = 1e-3;
} // namespace

TEST(Boundaries, EachInletLetsInWhatItsNameSays)
{
  const double velocity = 0.3, area = short_column.cross_section(), rate = 1e-4;
  Column       probe = column_with("plug");
  probe.set(wavy, [](const auto &) { return 500.; });
  const double alpha = mean_at_bottom(probe, probe.medium.void_fraction);
  // Flows at the time 0.01 s, in m^3/s. The flux that enters by a mass flow rate is that
  // of the paper's eq. 8: mdot alpha / (rho A).
  const std::vector<std::pair<std::string, double>> inlets{
    {"plug", velocity * area},
    {"parabolic", velocity * area},
    {"velocity 0; 0; V*(1 + 10*t)", velocity * area * 1.1},
    {"mass flow rate 1e-4", rate * alpha / air_density}};
  for (const auto &[text, expected] : inlets)
    for (const bool weigh : {false, true})
      {
        Column column = column_with(text, weigh);
        column.set(wavy, [](const auto &) { return 500.; });
        column.flow.set_superficial_velocity(velocity);
        const auto report = column.flow.step(column.medium, 0.01);
        say() << text << (weigh ? ", weighed" : "") << ": " << column.flow.inflow()
              << " of " << expected << " m^3/s\n";
        // Weighing keeps the total of an even flow only.
        const double tolerance = weigh && text == "parabolic" ? 0.02 : area_tolerance;
        EXPECT_NEAR(column.flow.inflow(), expected, tolerance * expected) << text;
        EXPECT_NEAR(
          column.flow.outflow(), column.flow.inflow(), 1e-8 * column.flow.inflow());
        EXPECT_LE(report.mass_imbalance, 1e-8);
      }
}

TEST(Boundaries, AWeighedInletFollowsTheVoidFraction)
{
  Column     column = column_with("plug", true);
  const auto alpha  = [](const auto &x) { return x[0] < 1e-6 ? 0.05 : 0.8; };
  column.set(alpha, [](const auto &) { return 500.; });
  const double mean = mean_at_bottom(column, column.medium.void_fraction);
  column.flow.set_superficial_velocity(0.3);
  column.flow.step(column.medium, 1e-3);
  for (const auto &cell : column.nodes.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
        if (const auto x = cell->vertex(v); x[2] < 1e-6)
          {
            EXPECT_NEAR(column.flow.flux()[2](cell->vertex_dof_index(v, 0)),
                        0.3 * alpha(x) / mean,
                        1e-12);
          }
}

TEST(Boundaries, ThePressureAtTheTopIsTheOneGiven)
{
  FlowParameters parameters;
  parameters.boundaries.top = "pressure 50 + 100*t";
  Column column(short_column, parameters, 3.2e-3, air_density, air_viscosity);
  column.set([](const auto &) { return 0.5; }, [](const auto &) { return 500.; });
  column.flow.set_superficial_velocity(0.3);
  for (unsigned int n = 0; n < 10; ++n)
    column.flow.step(column.medium, 0.01);
  // At 0.1 s. The column is uniform, so that only the solver's tolerance is left.
  EXPECT_NEAR(column.flow.mean_pressure(VesselMesh::top), 60., 1e-5);
  EXPECT_NEAR(column.pressure_drop(), 500. * 0.3 / 0.25 * 0.03, 1e-5);
}

TEST(Boundaries, FluidThatComesBackThroughTheOutletStaysTame)
{
  // A plug that breathes: half of the time the outlet is an inlet.
  Column column = column_with("velocity 0; 0; V*cos(60*t)");
  column.set([](const auto &x) { return x[2] < 0.02 ? 0.5 : 1.; },
             [](const auto &x) { return x[2] < 0.02 ? 500. : 0.; });
  column.flow.set_superficial_velocity(0.5);
  double fastest = 0., imbalance = 0.;
  for (unsigned int n = 0; n < 300; ++n)
    {
      const auto report = column.flow.step(column.medium, 2e-3);
      imbalance         = std::max(imbalance, report.mass_imbalance);
      // The first steps set still gas in motion at once.
      if (n >= 20)
        for (const NodalVector &component : column.flow.flux())
          fastest = std::max(fastest, component.linfty_norm());
    }
  say() << "breathing: largest flux " << fastest << " m/s, imbalance " << imbalance
        << '\n';
  EXPECT_LE(fastest, 1.2 * 0.5);
  EXPECT_LE(imbalance, 1e-8);
}

TEST(Boundaries, ConditionsThatCannotBeAreRefusedByName)
{
  const auto message = [](const BoundaryParameters &parameters) -> std::string {
    try
      {
        parameters.check();
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return "";
  };
  BoundaryParameters parameters;
  EXPECT_EQ(message(parameters), "");
  parameters.bottom = "plugg";
  EXPECT_EQ(message(parameters), "Boundary conditions/bottom");
  parameters        = {};
  parameters.bottom = "velocity 0; 0";
  EXPECT_EQ(message(parameters), "Boundary conditions/bottom");
  parameters      = {};
  parameters.wall = "pressure sin(";
  EXPECT_EQ(message(parameters), "Boundary conditions/wall");
  parameters     = {};
  parameters.top = "slip";
  EXPECT_EQ(message(parameters), "Boundary conditions/top");
  parameters        = {};
  parameters.others = "side plug";
  EXPECT_EQ(message(parameters), "Boundary conditions/others");
}

// The duct of prm/vessels: what enters through the bottom and through the side named in
// the file leaves at the top; without the side's inlet it is a plain Darcy column.
TEST(Boundaries, AFilesBoundariesHaveTheirConditionsByName)
{
  const double     drag = 500., alpha = 0.5, velocity = 0.2, side = 0.016;
  const VesselMesh mesh({0.022628, 0.06},
                        {4e-3, 0., GRAUPEL_SOURCE_DIR "/prm/vessels/side-inlet.msh"},
                        MPI_COMM_WORLD);
  const NodalSpace nodes(mesh);
  Medium           medium(nodes);
  medium.void_fraction = alpha;
  medium.drag          = drag;
  medium.void_fraction.update_ghost_values();
  medium.drag.update_ghost_values();
  CostSheet  costs;
  const auto run = [&](const std::string &others) {
    FlowParameters parameters;
    parameters.boundaries.others = others;
    FlowSolver flow(parameters, air_density, air_viscosity, nodes, costs);
    flow.set_superficial_velocity(velocity);
    for (unsigned int n = 0; n < 10; ++n)
      flow.step(medium, 0.01);
    const double inflow = flow.inflow();
    EXPECT_NEAR(flow.outflow(), inflow, 1e-8 * inflow);
    return std::make_pair(inflow,
                          flow.mean_pressure(VesselMesh::bottom) -
                            flow.mean_pressure(VesselMesh::top));
  };
  const auto [plain, drop] = run("");
  EXPECT_NEAR(plain, velocity * side * side, 1e-12);
  EXPECT_NEAR(drop, drag * velocity / (alpha * alpha) * 0.06, 1e-6);

  const auto [both, more] = run("side = velocity -V; 0; 0");
  say() << "side inlet: " << both << " of " << velocity * (side * side + side * 0.012)
        << " m^3/s\n";
  EXPECT_GT(more, drop);
  EXPECT_NEAR(both, velocity * (side * side + side * 0.012), 1e-10 * both);

  EXPECT_THROW(run("sied = plug"), InputError);
}
