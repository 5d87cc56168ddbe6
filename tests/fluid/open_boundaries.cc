// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>

#include <gtest/gtest.h>

#include "column.h"

// What holds where a pressure is prescribed, in vessels that are closed, and where inlets
// meet.

namespace
{
  const Cylinder short_column{0.012, 0.02};

  FlowParameters
  between(const std::string &bottom, const std::string &top)
  {
    FlowParameters parameters;
    parameters.boundaries.bottom = bottom;
    parameters.boundaries.top    = top;
    return parameters;
  }

  // A quarter of the column, so that nodes hang in the middle and at both ends.
  bool
  a_quarter(const dealii::Point<3> &x)
  {
    return x[0] > 0. && x[1] > 0.;
  }

  double
  uneven(const dealii::Point<3> &x)
  {
    return 0.5 +
           0.1 * std::sin(600. * x[0]) * std::cos(400. * x[1]) * std::cos(300. * x[2]);
  }

  double
  largest_difference(const NodalVector &a, const NodalVector &b)
  {
    NodalVector difference(a);
    difference -= b;
    return difference.linfty_norm();
  }

  double
  cross_section(const Column &column)
  {
    return column.flow.boundary_area(VesselMesh::top);
  }
} // namespace

TEST(OpenBoundaries, TheGradientThatSolidsFeelDoesNotDependOnTheLevelOfPressure)
{
  for (const bool shares_pressure : {true, false})
    for (const bool local : {false, true})
      {
        std::vector<NodalVectorField> gradients;
        for (const std::string level : {"0", "1000", "101325"})
          {
            Column column(short_column,
                          between("plug", "pressure " + level),
                          3e-3,
                          air_density,
                          air_viscosity,
                          local ? a_quarter
                                : std::function<bool(const dealii::Point<3> &)>());
            column.medium.shares_pressure = shares_pressure;
            column.set(uneven, [](const auto &) { return 1500.; });
            column.flow.set_superficial_velocity(0.3);
            column.find_steady_state();
            gradients.push_back(column.flow.pressure_gradient());
            EXPECT_NEAR(
              column.flow.mean_pressure(VesselMesh::top), std::stod(level), 0.1);
          }
        const double size = gradients[0][2].linfty_norm();
        for (const unsigned int n : {1, 2})
          for (unsigned int i = 0; i < 3; ++i)
            EXPECT_LE(largest_difference(gradients[n][i], gradients[0][i]), 1e-8 * size)
              << (shares_pressure ? "model A" : "model B") << ", component " << i;
      }
}

TEST(OpenBoundaries, InAnEvenBedEveryNodeHasDarcysGradient)
{
  // -alpha dp/dz = B V / alpha at the boundaries too, whose pressure is absolute.
  const double alpha = 0.4, drag = 1500., velocity = 0.3;
  const double expected = -drag * velocity / (alpha * alpha);
  for (const std::string bottom : {"plug", "pressure 101325 + 1500*0.3/0.16*0.02"})
    {
      Column column(short_column,
                    between(bottom, "pressure 101325"),
                    3e-3,
                    air_density,
                    air_viscosity,
                    a_quarter);
      column.set([&](const auto &) { return alpha; }, [&](const auto &) { return drag; });
      column.flow.set_superficial_velocity(velocity);
      column.find_steady_state();
      const NodalVectorField gradient = column.flow.pressure_gradient();
      for (unsigned int k = 0; k < gradient[2].locally_owned_size(); ++k)
        {
          EXPECT_NEAR(gradient[0].local_element(k), 0., 1e-6 * std::abs(expected));
          EXPECT_NEAR(gradient[2].local_element(k), expected, 1e-6 * std::abs(expected));
        }
      // Gauss: the gradient's integral is that of the pressure over the boundary.
      const double area = cross_section(column);
      EXPECT_NEAR(column.flow.pressure_force()[2], expected * 0.02 * area, 1e-7 * area);
      EXPECT_NEAR(column.flow.force_on(VesselMesh::top)[2], 101325. * area, 1e-6 * area);
      EXPECT_NEAR(column.flow.force_on(VesselMesh::bottom)[2],
                  -(101325. - expected * 0.02) * area,
                  1e-4 * area);
    }
}

