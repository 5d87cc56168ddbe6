// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>

#include <gtest/gtest.h>

#include <cmath>

#include "column.h"

// Flows that are known in closed form, and limits of the parameters.

TEST(FlowLimits, PoiseuilleFlowInATube)
{
  // -dp/dz = 32 mu V / D^2, and twice the mean velocity on the axis. The gradient is
  // taken away from the outlet, where the free traction bends the profile.
  const double        viscosity = 0.5, velocity = 1.;
  std::vector<double> errors;
  for (const double cell_size : {1. / 8, 1. / 16})
    {
      FlowParameters parameters;
      parameters.boundaries.bottom = "parabolic";
      parameters.boundaries.wall   = "no-slip";
      Column column({1., 2.}, parameters, cell_size, 1., viscosity);
      column.flow.set_superficial_velocity(velocity);
      column.find_steady_state();
      const double gradient = column.axis_pressure_gradient(0.5, 1.);
      const double expected = 32. * viscosity * velocity;
      const double fastest  = column.on_axis(column.flow.flux()[2], 1.);
      say() << "Poiseuille, cells of " << cell_size << " m: gradient " << gradient
            << " of " << expected << " Pa/m, on the axis " << fastest << " m/s\n";
      errors.push_back(std::abs(gradient / expected - 1.));
      EXPECT_NEAR(fastest, 2. * velocity, 7. * cell_size * cell_size);
    }
  EXPECT_LE(errors[1], 0.02);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2., 0.3);
}

TEST(FlowLimits, BrinkmanFlowInATube)
{
  // Drag and viscosity: u = (alpha G / B) (1 - I0(k r) / I0(k R)), k^2 = B/(alpha mu),
  // with G the pressure gradient; source: Brinkman (1949), doi:10.1007/BF02120313.
  const double viscosity = 0.05, alpha = 0.5, velocity = 0.5, radius = 0.5;
  const double drag = 100. * alpha * viscosity; // k = 10 1/m
  const double k    = std::sqrt(drag / (alpha * viscosity));
  const double mean = 1. - 2. * std::cyl_bessel_i(1., k * radius) /
                             (k * radius * std::cyl_bessel_i(0., k * radius));
  const double expected = velocity / alpha * drag / (alpha * mean);
  const double axis     = velocity / mean * (1. - 1. / std::cyl_bessel_i(0., k * radius));
  std::vector<double> errors;
  for (const double cell_size : {1. / 8, 1. / 16})
    {
      FlowParameters parameters;
      parameters.boundaries.wall = "no-slip";
      Column column({2. * radius, 2.}, parameters, cell_size, 1., viscosity);
      column.set([&](const auto &) { return alpha; }, [&](const auto &) { return drag; });
      column.flow.set_superficial_velocity(velocity);
      column.find_steady_state();
      const double gradient = column.axis_pressure_gradient(0.75, 1.25);
      const double fastest  = column.on_axis(column.flow.flux()[2], 1.);
      say() << "Brinkman, cells of " << cell_size << " m: gradient " << gradient << " of "
            << expected << " Pa/m, on the axis " << fastest << " of " << axis << " m/s\n";
      errors.push_back(std::abs(gradient / expected - 1.));
      EXPECT_NEAR(fastest, axis, 3. * cell_size * cell_size);
    }
  EXPECT_LE(errors[1], 0.02);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2., 0.4);
}

TEST(FlowLimits, AJumpOfTheVoidFractionMakesNoOscillation)
{
  // A bed that ends from one node to the next, along z and across the vessel: the
  // pressure falls all the way, so its total variation is its end-to-end difference;
  // the gas that slows down behind the surface gives back some 0.1 % of it.
  for (const double step : {1e-3, FlowSolver::steady})
    {
      Column column({0.025, 0.05}, {}, 3.2e-3, air_density, air_viscosity);
      column.set([](const auto &x) { return x[2] < 0.025 ? 0.39 : 1.; },
                 [](const auto &x) { return x[2] < 0.025 ? 1500. : 0.; });
      column.flow.set_superficial_velocity(0.4);
      for (unsigned int n = 0; n < 50; ++n)
        column.flow.step(column.medium, step);
      const double variation = column.axis_variation(), drop = column.pressure_drop();
      say() << "jump, step " << step << " s: total variation " << variation
            << " Pa, drop " << drop << " Pa\n";
      EXPECT_NEAR(variation, drop, 0.01 * drop);
    }
}

