// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/fluid/manufactured_solution.h>

#include <deal.II/base/convergence_table.h>
#include <deal.II/base/mpi.h>
#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // A vessel of diameter and height 1 m with a liquid in which convection,
  // viscosity and drag weigh alike.
  constexpr double density = 1., viscosity = 0.1;
  const Cylinder   vessel{1., 1.};

  ManufacturedParameters
  swirling_flow(const std::string &void_fraction, const std::string &drag)
  {
    ManufacturedParameters result;
    result.void_fraction     = void_fraction;
    result.velocity          = "0.3*sin(2*y+z)*cos(t); 0.3*cos(2*x)*sin(1+z); "
                               "1+0.3*sin(x+y+2*z)*cos(t)";
    result.pressure          = "sin(2*x)*cos(2*y)+cos(2*z)*(1+0.5*sin(t))";
    result.drag              = drag;
    result.particle_velocity = "0.1; 0; 0.2*x";
    return result;
  }

  struct Case
  {
    std::string name, void_fraction, drag;
  };

  const std::vector<Case> cases{
    {"alpha constant, no drag", "0.6", "0"},
    {"alpha constant, drag", "0.6", "2*(1+0.3*x)"},
    {"alpha(x), no drag", "0.6+0.2*sin(2*x)*cos(2*z)", "0"},
    {"alpha(x), drag", "0.6+0.2*sin(2*x)*cos(2*z)", "2*(1+0.3*x)"},
    {"alpha(x,t), no drag", "0.6+0.2*sin(2*x+t)*cos(2*z)", "0"},
    {"alpha(x,t), drag", "0.6+0.2*sin(2*x+t)*cos(2*z)", "2*(1+0.3*x+0.3*t)"}};
} // namespace

namespace
{
  // A manufactured flow on its mesh, computed.
  struct Computed
  {
    Computed(const ManufacturedParameters &given,
             const FlowParameters         &parameters,
             const unsigned int            n_across,
             const double                  step)
      : mesh(vessel, {1. / n_across, 0.}, MPI_COMM_WORLD)
      , nodes(mesh)
      , solution(given, density, viscosity)
      , flow(solution.with_boundaries(parameters), density, viscosity, nodes, costs)
      , errors(solution.run(flow, nodes, step))
    {
    }

    CostSheet            costs;
    VesselMesh           mesh;
    NodalSpace           nodes;
    ManufacturedSolution solution;
    FlowSolver           flow;
    FlowErrors           errors;
  };

  void
  print(const std::string &name, dealii::ConvergenceTable &table)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
      return;
    std::cout << name << '\n';
    for (const std::string column : {"flux", "pressure"})
      table.set_scientific(column, true);
    table.write_text(std::cout);
  }

  double
  distance(const NodalVector &a, const NodalVector &b)
  {
    NodalVector difference(a);
    difference -= b;
    return difference.l2_norm();
  }
} // namespace

TEST(ManufacturedSolution, ConvergesInSpace)
{
  // Trilinear elements: second order in L2, the pressure of a stabilised method too
  // where the flow is smooth.
  for (const Case &flow : cases)
    {
      const bool             steady = flow.name.find("x,t") == std::string::npos;
      ManufacturedParameters given  = swirling_flow(flow.void_fraction, flow.drag);
      given.duration                = steady ? 0. : 0.05;
      FlowParameters parameters;
      parameters.time_scheme = "bdf2";
      dealii::ConvergenceTable table;
      FlowErrors               before;
      for (const unsigned int n : {6, 12, 24})
        {
          const Computed computed(given, parameters, n, 0.01);
          const auto     errors = computed.errors;
          table.add_value("cells", computed.mesh.triangulation().n_global_active_cells());
          table.add_value("flux", errors.flux);
          table.add_value("pressure", errors.pressure);
          table.add_value("solves", errors.solves);
          if (n == 24)
            {
              EXPECT_NEAR(std::log2(before.flux / errors.flux), 2., 0.15) << flow.name;
              EXPECT_NEAR(std::log2(before.pressure / errors.pressure), 2., 0.15)
                << flow.name;
            }
          before = errors;
        }
      for (const std::string quantity : {"flux", "pressure"})
        table.evaluate_convergence_rates(
          quantity, "cells", dealii::ConvergenceTable::reduction_rate_log2, 3);
      print(flow.name, table);
    }
}