TEST(OpenBoundaries, AnInflowHasTheStaticPressureThatIsGiven)
{
  // 10 Pa over an even bed: B V / alpha^2 L, whichever way it flows, with the momentum
  // that enters and leaves the same.
  const double alpha = 0.4, drag = 150., expected = 10. / (drag / (alpha * alpha) * 0.02);
  const std::vector<std::pair<FlowParameters, double>> cases{
    {between("pressure 10", "pressure 0"), expected},
    {between("pressure 0", "pressure 10"), -expected},
    {between("velocity 0; 0; -V", "pressure 0"), -expected}};
  for (const auto &[parameters, velocity] : cases)
    {
      Column column(short_column, parameters, 3e-3, air_density, air_viscosity);
      column.set([&](const auto &) { return alpha; }, [&](const auto &) { return drag; });
      column.flow.set_superficial_velocity(expected);
      column.find_steady_state();
      const double area   = cross_section(column);
      const auto   report = column.flow.step(column.medium, FlowSolver::steady);
      say() << "V " << column.flow.flow_below(0.01) / area << " of " << velocity
            << " m/s, drop " << column.pressure_drop() << " Pa, mass "
            << report.mass_imbalance << ", iterations " << report.iterations << '\n';
      EXPECT_NEAR(std::abs(column.pressure_drop()), 10., 1e-6);
      EXPECT_NEAR(column.flow.flow_below(0.01), velocity * area, 1e-6 * expected * area);
      EXPECT_NEAR(column.flow.flow_through(VesselMesh::top),
                  velocity * area,
                  1e-6 * expected * area);
      EXPECT_LE(report.mass_imbalance, 1e-8);
      EXPECT_LE(report.iterations, 60u);
    }
}

TEST(OpenBoundaries, AVortexThatComesBackThroughAnOutletStaysTame)
{
  // Free gas in a short column: a jet through half of the bottom; a bottom that spins and
  // draws fluid in along the axis, as much as it throws out; a swirl that on the whole
  // draws fluid in. Nothing may be faster for long than what drives it. Without a term at
  // the boundary the second fails, without one for the tangential velocity the third.
  struct Case
  {
    std::string bottom;
    double      step, fastest;
  };
  for (const Case &flow :
       {Case{"velocity 0; 0; 3*(x>0)", 1e-3, 3.},
        Case{"velocity -300*y; 300*x; 0", 2e-3, 300. * 0.0125},
        Case{"velocity -4000*y; 4000*x; 10*(1-4*(x*x+y*y)/1.6e-4)", 1e-3, 50.}})
    {
      Column column({0.025, flow.step < 2e-3 ? 0.012 : 0.025},
                    between(flow.bottom, "pressure 100"),
                    4e-3,
                    air_density,
                    1e-5);
      double fastest = 0.;
      for (unsigned int n = 0; n < 80; ++n)
        {
          column.flow.step(column.medium, flow.step);
          if (n >= 20)
            for (const NodalVector &component : column.flow.flux())
              fastest = std::max(fastest, component.linfty_norm());
        }
      say() << flow.bottom << ": largest flux " << fastest << " m/s\n";
      EXPECT_LE(fastest, 1.2 * flow.fastest);
    }
}

TEST(OpenBoundaries, AVesselAtRestReportsNoImbalance)
{
  for (const auto &parameters : {between("slip", "slip"),
                                 between("slip", "pressure 1000"),
                                 between("plug", "pressure 1000"),
                                 between("pressure 1000", "pressure 1000")})
    {
      Column column(
        short_column, parameters, 3e-3, air_density, air_viscosity, a_quarter);
      column.set(uneven, [](const auto &) { return 1500.; });
      column.flow.set_superficial_velocity(0.);
      for (const double step : {1e-3, 1e-3, FlowSolver::steady})
        {
          const auto report = column.flow.step(column.medium, step);
          EXPECT_EQ(report.mass_imbalance, 0.);
          EXPECT_EQ(report.worst_node_imbalance, 0.);
          EXPECT_EQ(report.worst_cell_imbalance, 0.);
          EXPECT_EQ(report.iterations, 0u);
        }
      EXPECT_EQ(column.flow.inflow(), 0.);
      EXPECT_EQ(column.flow.outflow(), 0.);
    }
}

TEST(OpenBoundaries, AClosedVesselTurnsRoundWhatItsSolidsPush)
{
  // Solids that rise in the middle and sink at the wall carry the fluid along; what
  // rises through any section sinks through it, and the pressure's mean is 0.
  for (const double step : {1e-3, FlowSolver::steady})
    {
      Column column(short_column,
                    between("no-slip", "slip"),
                    2e-3,
                    air_density,
                    air_viscosity,
                    a_quarter);
      column.set([](const auto &) { return 0.6; }, [](const auto &) { return 1000.; });
      column.set(column.medium.drag_source[2], [](const auto &x) {
        return 1000. * (0.1 - 5000. * (x[0] * x[0] + x[1] * x[1]));
      });
      for (unsigned int n = 0; n < 10; ++n)
        {
          const auto report = column.flow.step(column.medium, step);
          EXPECT_LE(report.mass_imbalance, 1e-9);
          EXPECT_LE(report.worst_node_imbalance, 1e-8);
          EXPECT_LE(report.iterations, 60u);
        }
      double mean = 0.;
      for (unsigned int k = 0; k < column.nodes.measure().locally_owned_size(); ++k)
        mean += column.nodes.measure().local_element(k) *
                column.flow.pressure().local_element(k);
      EXPECT_NEAR(dealii::Utilities::MPI::sum(mean, MPI_COMM_WORLD), 0., 1e-18);
      EXPECT_GT(column.flow.pressure().linfty_norm(), 0.1);
      EXPECT_GT(column.flow.flux()[2].linfty_norm(), 0.01);
    }
}

