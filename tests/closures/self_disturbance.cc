// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/self_disturbance.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace graupel;

namespace
{
  const double pi = std::acos(-1.);

  // The velocity over the force in the middle of a Gaussian force, by the integral over
  // the wave numbers in clear fluid (@p b = 0) or among others that take b mu u out of
  // it, in units of mu s: midpoint rules in k and in the cosine m.
  double
  integral(const double peclet, const double b)
  {
    constexpr unsigned int n = 800, n_m = 400;
    constexpr double       last = 8.;
    double                 sum  = 0.;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n_m; ++j)
        {
          const double k = (i + 0.5) * last / n, m = (j + 0.5) / n_m;
          const double a = k * k + b, c = peclet * k * m;
          sum += k * k * std::exp(-0.5 * k * k) * (1. - m * m) * a / (a * a + c * c);
        }
    return sum * last / n / n_m / (2. * pi * pi);
  }
} // namespace

TEST(SelfDisturbance, ClosedFormIsTheIntegralOfOseensOperator)
{
  FluidProperties fluid;
  const double    s = 2e-3;
  for (const double peclet : {1e-3, 0.1, 1., 10., 100.})
    {
      const double slip     = peclet * fluid.viscosity / (fluid.density * s);
      const double found    = gaussian_mobility(fluid, s, slip) * fluid.viscosity * s;
      const double expected = integral(peclet, 0.);
      // Of the midpoint rules, which at 100 meet a peak of the width 1/100.
      EXPECT_NEAR(found / expected, 1., 5e-3) << peclet << ": " << found;
    }
}

TEST(SelfDisturbance, SlowFlowIsStokesAndFastFlowForgetsViscosity)
{
  FluidProperties fluid;
  const double    s = 1e-3;
  EXPECT_NEAR(gaussian_mobility(fluid, s, 0.) * 3. * pi * fluid.viscosity * s,
              1. / std::sqrt(2. * pi),
              1e-12);
  const double fast = 1e4;
  // 3 sqrt(pi) / (4 x) / (3 pi mu s sqrt(2 pi)), to the next term, 2 / (sqrt(pi) x).
  EXPECT_NEAR(
    gaussian_mobility(fluid, s, fast) * 4. * pi * fluid.density * fast * s * s, 1., 1e-4);
}

TEST(SelfDisturbance, ScreeningIsBrinkmansAndOtherwiseNearTheIntegral)
{
  FluidProperties fluid;
  const double    s = 2e-3;
  for (const double peclet : {0., 1., 10., 100.})
    for (const double b : {1e-4, 0.1, 1., 10., 100., 1e3})
      {
        const double slip = peclet * fluid.viscosity / (fluid.density * s);
        const double drag = b * fluid.viscosity / (s * s);
        const double found =
          screened_mobility(fluid, s, slip, drag) * fluid.viscosity * s;
        const double expected = integral(peclet, b);
        // Beyond b = 800 there is the leading term alone; the next is 3 / b of it.
        const double at_rest   = 2e-3 + (b > 800. ? 3. / b : 0.);
        const double tolerance = peclet == 0. ? at_rest : 0.2;
        EXPECT_NEAR(found / expected, 1., tolerance) << peclet << ", " << b;
      }
}

TEST(SelfDisturbance, StructureFactorIsTheCompressibilityOfHardSpheres)
{
  // 1 / S is the derivative of phi Z(phi), Z = (1 + phi + phi^2 - phi^3) / (1 - phi)^3.
  const auto pressure = [](const double phi) {
    return phi * (1. + phi + phi * phi - phi * phi * phi) / std::pow(1. - phi, 3);
  };
  const double step = 1e-4;
  for (const double phi : {0.01, 0.1, 0.3, 0.49})
    {
      const double slope = (pressure(phi + step) - pressure(phi - step)) / (2. * step);
      EXPECT_NEAR(hard_sphere_structure_factor(phi) * slope, 1., 1e-5) << phi;
    }
  EXPECT_EQ(hard_sphere_structure_factor(0.), 1.);
  EXPECT_EQ(hard_sphere_structure_factor(0.6), 0.);
}
