// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/convergence.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace graupel;

TEST(GridConvergence, FindsTheOrderOfAPowerLaw)
{
  // f(h) = f0 + c h^p has order p and limit f0, for any ratios of refinement.
  for (const double p : {0.7, 1., 1.5, 2., 4.})
    for (const double ratio : {1.3, 1.5, 2.})
      for (const double c : {-0.4, 0.3})
        {
          const auto at = [&](const double h) -> Computation {
            return {h, 7. + c * std::pow(h, p)};
          };
          const auto result = grid_convergence(at(0.1), at(0.15), at(0.15 * ratio));
          ASSERT_TRUE(result.order && result.extrapolated && result.index);
          EXPECT_NEAR(*result.order, p, 1e-6);
          EXPECT_NEAR(*result.extrapolated, 7., 1e-7);
          // The index is the true error, times the factor of safety, over the value.
          const double error = std::abs(c) * std::pow(0.1, p) / at(0.1).value;
          EXPECT_NEAR(*result.index, 1.25 * error, 1e-6 * error);
          EXPECT_FALSE(result.oscillates);
        }
}

TEST(GridConvergence, GivesTheWorkedExampleOfItsSource)
{
  // Celik et al. (2008), table 1, first column: 18000, 8000 and 4500 cells in two
  // dimensions, r21 = 1.5, r32 = 1.333.
  const auto result = grid_convergence({1., 6.063}, {1.5, 5.972}, {1.5 * 1.333, 5.863});
  ASSERT_TRUE(result.order && result.extrapolated && result.index);
  EXPECT_NEAR(*result.order, 1.53, 0.01);
  EXPECT_NEAR(*result.extrapolated, 6.1685, 5e-4);
  EXPECT_NEAR(result.relative_change, 0.015, 5e-4);
  EXPECT_NEAR(*result.index, 0.022, 5e-4);
}

TEST(GridConvergence, KnowsOscillationAndDivergence)
{
  EXPECT_TRUE(grid_convergence({1., 1.}, {2., 1.1}, {4., 0.7}).oscillates);
  EXPECT_FALSE(grid_convergence({1., 1.}, {2., 1.4}, {4., 1.5}).order);
  EXPECT_FALSE(grid_convergence({1., 1.}, {2., 1.}, {4., 1.}).order);
  EXPECT_THROW(grid_convergence({2., 1.}, {1., 1.}, {4., 1.}), std::invalid_argument);
}

TEST(ObservedOrder, OfErrors)
{
  EXPECT_NEAR(*observed_order({0.1, 0.02}, {0.2, 0.08}), 2., 1e-12);
  EXPECT_FALSE(observed_order({0.1, 0.}, {0.2, 0.08}));
}

TEST(Extrapolation, IsExactForAParabolaAndTellsItsErrors)
{
  const auto parabola = [](const double s) { return 9. - 2. * s + 0.25 * s * s; };
  const std::vector<Computation> computations{
    {4., parabola(4.)}, {3., parabola(3.)}, {2., parabola(2.)}};
  const auto exact = extrapolate(computations, {0., 0., 0.}, 1.);
  EXPECT_NEAR(exact.value, parabola(1.), 1e-12);
  // The line through the two finest misses it by f'' (1 - 2) (1 - 3) / 2.
  EXPECT_NEAR(exact.error, 1.25 * 0.5, 1e-12);
  // The weights at 1 are 1, -3, 3.
  const auto noisy = extrapolate(computations, {0.1, 0.2, 0.3}, 1.);
  EXPECT_NEAR(noisy.value, exact.value, 1e-12);
  EXPECT_NEAR(noisy.error, std::sqrt(0.390625 + 0.01 + 0.36 + 0.81), 1e-12);
  EXPECT_THROW(extrapolate({{1., 1.}}, {0.}, 1.), std::invalid_argument);
  EXPECT_THROW(extrapolate({{1., 1.}, {1., 2.}}, {0., 0.}, 1.), std::invalid_argument);
}

// Weights 1/9, 1/4, 1 over their sum; by hand.
TEST(MeanAt, CountsWhatIsNearestMost)
{
  const std::vector<Computation> computations{{4., 10.}, {3., 8.}, {2., 9.}};
  const double                   sum  = 1. / 9. + 1. / 4. + 1.;
  const double                   mean = (10. / 9. + 8. / 4. + 9.) / sum;
  const auto                     same = mean_at(computations, {0., 0., 0.}, 1.);
  EXPECT_NEAR(same.value, mean, 1e-12);
  const double scatter = (std::pow(10. - mean, 2) / 9. + std::pow(8. - mean, 2) / 4. +
                          std::pow(9. - mean, 2)) /
                         sum / 2.;
  EXPECT_NEAR(same.error, std::sqrt(scatter), 1e-12);
  const auto noisy = mean_at(computations, {0., 0., 0.3}, 1.);
  EXPECT_NEAR(noisy.error, std::sqrt(scatter + std::pow(0.3 / sum, 2)), 1e-12);
  // Where all tell the same there is no scatter.
  EXPECT_NEAR(mean_at({{4., 5.}, {2., 5.}}, {0., 0.}, 1.).error, 0., 1e-12);
  EXPECT_THROW(mean_at({{2., 1.}}, {0.}, 1.), std::invalid_argument);
  EXPECT_THROW(mean_at({{2., 1.}, {1., 1.}}, {0., 0.}, 1.), std::invalid_argument);
}

TEST(Estimates, RelativeErrorsOfAProductAddInQuadrature)
{
  const auto both = product({4., 0.12}, {-5., 0.2});
  EXPECT_DOUBLE_EQ(both.value, -20.);
  EXPECT_NEAR(both.error, 20. * std::hypot(0.03, 0.04), 1e-12);
}