TEST(FlowLimits, InfiniteDragCarriesTheFluidAlong)
{
  // Solids that turn and rise; u - v falls as 1 / B, whatever the step, down to what
  // the nodes' normals at the curved wall are in error.
  const double   alpha = 0.4, rise = 0.2, spin = 30.;
  FlowParameters parameters;
  parameters.boundaries.bottom = "velocity -0.4*30*y; 0.4*30*x; 0.4*0.2";
  for (const double drag : {1e6, 1e9, 1e12})
    for (const double step : {1e-4, 1e-1})
      {
        Column column({0.025, 0.05}, parameters, 3.2e-3, air_density, air_viscosity);
        column.set([&](const auto &) { return alpha; },
                   [&](const auto &) { return drag; });
        const auto velocity = [&](const unsigned int i, const dealii::Point<3> &x) {
          return i == 0 ? -spin * x[1] : i == 1 ? spin * x[0] : rise;
        };
        for (unsigned int i = 0; i < 3; ++i)
          column.set(column.medium.drag_source[i],
                     [&](const auto &x) { return drag * velocity(i, x); });
        column.flow.set_superficial_velocity(alpha * rise);
        for (unsigned int n = 0; n < 10; ++n)
          column.flow.step(column.medium, step);
        double worst = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          {
            NodalVector difference;
            column.nodes.initialize(difference);
            column.set(difference, [&](const auto &x) { return alpha * velocity(i, x); });
            difference -= column.flow.flux()[i];
            worst = std::max(worst, difference.linfty_norm() / alpha);
          }
        say() << "drag " << drag << ", step " << step << " s: largest slip " << worst
              << " m/s\n";
        EXPECT_LE(worst, 100. / drag + 1e-4);
      }
}

TEST(FlowLimits, TheMassBalanceFollowsItsTolerance)
{
  for (const double tolerance : {1e-8, 1e-10, 1e-12})
    {
      FlowParameters parameters;
      parameters.mass_tolerance = tolerance;
      Column column({0.025, 0.05}, parameters, 3.2e-3, air_density, air_viscosity);
      double worst = 0., worst_node = 0.;
      for (unsigned int n = 0; n < 8; ++n)
        {
          column.set(
            [&](const auto &x) {
              return 0.6 + 0.1 * std::sin(200. * x[2] - n) * std::cos(200. * x[0]);
            },
            [](const auto &) { return 1000.; });
          column.flow.set_superficial_velocity(0.3);
          const auto report = column.flow.step(column.medium, 1e-3);
          worst             = std::max(worst, report.mass_imbalance);
          worst_node        = std::max(worst_node, report.worst_node_imbalance);
          EXPECT_LE(report.worst_cell_imbalance, 0.1);
          EXPECT_LE(std::hypot(report.worst_cell[0], report.worst_cell[1]), 0.0125);
        }
      say() << "tolerance " << tolerance << ": imbalance " << worst << ", worst node "
            << worst_node << '\n';
      EXPECT_LE(worst, tolerance);
      // No node hides what another has lost.
      EXPECT_LE(worst_node, 10. * std::max(tolerance, 1e-9));
    }
}

TEST(FlowLimits, TheSteadyStateDoesNotDependOnTheStep)
{
  std::vector<double> drops;
  for (const double step : {1e-4, 1e-3, 5e-3, FlowSolver::steady})
    {
      Column column({0.025, 0.03}, {}, 4.2e-3, air_density, air_viscosity);
      column.set(
        [](const auto &x) { return 0.6 - 0.2 * std::tanh((0.02 - x[2]) / 2e-3); },
        [](const auto &x) { return 750. * (1. + std::tanh((0.02 - x[2]) / 2e-3)); });
      column.flow.set_superficial_velocity(0.4);
      const unsigned int n_steps = std::isfinite(step) ? std::max(20., 0.08 / step) : 20;
      for (unsigned int n = 0; n < n_steps; ++n)
        column.flow.step(column.medium, step);
      drops.push_back(column.pressure_drop());
      say() << "step " << step << " s: " << drops.back() << " Pa\n";
      EXPECT_NEAR(drops.back(), drops.front(), 1e-5 * drops.front());
    }
}