TEST(OpenBoundaries, AClosedVesselThatCannotHoldWhatEntersIsRefused)
{
  const auto refused = [](const FlowParameters &parameters) {
    try
      {
        Column column(short_column, parameters, 3e-3, air_density, air_viscosity);
        column.flow.set_superficial_velocity(0.2);
        column.set([](const auto &) { return 0.5; }, [](const auto &) { return 500.; });
        column.flow.step(column.medium, 1e-2);
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return std::string();
  };
  EXPECT_EQ(refused(between("plug", "slip")), "Boundary conditions/top");
  EXPECT_EQ(refused(between("velocity 0; 0; V", "slip")), "Boundary conditions");
  EXPECT_EQ(refused(between("velocity 0; 0; V", "velocity 0; 0; V")), "");
  EXPECT_EQ(refused(between("slip", "slip")), "");

  // Fluid that the solids displace has nowhere to go either, unless it leaves.
  for (const bool leaves : {false, true})
    {
      Column column(short_column,
                    between("slip", leaves ? "velocity 0; 0; V" : "slip"),
                    3e-3,
                    air_density,
                    air_viscosity);
      column.set([](const auto &) { return 0.5; }, [](const auto &) { return 500.; });
      column.flow.set_superficial_velocity(0.);
      column.flow.step(column.medium, 1e-2);
      column.set([](const auto &) { return 0.49; }, [](const auto &) { return 500.; });
      double volume = 0.;
      for (unsigned int k = 0; k < column.nodes.measure().locally_owned_size(); ++k)
        volume += column.nodes.measure().local_element(k);
      volume = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
      column.flow.set_superficial_velocity(volume * 0.01 / 1e-2 / cross_section(column));
      if (leaves)
        EXPECT_LE(column.flow.step(column.medium, 1e-2).mass_imbalance, 1e-9);
      else
        EXPECT_THROW(column.flow.step(column.medium, 1e-2), InputError);
    }
}

TEST(OpenBoundaries, InletsThatMeetLetInWhatEachSays)
{
  // The duct of prm/vessels: bottom, side and top meet each other or a wall at edges.
  const double     side = 0.016, height = 0.012, velocity = 0.2;
  const VesselMesh mesh({0.022628, 0.06},
                        {4e-3, 0., GRAUPEL_SOURCE_DIR "/prm/vessels/side-inlet.msh"},
                        MPI_COMM_WORLD);
  const NodalSpace nodes(mesh);
  Medium           medium(nodes);
  medium.void_fraction = 0.5;
  medium.drag          = 500.;
  medium.void_fraction.update_ghost_values();
  medium.drag.update_ghost_values();
  CostSheet      costs;
  FlowParameters parameters;
  parameters.boundaries.others = "side = velocity -V*16/12; 0; 0";
  FlowSolver flow(parameters, air_density, air_viscosity, nodes, costs);
  flow.set_superficial_velocity(velocity);
  FlowSolver::Report report;
  for (unsigned int n = 0; n < 10; ++n)
    report = flow.step(medium, 0.01);
  const double expected = velocity * side * side;
  const auto   side_id  = mesh.boundaries().at("side");
  EXPECT_NEAR(flow.boundary_area(side_id), side * height, 1e-10 * side * height);
  EXPECT_NEAR(flow.flow_through(VesselMesh::bottom), -expected, 1e-10 * expected);
  EXPECT_NEAR(flow.flow_through(side_id), -expected, 1e-10 * expected);
  EXPECT_NEAR(flow.flow_through(VesselMesh::wall), 0., 0.);
  EXPECT_NEAR(flow.flow_through(VesselMesh::top), 2. * expected, 1e-8 * expected);
  EXPECT_NEAR(flow.inflow(), 2. * expected, 1e-10 * expected);
  EXPECT_NEAR(flow.flow_below(0.03), 2. * expected, 1e-10 * expected);
  EXPECT_NEAR(flow.flow_below(1e-9), expected, 1e-10 * expected);
  EXPECT_LE(report.mass_imbalance, 1e-9);
}
