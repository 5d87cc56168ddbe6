// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "tube.h"

#include <graupel/dem/particles/dem_error.h>

#include <complex>

using namespace graupel;

namespace
{
  // Free spheres in water that rises through a tube.
  Tube::Settings
  spheres(const double particle, const double density, const double cell)
  {
    Tube::Settings settings;
    settings.height    = 0.06;
    settings.cell      = cell;
    settings.particle  = particle;
    settings.density   = density;
    settings.velocity  = 0.02;
    settings.imbalance = 1e-11;
    return settings;
  }

  // A dense cloud of spheres that do not touch, from wall to wall.
  std::vector<dealii::Point<3>>
  cloud(const double       diameter,
        const double       spacing,
        const double       bottom,
        const unsigned int layers)
  {
    std::vector<dealii::Point<3>> positions;
    const int                     n = 0.5 * diameter / spacing;
    for (unsigned int k = 0; k < layers; ++k)
      for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
          if (std::hypot(i, j) * spacing < 0.5 * (diameter - spacing))
            positions.emplace_back(i * spacing, j * spacing, bottom + k * spacing);
    return positions;
  }
} // namespace

TEST(StableStep, IsWhereTheRootsOfTheExplicitStepLeaveTheUnitCircle)
{
  const double mass = 3e-6, slope = 4e-4;
  for (const double alpha : {0.35, 0.45, 0.55, 0.8, 0.999})
    for (const double part : {0.99, 1.01})
      {
        const double step = part * stable_step(alpha, mass, slope);
        const double c = (1. - alpha) / alpha, k = step * slope / (alpha * mass);
        const double half    = 0.5 * (1. - k - 0.5 * k * c);
        const auto   root    = std::sqrt(std::complex<double>(half * half - 0.5 * k * c));
        const double largest = std::max(std::abs(half + root), std::abs(half - root));
        EXPECT_EQ(largest > 1., part > 1.) << "alpha " << alpha << ", root " << largest;
      }
}

TEST(StableStep, AtRestKnowsStokesAndNewton)
{
  // Slow flow: F' = beta; fast flow past Ergun's bed: F' = 2 beta.
  const double   particle = 1e-4, alpha = 0.4, density = 2500.;
  Tube::Settings settings = spheres(particle, density, 2.5e-3);
  settings.law            = "ergun";
  const auto   drag       = settings.drag();
  const double mass       = settings.mass();
  for (const auto &[velocity, factor] : {std::pair(1e-7, 1.), {1e4, 2.}})
    {
      const double beta     = drag.beta(alpha, velocity / alpha, 0.5 * particle);
      const double expected = alpha * 2. * alpha / (1. - alpha) * mass / (factor * beta);
      EXPECT_NEAR(stable_step_at_rest(drag, 0.5 * particle, density, alpha, velocity),
                  expected,
                  2e-3 * expected);
    }
}

TEST(MovingParticles, OneSphereInWaterReachesTheLawsTerminalVelocity)
{
  // Twice as heavy as water, a cork and a bubble's light shell, with steps up to four
  // times the explicit limit. 1 %: the wake is not a steady Oseenlet's all the time.
  for (const auto &[particle, density, dt] : {std::tuple(1e-3, 2000., 1e-2),
                                              std::tuple(2e-3, 500., 1e-2),
                                              std::tuple(2e-3, 50., 5e-3)})
    {
      const auto   settings = spheres(particle, density, 2.5e-3);
      const bool   sinks    = density > settings.fluid.density;
      Tube         tube(settings, {dealii::Point<3>(1e-3, 0.5e-3, sinks ? 0.05 : 0.01)});
      const double expected = settings.terminal_velocity();
      double       place    = 0.;
      unsigned int n        = 0;
      for (; n < 40 && (sinks ? place > -0.03 : place < 0.03); ++n)
        {
          tube.step(dt);
          place += dt * tube.rise_velocity();
        }
      const double slip = std::abs(tube.rise_velocity() - settings.velocity);
      std::cout << "density " << density << ": slip " << slip << " m/s of " << expected
                << " after " << n << " steps, limit "
                << tube.exchange.stable_step(tube.dem.particles()) << " s" << std::endl;
      EXPECT_NEAR(slip, expected, 0.01 * expected);
    }
}

TEST(MovingParticles, ACloudMovesSmoothlyWithAnyStep)
{
  // Fine glass far beyond the explicit limit, and corks, whose explicit added mass,
  // rho/rho_p (1 - alpha) / alpha = 2, is unstable with every step. Neither may ever be
  // faster than one sphere alone, nor swing from step to step.
  for (const auto &[particle, density, spacing, dt] :
       {std::tuple(1e-3, 2500., 1.03e-3, 2e-2), std::tuple(2e-3, 500., 2.05e-3, 5e-3)})
    {
      const auto   settings  = spheres(particle, density, 3.2e-3);
      const bool   sinks     = density > settings.fluid.density;
      const auto   positions = cloud(settings.diameter, spacing, 0.02, sinks ? 8 : 5);
      const double terminal  = settings.terminal_velocity();
      const double sign      = sinks ? -1. : 1.;
      for (const bool answering : {true, false})
        {
          Tube   tube(settings, positions);
          double fastest = 0., back = 0., last = 0.;
          try
            {
              for (unsigned int n = 0; n < 10 && fastest < 10. * terminal; ++n)
                {
                  tube.step(dt, answering);
                  const double speed = sign * tube.rise_velocity();
                  std::cout << speed << " ";
                  back    = std::max(back, last - speed);
                  last    = speed;
                  fastest = std::max(fastest, std::abs(speed));
                }
            }
          catch (const DemError &)
            {
              fastest = std::numeric_limits<double>::infinity();
            }
          std::cout << "m/s, alone " << terminal << ", limit "
                    << tube.exchange.stable_step(tube.dem.particles()) << " s"
                    << std::endl;
          if (answering)
            {
              EXPECT_GT(last, 0.1 * terminal);
              EXPECT_LT(fastest, terminal);
              EXPECT_LT(back, 0.1 * terminal);
            }
          else
            EXPECT_GT(std::max(fastest, 10. * back), terminal)
              << "the explicit step is stable here: this test shows nothing";
        }
    }
}
