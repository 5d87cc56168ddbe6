// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <gtest/gtest.h>

#include "column.h"

// Flows that start, and that follow what is prescribed in time.

TEST(FirstSteps, ARampedInletKeepsTheOrderOfTheScheme)
{
  // An even bed, the inlet's velocity set on each step as a run's ramp does: the drop is
  // (rho dV/dt + B V / alpha) L / alpha, in which the scheme's error is that of dV/dt.
  const double alpha = 0.4, drag = 30., length = 0.05, end = 0.07;
  const auto   velocity = [](const double t) {
    return 0.15 * (1. - std::cos(dealii::numbers::PI * t / 0.1));
  };
  const double rate =
    0.15 * dealii::numbers::PI / 0.1 * std::sin(dealii::numbers::PI * end / 0.1);
  const double expected =
    (air_density * rate + drag * velocity(end) / alpha) * length / alpha;
  for (const std::string scheme : {"bdf1", "bdf2"})
    {
      std::vector<double> errors;
      for (const unsigned int n : {14, 28, 56})
        {
          FlowParameters parameters;
          parameters.time_scheme      = scheme;
          parameters.linear_tolerance = 1e-11;
          Column column({0.025, length}, parameters, 6.4e-3, air_density, air_viscosity);
          column.set([&](const auto &) { return alpha; },
                     [&](const auto &) { return drag; });
          for (unsigned int k = 1; k <= n; ++k)
            {
              column.flow.set_superficial_velocity(velocity(end * k / n));
              column.flow.step(column.medium, end / n);
            }
          errors.push_back(std::abs(column.pressure_drop() - expected));
        }
      const double first  = std::log2(errors[0] / errors[1]),
                   second = std::log2(errors[1] / errors[2]);
      say() << scheme << ": errors " << errors[0] << ", " << errors[1] << ", "
            << errors[2] << " Pa of " << expected << ", orders " << first << ", "
            << second << '\n';
      EXPECT_NEAR(second, scheme == "bdf1" ? 1. : 2., 0.15);
    }
}

namespace
{
  // A bed on the floor of a column of a liquid or a gas, from rest.
  FlowSolver::Report
  first_step(const double density,
             const double viscosity,
             const double velocity,
             const double drag,
             const double step)
  {
    Column column({0.025, 0.03}, {}, 3.2e-3, density, viscosity);
    column.set(
      [](const auto &x) { return 0.7 - 0.3 * std::tanh((0.02 - x[2]) / 2e-3); },
      [&](const auto &x) { return 0.5 * drag * (1. + std::tanh((0.02 - x[2]) / 2e-3)); });
    column.flow.set_superficial_velocity(velocity);
    return column.flow.step(column.medium, step);
  }
} // namespace

TEST(FirstSteps, AFluidAtRestIsSetInMotionAtAnyStep)
{
  // Water and air, with steps from far below to far above all times of the flow.
  for (const double step : {1e-7, 1e-5, 1e-3, 1e-1, 10.})
    {
      const auto water = first_step(998., 1e-3, 0.01, 3e4, step);
      const auto air   = first_step(air_density, air_viscosity, 0.4, 1500., step);
      say() << "first step of " << step << " s: " << water.iterations
            << " iterations in water, " << air.iterations << " in air; imbalance "
            << water.mass_imbalance << " and " << air.mass_imbalance << '\n';
      for (const auto &report : {water, air})
        {
          // From rest to the steady flow at once, convection is linearised about rest.
          EXPECT_LE(report.iterations, step < 1. ? 100u : 200u);
          EXPECT_LE(report.mass_imbalance, 1e-9);
        }
    }
}

TEST(FirstSteps, ATinyInflowOfARampIsOneLikeAnyOther)
{
  // The equations are linear in a flow so slow: relative to it nothing changes.
  for (const double velocity : {1e-2, 1e-5, 1e-8, 1e-11})
    for (const double step : {1e-3, 2e-5, 3e-7})
      {
        const auto report = first_step(air_density, air_viscosity, velocity, 1500., step);
        say() << velocity << " m/s, step " << step << " s: " << report.iterations
              << " iterations, imbalance " << report.mass_imbalance << '\n';
        EXPECT_LE(report.mass_imbalance, 1e-9);
        EXPECT_LE(report.iterations, 100u);
      }
}
