// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <gtest/gtest.h>

#include "column.h"

namespace
{
  Column
  air_column(const double cell_size = 3.2e-3)
  {
    return Column({0.025, 0.05}, {}, cell_size, air_density, air_viscosity);
  }
} // namespace

TEST(TimeScheme, DifferentiatesPolynomialsExactly)
{
  // BDF1 is exact for linear, BDF2 for quadratic functions, with any steps.
  const double     step = 0.3, last = 0.7, t = 2.;
  const auto       linear    = [](const double x) { return 3. * x - 1.; };
  const auto       quadratic = [&](const double x) { return 2. * x * x + linear(x); };
  const TimeScheme first = bdf1(step), second = bdf2(step, last);
  EXPECT_NEAR(first.now * linear(t) + first.old * linear(t - step), 3., 1e-12);
  EXPECT_NEAR(second.now * quadratic(t) + second.old * quadratic(t - step) +
                second.older * quadratic(t - step - last),
              4. * t + 3.,
              1e-12);
}

TEST(FlowSolver, DropsTheDarcyPressureInAUniformBed)
{
  // alpha and B constant: -alpha dp/dz = B V / alpha, at any time step.
  Column       column = air_column();
  const double alpha = 0.4, drag = 1500., velocity = 0.3;
  column.set([&](const auto &) { return alpha; }, [&](const auto &) { return drag; });
  column.flow.set_superficial_velocity(velocity);
  const double expected = drag * velocity / (alpha * alpha) * 0.05;
  for (const double step : {1e-4, 5e-3, 0.1, 1.})
    {
      FlowSolver::Report report;
      for (unsigned int n = 0; n < 6; ++n)
        report = column.flow.step(column.medium, step);
      const double drop = column.pressure_drop();
      std::cout << "step " << step << " s: " << drop << " Pa of " << expected
                << ", iterations " << report.iterations << ", mass "
                << report.mass_imbalance << std::endl;
      EXPECT_NEAR(drop, expected, (step < 1e-3 ? 1e-4 : 1e-8) * expected);
      EXPECT_LE(report.mass_imbalance, 1e-9);
    }
}

TEST(FlowSolver, CrossesTheSurfaceOfABed)
{
  // A bed whose solid fraction falls to nothing over 3 mm, with a resistance
  // that falls with it, in steady plug flow: the pressure drop is the integral of
  // B V / alpha^2 plus the gain of momentum, both known in closed form or by fine
  // quadrature. The scheme is of second order; 1.7 is asked for between two
  // coarse meshes. On the axis the pressure must not oscillate: its total
  // variation is its end-to-end difference.
  const double velocity = 0.3, surface = 0.025, width = 3e-3, length = 0.05;
  const auto   alpha = [&](const double z) {
    return 1. - 0.305 * (1. - std::tanh((z - surface) / width));
  };
  const auto drag = [&](const double z) { return 2500. * (1. - alpha(z)); };

  double       expected = 0.;
  const double step     = length / 100000;
  for (double z = 0.5 * step; z < length; z += step)
    expected += step * drag(z) * velocity / (alpha(z) * alpha(z));
  expected += air_density * velocity * velocity * (1. / alpha(length) - 1. / alpha(0.));

  std::vector<double> errors;
  for (const double cell_size : {6.4e-3, 3.2e-3})
    {
      Column column = air_column(cell_size);
      column.set([&](const auto &x) { return alpha(x[2]); },
                 [&](const auto &x) { return drag(x[2]); });
      column.flow.set_superficial_velocity(velocity);
      FlowSolver::Report report;
      for (unsigned int n = 0; n < 60; ++n)
        report = column.flow.step(column.medium, 5e-3);
      EXPECT_LE(report.mass_imbalance, 1e-9);
      errors.push_back(std::abs(column.pressure_drop() - expected));
      std::cout << cell_size << " m: " << column.pressure_drop() << " Pa of " << expected
                << std::endl;

      EXPECT_NEAR(column.axis_variation(), column.pressure_drop(), 0.01 * expected);
    }
  EXPECT_LE(errors[1], 0.025 * expected);
  EXPECT_GE(std::log2(errors[0] / errors[1]), 1.7);
}

TEST(FlowSolver, KeepsStillGasStill)
{
  Column column = air_column();
  column.set([](const auto &x) { return 0.4 + 0.1 * std::sin(300. * x[2]); },
             [](const auto &) { return 1500.; });
  column.flow.set_superficial_velocity(0.);
  column.flow.step(column.medium, 1e-3);
  for (const auto &component : column.flow.flux())
    EXPECT_LE(component.linfty_norm(), 1e-14);
  EXPECT_LE(column.flow.pressure().linfty_norm(), 1e-12);
}

TEST(FlowSolver, StoresWhatTheVoidFractionFrees)
{
  // Solids that leave a closed-bottom column at a uniform rate draw fluid in:
  // the outflow is minus the rate of the void volume.
  Column column = air_column();
  column.flow.set_superficial_velocity(0.2);
  column.set([](const auto &) { return 0.4; }, [](const auto &) { return 100.; });
  column.flow.step(column.medium, 1e-3);
  column.set([](const auto &) { return 0.401; }, [](const auto &) { return 100.; });
  column.flow.step(column.medium, 1e-3);
  double volume = 0.;
  for (unsigned int k = 0; k < column.nodes.measure().locally_owned_size(); ++k)
    volume += column.nodes.measure().local_element(k);
  volume                = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
  const double inflow   = 0.2 * column.mesh.cylinder().cross_section();
  const double expected = inflow - 1. * volume;
  EXPECT_NEAR(column.flow.outflow(), expected, 1e-4 * inflow)
    << "the cross-section by quadrature differs from the circle in the fifth digit";
}
