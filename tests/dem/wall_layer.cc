// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/wall_layer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{
  using namespace graupel;

  constexpr double tube = 0.0125; // [m]

  // Shells of @p width with the mean of a solid fraction by the distance from the wall.
  std::vector<RadialShell>
  shells_of(const std::function<double(double)> &solid, const double width)
  {
    std::vector<RadialShell> shells;
    const auto               n = static_cast<unsigned int>(std::lround(tube / width));
    for (unsigned int k = 0; k < n; ++k)
      {
        double area = 0., sum = 0.;
        for (unsigned int q = 0; q < 100; ++q)
          {
            const double y = (k + (q + 0.5) / 100.) * width;
            area += tube - y;
            sum += (tube - y) * solid(y);
          }
        shells.push_back({k * width, (k + 1) * width, 1. - sum / area});
      }
    return shells;
  }

  // The mean over the section, by the midpoint rule.
  double
  mean_of(const std::function<double(double)> &solid)
  {
    constexpr unsigned int n   = 100000;
    double                 sum = 0.;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double y = (k + 0.5) / n * tube;
        sum += 2. * (tube - y) / tube / n * solid(y);
      }
    return sum;
  }

  // A layer of 0.9 mm with 0.35 around a core of 0.6 is found as it is, and makes the bed
  // of particles a third as large that has 0.3 mm of it.
  TEST(WallLayer, OfALayerAndACore)
  {
    const auto layer_of = [](const double thickness) {
      return [thickness](const double y) { return y < thickness ? 0.35 : 0.6; };
    };
    const WallLayer layer = find_wall_layer(shells_of(layer_of(9e-4), 1e-4));
    EXPECT_NEAR(layer.thickness, 9e-4, 1e-15);
    EXPECT_NEAR(layer.solid_fraction, 0.35, 1e-12);
    EXPECT_NEAR(layer.core_solid_fraction, 0.6, 1e-12);
    EXPECT_NEAR(layer.mean_solid_fraction(), mean_of(layer_of(9e-4)), 1e-6);
    EXPECT_NEAR(layer.mean_solid_fraction(3.), mean_of(layer_of(3e-4)), 1e-6);
    EXPECT_NEAR(layer.mean_solid_fraction(1e9), 0.6, 1e-9);
  }

  // Law: the layer ends where the bed is first as dense as farther in, so what follows is
  // at its extreme there: half and twice the width of the shells give the same to second
  // order. The profile oscillates as that of spheres of 3 mm does.
  TEST(WallLayer, DoesNotDependOnTheShells)
  {
    const auto solid = [](const double y) {
      const double z = y / 3e-3;
      return 0.6 - 0.6 * std::exp(-1.5 * z) * std::cos(2.2 * M_PI * z);
    };
    const WallLayer fine   = find_wall_layer(shells_of(solid, 2.5e-5));
    const WallLayer coarse = find_wall_layer(shells_of(solid, 1e-4));
    EXPECT_NEAR(fine.thickness / 3e-3, 1. / 4.4, 0.02);
    EXPECT_NEAR(fine.mean_solid_fraction(), mean_of(solid), 1e-4);
    EXPECT_NEAR(coarse.mean_solid_fraction(2.), fine.mean_solid_fraction(2.), 2e-4);
  }

  // A bed that is as dense at the wall as elsewhere is the same at any size.
  TEST(WallLayer, NoneInAnEvenBed)
  {
    const WallLayer layer =
      find_wall_layer(shells_of([](const double) { return 0.55; }, 5e-4));
    EXPECT_NEAR(layer.mean_solid_fraction(), 0.55, 1e-12);
    EXPECT_NEAR(layer.mean_solid_fraction(4.), 0.55, 1e-12);
    EXPECT_THROW(find_wall_layer({}), std::invalid_argument);
  }
} // namespace
