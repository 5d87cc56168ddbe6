// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/bed/sphere_cuts.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace graupel;
  using dealii::numbers::PI;

  // Closed forms: the whole sphere, halves, an eighth; the cap; two right-angled wedges.
  // The one whose edge touches the sphere is empty. Rounding.
  TEST(SphereInABox, WhatIsKnown)
  {
    const double ball = 4. / 3. * PI;
    const auto   part = [](const std::array<double, 3> &lower) {
      return sphere_volume_in_box(1., lower, {{2., 2., 2.}});
    };
    EXPECT_NEAR(part({{-2., -2., -2.}}), ball, 1e-14);
    EXPECT_NEAR(part({{0., -2., -2.}}), ball / 2., 1e-14);
    EXPECT_NEAR(part({{0., 0., 0.}}), ball / 8., 1e-14);
    EXPECT_NEAR(part({{-2., 0.5, -2.}}), sphere_volume_below(1., 0.5), 1e-14);
    EXPECT_NEAR(part({{-2., 0., 0.3}}), 0.5 * sphere_volume_below(1., 0.7), 1e-14);
    EXPECT_NEAR(part({{-2., 0.6, 0.8}}), 0., 1e-14);
    EXPECT_NEAR(part({{0.6, 0.6, 0.6}}), 0., 1e-14);
    EXPECT_EQ(part({{1., -2., -2.}}), 0.);
    EXPECT_NEAR(
      sphere_volume_in_box(3., {{0., 0., 0.}}, {{9., 9., 9.}}), 27. * ball / 8., 1e-12);
  }

  // Law: the height over each point of the section, summed over it, is the volume. Limit:
  // a grid of n points a side errs at the rim, where the height is that of a root, by
  // n^-1.5 of the box.
  TEST(SphereInABox, IsTheSumOfItsHeights)
  {
    std::mt19937                     random(3);
    std::uniform_real_distribution<> anywhere(-1.3, 1.3);
    constexpr unsigned int           n     = 300;
    double                           worst = 0.;
    for (unsigned int trial = 0; trial < 60; ++trial)
      {
        std::array<double, 3> lower, upper;
        for (unsigned int i = 0; i < 3; ++i)
          std::tie(lower[i], upper[i]) =
            std::minmax({anywhere(random), anywhere(random)});
        const double dx = (upper[0] - lower[0]) / n, dy = (upper[1] - lower[1]) / n;
        double       sum = 0.;
        for (unsigned int k = 0; k < n * n; ++k)
          {
            const double x = lower[0] + (k % n + 0.5) * dx;
            const double y = lower[1] + (k / n + 0.5) * dy;
            const double h = std::sqrt(std::max(0., 1. - x * x - y * y));
            sum += std::max(0., std::min(h, upper[2]) - std::max(-h, lower[2]));
          }
        worst = std::max(
          worst, std::abs(sum * dx * dy - sphere_volume_in_box(1., lower, upper)));
      }
    std::cout << "differ by " << worst << " at most\n";
    EXPECT_LT(worst, 2.6 * 2.6 * std::pow(n, -1.5));
  }

  // Law: boxes that fill space share out the sphere. Rounding.
  TEST(SphereInABox, BoxesShareOutTheSphere)
  {
    constexpr double side = 0.37;
    double           sum  = 0.;
    for (int i = -4; i < 4; ++i)
      for (int j = -4; j < 4; ++j)
        for (int k = -4; k < 4; ++k)
          sum += sphere_volume_in_box(
            1.,
            {{i * side + 0.1, j * side, k * side - 0.05}},
            {{(i + 1) * side + 0.1, (j + 1) * side, (k + 1) * side - 0.05}});
    EXPECT_NEAR(sum, 4. / 3. * PI, 1e-13);
  }

  // Spheres of many sizes, shared out among the ranks.
  struct Cloud
  {
    Cloud()
    {
      const auto   me    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const auto   ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      std::mt19937 random(5);
      std::uniform_real_distribution<> part(0., 1.);
      for (unsigned int k = 0; k < 300; ++k)
        {
          Body body;
          body.radius   = 1e-3 * (0.1 + part(random));
          body.position = {0., 0., 0.05 * part(random)};
          all.push_back(body);
          if (k % ranks != me)
            continue;
          particles.resize(++particles.n_owned);
          particles.body.back() = body;
          particles.mass.back() = mass_of(body);
        }
    }

    static double
    mass_of(const Body &body)
    {
      return 1000. * sphere_volume(body.radius);
    }

    std::vector<Body> all;
    ParticleArrays    particles;
  };

  // Law: the sum over all spheres, one by one, on any number of ranks; for planes in any
  // order, also those that touch a sphere. Limit: the quanta of the sums, 2^-36 of the
  // largest sphere each.
  TEST(SolidBelow, IsTheSumOverAllSpheres)
  {
    const Cloud         cloud;
    std::vector<double> planes{0.02, -1., 1., 0.03, 0.03, 0.01};
    for (unsigned int k = 0; k < 20; ++k)
      {
        planes.push_back(cloud.all[k].position[2] - cloud.all[k].radius);
        planes.push_back(cloud.all[k].position[2] + cloud.all[k].radius);
      }
    const auto   found  = SolidBelow(cloud.particles, MPI_COMM_WORLD).at(planes);
    const double quanta = cloud.all.size() * 0x1p-36 * sphere_volume(1.1e-3);
    for (std::size_t k = 0; k < planes.size(); ++k)
      {
        double sum = 0.;
        for (const Body &body : cloud.all)
          sum +=
            sphere_volume_below(body.radius, planes[k] - body.position[2] + body.radius);
        EXPECT_NEAR(found[k], sum, quanta) << "below " << planes[k];
      }
  }

  TEST(SolidBelow, NothingOfNothing)
  {
    const ParticleArrays nothing;
    const SolidBelow     solid(nothing, MPI_COMM_WORLD);
    EXPECT_EQ(solid.largest_radius(), 0.);
    EXPECT_EQ(solid.at({0., 1.})[1], 0.);
  }

  // Law: the mean height by mass. Limit: the quanta.
  TEST(BedObservables, CenterOfMass)
  {
    const Cloud cloud;
    double      mass = 0., moment = 0.;
    for (const Body &body : cloud.all)
      {
        mass += Cloud::mass_of(body);
        moment += Cloud::mass_of(body) * body.position[2];
      }
    Cylinder tube;
    EXPECT_NEAR(
      BedObservables(cloud.particles, Vessel(tube), MPI_COMM_WORLD).center_of_mass(),
      moment / mass,
      1e-8 * moment / mass);
  }
} // namespace
