// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/observers/case_averages.h>
#include <graupel/simulation/parameters/averages_parameters.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  const std::string line = "low: -0.02 0 0.015 0.02 0 0.015 20 0.01 0.002";

  std::string
  offender(const AveragesParameters &averages)
  {
    try
      {
        averages.check();
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return "";
  }
} // namespace

// A line along x reaches its width along y and its thickness along z; one along z, along
// x and y; the points of a plane are in the middle of its thickness. Rounding.
TEST(BinGrid, LiesWhereItsTextSays)
{
  const auto grids = read_lines("p", line + " | up: 0 0 0.01 0 0 0.05 4 0.004 0.006");
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].name, "low");
  EXPECT_EQ(grids[0].n_bins(), 20u);
  EXPECT_NEAR(grids[0].middle_of(0).distance({-0.019, 0., 0.015}), 0., 1e-15);
  EXPECT_NEAR(
    grids[0].point_of(19, {1., 1., 1.}).distance({0.02, 0.005, 0.016}), 0., 1e-15);
  EXPECT_NEAR(grids[1].middle_of(3).distance({0., 0., 0.045}), 0., 1e-15);
  EXPECT_NEAR(
    grids[1].point_of(0, {0., 0., 0.}).distance({-0.002, -0.003, 0.01}), 0., 1e-15);

  const auto plane = read_planes("p", "mid: -1 0 0  1 0 0  -1 0 4  2 8 0.5")[0];
  EXPECT_EQ(plane.n_bins(), 16u);
  EXPECT_NEAR(plane.middle_of(3).distance({0.5, 0., 0.75}), 0., 1e-15);
}

// Law: the bin of a bin's point is the bin; there is none outside.
TEST(BinGrid, FindsTheBinOfAPoint)
{
  const auto grid = read_planes("p", "tilted: 1 2 3  2 3 3  0 3 3  3 5 0.5")[0];
  for (unsigned int bin = 0; bin < grid.n_bins(); ++bin)
    for (const double part : {0.01, 0.5, 0.99})
      EXPECT_EQ(*grid.bin_at(grid.point_of(bin, {part, 1. - part, part})), bin);
  EXPECT_FALSE(grid.bin_at(grid.point_of(0, {-0.01, 0.5, 0.5})));
  EXPECT_FALSE(grid.bin_at(grid.point_of(0, {0.5, 0.5, 1.01})));
}

TEST(AveragesParameters, RefuseByName)
{
  AveragesParameters averages;
  EXPECT_EQ(offender(averages), "");
  EXPECT_FALSE(averages.are_wanted());
  averages.lines = line;
  EXPECT_EQ(offender(averages), "Averages/to");
  averages.to = 2.;
  EXPECT_EQ(offender(averages), "");
  for (const char *bad : {"0 0 0 1 0 0 4 1 1",
                          "a: 0 0 0 1 0 0 4 1",
                          "a: 0 0 0 0 0 0 4 1 1",
                          "a: 0 0 0 1 0 0 0.5 1 1",
                          "a: 0 0 0 1 0 0 4 0 1",
                          "a b: 0 0 0 1 0 0 4 1 1",
                          "a: 0 0 0 1 0 0 4 1 1 | a: 0 0 0 1 0 0 4 1 1"})
    {
      averages.lines = bad;
      EXPECT_EQ(offender(averages), "Averages/lines") << bad;
    }
  averages.lines  = "";
  averages.planes = "a: 0 0 0  1 0 0  1 1 0  2 2 1";
  EXPECT_EQ(offender(averages), "Averages/planes") << "no right angle";
  averages.planes = "";
  averages.from   = 3.;
  EXPECT_EQ(offender(averages), "Averages/to");
  averages.from     = 0.;
  averages.interval = std::nan("");
  EXPECT_EQ(offender(averages), "Averages/interval");
}

// Law: the parts of all steps in the window add up to it, wherever its ends lie, and no
// part is a rounding's.
TEST(AveragesParameters, StepsShareOutTheWindow)
{
  AveragesParameters averages;
  averages.from      = 0.25;
  averages.to        = 0.7;
  double       sum   = 0.;
  unsigned int taken = 0;
  for (unsigned int k = 0; k < 100; ++k)
    {
      const double part = averages.time_within(0.01 * k, 0.01 * (k + 1));
      EXPECT_TRUE(part == 0. || part > 1e-3);
      sum += part;
      taken += averages.is_snapshot_due(0.01 * k, 0.01 * (k + 1));
    }
  EXPECT_NEAR(sum, 0.45, 1e-14);
  EXPECT_EQ(taken, averages.snapshots);
}

// Law: mean, rms and frequency of V0 + V1 sin over whole periods; the first two to
// rounding, the last to a twentieth of the spectrum's step. What rests has no frequency,
// what has not always a value no spectrum.
TEST(Statistics, OfASine)
{
  constexpr double    pi = 3.14159265358979323846, frequency = 12.5;
  std::vector<double> times, weights, values, rest;
  for (unsigned int k = 1; k <= 800; ++k)
    {
      times.push_back(2e-3 * k);
      weights.push_back(2e-3);
      values.push_back(3. + 2. * std::sin(2. * pi * frequency * times.back()));
      rest.push_back(3. + 1e-9 * values.back());
    }
  const auto sine = statistics_of(times, weights, values);
  EXPECT_EQ(sine.samples, 800u);
  EXPECT_NEAR(*sine.mean, 3., 1e-12);
  EXPECT_NEAR(*sine.rms, std::sqrt(2.), 1e-12);
  EXPECT_NEAR(*sine.frequency, frequency, 0.05 * sine.spectrum.frequency[0]);
  EXPECT_FALSE(statistics_of(times, weights, rest).frequency);

  values[7]         = std::nan("");
  const auto broken = statistics_of(times, weights, values);
  EXPECT_EQ(broken.samples, 799u);
  EXPECT_TRUE(broken.spectrum.frequency.empty());
  EXPECT_FALSE(broken.error);
  EXPECT_FALSE(statistics_of({}, {}, {}).mean);
}