TEST(ManufacturedSolution, ConvergesInTime)
{
  // On one mesh, so that the error in space is common to all: the changes from one
  // step size to its half fall with the order of the scheme, once the step is below the
  // time scale of the subscales.
  for (const std::string scheme : {"bdf1", "bdf2"})
    for (const Case &flow : cases)
      {
        ManufacturedParameters given = swirling_flow(flow.void_fraction, flow.drag);
        given.duration               = 1.;
        const unsigned int steps     = scheme == "bdf1" ? 64 : 128;
        FlowParameters     parameters;
        parameters.time_scheme      = scheme;
        parameters.linear_tolerance = 1e-11;
        dealii::ConvergenceTable               table;
        std::vector<std::unique_ptr<Computed>> runs;
        std::vector<std::pair<double, double>> changes;
        for (const unsigned int n : {steps, 2 * steps, 4 * steps})
          {
            runs.push_back(
              std::make_unique<Computed>(given, parameters, 4, given.duration / n));
            if (runs.size() < 2)
              continue;
            const FlowSolver &coarse = runs[runs.size() - 2]->flow,
                             &fine   = runs.back()->flow;
            double flux              = 0.;
            for (unsigned int i = 0; i < 3; ++i)
              flux = std::hypot(flux, distance(coarse.flux()[i], fine.flux()[i]));
            changes.push_back({flux, distance(coarse.pressure(), fine.pressure())});
            table.add_value("steps", n);
            table.add_value("flux", changes.back().first);
            table.add_value("pressure", changes.back().second);
          }
        for (const std::string quantity : {"flux", "pressure"})
          table.evaluate_convergence_rates(
            quantity, "steps", dealii::ConvergenceTable::reduction_rate_log2, 1);
        print(scheme + ", " + flow.name, table);
        const double order = scheme == "bdf1" ? 1. : 2.;
        EXPECT_NEAR(std::log2(changes[0].first / changes[1].first), order, 0.15)
          << scheme << ", " << flow.name;
        EXPECT_NEAR(std::log2(changes[0].second / changes[1].second), order, 0.15)
          << scheme << ", " << flow.name;
      }
}

TEST(ManufacturedSolution, TakesGivenSourcesAsItsOwn)
{
  // A plug flow whose sources are simple by hand: u = (0, 0, 1 + z), alpha = 1/2,
  // s = alpha, f = rho alpha d(u^2)/dz + alpha dp/dz.
  ManufacturedParameters derived;
  derived.void_fraction        = "0.5";
  derived.velocity             = "0; 0; 1 + z";
  derived.pressure             = "1 - z";
  ManufacturedParameters given = derived;
  given.force                  = "0; 0; 1 + z - 0.5";
  given.volume_source          = "0.5";
  const Computed a(derived, {}, 4, 0.), b(given, {}, 4, 0.);
  EXPECT_LE(distance(a.flow.pressure(), b.flow.pressure()), 1e-8);
  EXPECT_NEAR(a.errors.flux, b.errors.flux, 1e-10);
  // Everything in it is linear: nothing is left but the curved cells at the wall.
  EXPECT_LE(a.errors.flux, 1e-3);
}

TEST(ManufacturedSolution, RefusesWhatItCannotRead)
{
  ManufacturedParameters given;
  given.velocity = "0; 0";
  EXPECT_THROW(given.check(), InputError);
  given.velocity = "0; 0; sin(x";
  EXPECT_THROW(given.check(), InputError);
  given.velocity = "0; 0; abracadabra(x)";
  EXPECT_THROW(given.check(), InputError);
  given.velocity = "0; 0; 1";
  given.check();
}
