// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/dem/bed/sphere_cuts.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>

#include <random>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;

  // Inside, outside, the lens of two unit circles through each other's center,
  // and one so thin that its angles are below the rounding of a cosine; its area is
  // that of two parabolic segments to a relative height / 10.
  TEST(SphereCuts, DiscsInCommon)
  {
    EXPECT_EQ(disc_overlap(3., 1., 2.), PI);
    EXPECT_EQ(disc_overlap(1., 3., 1.5), PI);
    EXPECT_EQ(disc_overlap(1., 1., 2.), 0.);
    EXPECT_EQ(disc_overlap(1., 1., 0.), PI);
    const double lens = 2. * PI / 3. - std::sqrt(3.) / 2.;
    EXPECT_NEAR(disc_overlap(1., 1., 1.), lens, 1e-15);
    // The lens is 4e-12 of a disc: what rounding leaves of it is five digits.
    const double height = 1e-8;
    const double thin   = 2. * 4. / 3. * height * std::sqrt(2. * height);
    EXPECT_NEAR(disc_overlap(1., 1., 2. - 2. * height), thin, 1e-4 * thin);
  }

  // Closed forms: whole; a coaxial bore; Viviani's cut, 2 pi / 3 - 8 / 9, where the
  // circles touch at the ends of the height and at its middle; slices of
  // all of them add up. Limit: the quadrature; the slices are 22, of other intervals.
  TEST(SphereCuts, SphereInATube)
  {
    const double ball = sphere_volume(1.);
    EXPECT_EQ(sphere_volume_in_tube(1., 2., 3., -1., 1.), ball);
    EXPECT_EQ(sphere_volume_in_tube(1., 2., 1., -1., 1.), 0.);
    for (const double R : {0.05, 0.5, 0.999})
      EXPECT_NEAR(sphere_volume_in_tube(1., 0., R, -1., 1.),
                  ball - 4. / 3. * PI * std::pow(1. - R * R, 1.5),
                  1e-12);
    EXPECT_NEAR(
      sphere_volume_in_tube(1., 0.5, 0.5, -1., 1.), 2. * PI / 3. - 8. / 9., 1e-12);
    double worst = 0.;
    for (const double s : {0., 1e-9, 0.1, 0.5, 0.9, 3., 7.3})
      for (double R = s - 0.95; R < s + 1.; R += 0.1)
        if (R > 0.)
          {
            const double whole = sphere_volume_in_tube(1., s, R, -2., 2.);
            double       sum   = 0.;
            for (double z = -1.1; z < 1.1; z += 0.1)
              sum += sphere_volume_in_tube(1., s, R, z, z + 0.1);
            worst = std::max(worst, std::abs(sum - whole));
          }
    std::cout << "slices of a sphere in a tube differ by " << worst << " (1e-10)\n";
    EXPECT_LT(worst, 1e-10);
  }

  // Spheres at random places of the cylinder, some on the axis, overlapping as
  // they like; on all ranks the same, or shared out.
  ParticleArrays
  random_spheres(const Cylinder &cylinder, const bool shared_out)
  {
    const unsigned int me    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::mt19937_64    generator(4);
    std::uniform_real_distribution<> random(0., 1.);
    ParticleArrays                   p;
    for (unsigned int i = 0; i < 40; ++i)
      {
        const double r     = 1e-3 * (0.5 + random(generator)),
                     angle = 2. * PI * random(generator);
        const double s =
          (i % 10 == 0 ? 0. : 1.) * random(generator) * (cylinder.diameter / 2. - r);
        const double z = cylinder.height * random(generator);
        if (shared_out && i % ranks != me)
          continue;
        p.resize(++p.n_owned);
        p.body.back().radius   = r;
        p.body.back().position = {s * std::cos(angle), s * std::sin(angle), z};
      }
    return p;
  }

  // Law: the shells together hold the solid between their planes, and each holds
  // what points thrown at random find there: 4 standard deviations, which one of
  // 25 shells exceeds by chance in 600 seeds. Any number of ranks gives the same
  // bits.
  TEST(ShellVoidFractions, HoldAllOfTheSolid)
  {
    const Cylinder cylinder = SmallColumn::vessel();
    const double   lower = 0.004, upper = 0.021;
    const auto     spheres   = random_spheres(cylinder, true);
    const auto     everybody = random_spheres(cylinder, false);
    // 25.64 widths: the last shell is thinner.
    const double width = cylinder.diameter / 2. / 25.64;
    const auto   shells =
      shell_void_fractions(spheres, cylinder, width, lower, upper, MPI_COMM_WORLD);
    const auto alone =
      shell_void_fractions(everybody, cylinder, width, lower, upper, MPI_COMM_SELF);
    ASSERT_EQ(shells.size(), 26u);
    EXPECT_DOUBLE_EQ(shells.back().to, cylinder.diameter / 2.);

    double     solid = 0.;
    const auto area  = [&](const RadialShell &shell) {
      return PI * (shell.to - shell.from) * (cylinder.diameter - shell.from - shell.to);
    };
    for (std::size_t k = 0; k < shells.size(); ++k)
      {
        EXPECT_EQ(shells[k].void_fraction, alone[k].void_fraction) << "shell " << k;
        solid += (1. - shells[k].void_fraction) * area(shells[k]) * (upper - lower);
      }
    const double expected = BedObservables(everybody, Vessel(cylinder), MPI_COMM_SELF)
                              .solid_volume_between(lower, upper);
    std::cout << "solid in the shells " << solid << " m^3, in all " << expected << '\n';
    EXPECT_NEAR(solid, expected, 1e-9 * expected);

    // Overlapping spheres count twice, so the points count spheres.
    std::mt19937_64                  generator(5);
    std::uniform_real_distribution<> random(0., 1.);
    constexpr unsigned int           n_points = 20000;
    double                           worst    = 0.;
    for (const RadialShell &shell : shells)
      {
        const double outer = cylinder.diameter / 2. - shell.from;
        const double inner = cylinder.diameter / 2. - shell.to;
        double       hits = 0., squares = 0.;
        for (unsigned int n = 0; n < n_points; ++n)
          {
            const double rho = std::sqrt(inner * inner + (outer * outer - inner * inner) *
                                                           random(generator));
            const double angle = 2. * PI * random(generator);
            const Point<3> x(rho * std::cos(angle),
                             rho * std::sin(angle),
                             lower + (upper - lower) * random(generator));
            double         inside = 0.;
            for (const Body &body : everybody.body)
              inside += x.distance_square(body.position) < body.radius * body.radius;
            hits += inside;
            squares += inside * inside;
          }
        const double mean = hits / n_points;
        const double deviation =
          std::sqrt((squares / n_points - mean * mean) / n_points) + 1e-12;
        worst = std::max(worst, std::abs(1. - shell.void_fraction - mean) / deviation);
      }
    std::cout << "worst shell: " << worst << " standard deviations (4)\n";
    EXPECT_LT(worst, 4.);
  }

  BedProfiles
  profiles_at_rest(SmallColumn &column, const double height)
  {
    column.dem.synchronise();
    BedObservables::Bed bed;
    bed.top = bed.height = height;
    return bed_profiles(column.dem, bed, column.dem.parameters().particles.diameter);
  }

  // Law: n spheres on top of each other at rest; through a plane goes the
  // weight of those above it, and none of it to the wall. What moves still is damped
  // by a half each bounce, of which 0.5 s hold hundreds: 1e-6 of a weight is left.
  class Stack : public testing::TestWithParam<unsigned int>
  {
  };

  TEST_P(Stack, CarriesTheWeightAbove)
  {
    const unsigned int    n = GetParam();
    SmallColumn           column(SmallColumn::parameters());
    std::vector<Point<3>> centers;
    const double          d = 2e-3;
    for (unsigned int k = 0; k < n; ++k)
      centers.emplace_back(0., 0., (k + 0.5) * d);
    column.dem.insert(centers);
    column.dem.advance(0.5);

    const auto   bed    = profiles_at_rest(column, n * d);
    const double weight = column.dem.weight() / n;
    ASSERT_EQ(bed.loads.size(), 2 * n + 1);
    double worst = 0.;
    for (const LoadLevel &level : bed.loads)
      {
        // Planes at centers are just above these, which overlaps have lowered.
        const auto above =
          n - static_cast<unsigned int>(std::floor(level.height / d + 0.5 + 1e-9));
        worst = std::max(worst, std::abs(level.load / weight - above));
        EXPECT_NEAR(level.weight, above * weight, 1e-9 * weight) << level.height;
        EXPECT_EQ(level.wall_load, 0.);
      }
    std::cout << n << " spheres: loads are off by " << worst << " weights (1e-6)\n";
    EXPECT_LT(worst, 1e-6);

    // Every sphere has one neighbour above and one below; the lowest has the bottom.
    std::vector<unsigned long> expected(n > 2 ? 3 : n, 0), with_walls(n > 1 ? 3 : 2, 0);
    for (unsigned int k = 0; k < n; ++k)
      {
        ++expected[(k > 0) + (k + 1 < n)];
        ++with_walls[1 + (k + 1 < n)];
      }
    EXPECT_EQ(bed.histogram, expected);
    EXPECT_EQ(bed.histogram_with_walls, with_walls);
  }

  INSTANTIATE_TEST_SUITE_P(OfSpheres, Stack, testing::Values(1u, 2u, 6u));

  // A cubic lattice of 3 x 3 x 3 free spheres that just overlap: 8 corners with 3
  // contacts, 12 edges with 4, 6 faces with 5, one inside with 6. Exact,
  // also where the border between ranks runs through it.
  TEST(Coordination, OfACubicLattice)
  {
    SmallColumn column(SmallColumn::parameters());
    column.dem.set_gravity(0.);
    const double          d = 2e-3, pitch = 0.999 * d, bottom = 0.013;
    std::vector<Point<3>> centers;
    for (int i = -1; i < 2; ++i)
      for (int j = -1; j < 2; ++j)
        for (int k = -1; k < 2; ++k)
          centers.emplace_back(i * pitch, j * pitch, bottom + (k + 1.5) * pitch);
    column.dem.insert(centers);
    column.dem.advance(column.dem.substep());
    column.dem.synchronise();

    const auto &particles = column.dem.particles();
    const auto  counts    = count_contacts(particles, column.dem.contact_states(true));
    const auto  comm      = column.dem.communicator();
    const std::vector<unsigned long> expected{0, 0, 0, 8, 12, 6, 1};
    EXPECT_EQ(coordination_histogram(counts, false, comm), expected);
    EXPECT_EQ(coordination_histogram(counts, true, comm), expected);
    const auto slabs = coordination_profile(
      particles,
      counts,
      {0., bottom, bottom + pitch, bottom + 2. * pitch, bottom + 3. * pitch},
      comm);
    ASSERT_EQ(slabs.size(), 4u);
    EXPECT_EQ(slabs[0].n_particles, 0u);
    EXPECT_EQ(slabs[0].particles, 0.);
    for (const unsigned int k : {1, 2, 3})
      {
        EXPECT_EQ(slabs[k].n_particles, 9u);
        EXPECT_DOUBLE_EQ(slabs[k].particles, (k == 2 ? 42. : 33.) / 9.);
        EXPECT_EQ(slabs[k].walls, 0.);
      }
    EXPECT_DOUBLE_EQ(column.dem.coordination_number(), 108. / 27.);
  }

  // Law: in a bed at rest, weight above = load through the plane + load on the wall
  // above, at every plane, to the accelerations that rest leaves: 0.5 % of the
  // weight. At the bottom the two are what the walls feel. The profiles agree with
  // the numbers that are got in other ways.
  TEST(Bed, JanssenProfileBalancesTheWeight)
  {
    SmallColumn       column(SmallColumn::parameters());
    FillingParameters fill;
    fill.count      = 150;
    fill.bed_height = 0.;
    Filling filling(fill, column.dem);
    while (filling.step())
      {
      }
    SettlingParameters rest;
    rest.kinetic_energy = 1e-13;
    rest.speed          = 1e-3;
    Settling settling(rest, column.dem);
    while (settling.step())
      {
      }
    column.dem.advance(0.02);
    const auto bed = profiles_at_rest(
      column,
      BedObservables(column.dem.particles(), column.dem.vessel_shape(), MPI_COMM_WORLD)
        .bed()
        .height);

    const double weight = column.dem.weight();
    double       worst  = 0.;
    for (const LoadLevel &level : bed.loads)
      worst =
        std::max(worst, std::abs(level.weight - level.load - level.wall_load) / weight);
    std::cout << "weight - load - wall load: at most " << worst
              << " of the weight (0.005)\n";
    EXPECT_LT(worst, 5e-3);
    EXPECT_NEAR(bed.loads[0].weight, weight, 1e-9 * weight);
    EXPECT_NEAR(bed.loads[0].load, column.dem.bottom_force(), 5e-3 * weight);
    EXPECT_NEAR(bed.loads[0].wall_load, column.dem.wall_force(), 5e-3 * weight);

    double contacts = 0., particles = 0.;
    for (std::size_t n = 0; n < bed.histogram.size(); ++n)
      {
        contacts += n * bed.histogram[n];
        particles += bed.histogram[n];
      }
    EXPECT_EQ(particles, 150.);
    EXPECT_DOUBLE_EQ(contacts / particles, column.dem.coordination_number());
    // Spheres touch the wall at points: next to it there is almost only void, and
    // half a diameter away the densest place.
    EXPECT_GT(bed.radial.front().void_fraction, 0.85);
    EXPECT_LT(bed.radial[10].void_fraction, 0.35);
  }
} // namespace
