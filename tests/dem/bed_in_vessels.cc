// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "shapes.h"

#include <graupel/dem/bed/bed_observables.h>

#include <gtest/gtest.h>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;

  // Spheres on a simple cubic lattice in a cylinder of the cross-section that the
  // lattice has, shared out among the ranks.
  class Layers : public testing::Test
  {
  protected:
    Layers()
      : tube(Cylinder{std::sqrt(4. / PI * n * n) * d, 60. * d})
    {
    }

    // Layers one on the other, the lowest on the plane z.
    void
    add_layers(const unsigned int count, const double z)
    {
      for (unsigned int k = 0; k < n * n * count; ++k)
        add(Point<3>((k % n) * d, (k / n % n) * d, z + (k / (n * n) + 0.5) * d));
    }

    void
    add(const Point<3> &x)
    {
      if (n_added++ % dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) !=
          dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD))
        return;
      particles.resize(++particles.n_owned);
      particles.body.back().radius   = d / 2.;
      particles.body.back().position = x;
    }

    BedObservables::Bed
    bed_in(const Vessel &vessel) const
    {
      return BedObservables(particles, vessel, MPI_COMM_WORLD).bed();
    }

    void
    expect_bed(const BedObservables::Bed &bed, const double bottom, const double height)
    {
      std::cout << "bed from " << bed.bottom << " to " << bed.top << " m, expanded "
                << bed.expanded_height << ", void fraction " << bed.mean_void_fraction
                << '\n';
      EXPECT_TRUE(bed.exists);
      EXPECT_NEAR(bed.bottom, bottom, 1e-5 * d);
      EXPECT_NEAR(bed.height, height, 1e-5 * d);
      EXPECT_NEAR(bed.top - bed.bottom, bed.height, 1e-9 * d);
      EXPECT_NEAR(bed.expanded_height, height, 0.1 * d);
      EXPECT_NEAR(bed.mean_void_fraction, 1. - PI / 6., 1e-5);
      EXPECT_NEAR(bed.bulk_solid_fraction, PI / 6., 1e-5);
    }

    void
    expect_no_bed(const BedObservables::Bed &bed)
    {
      EXPECT_FALSE(bed.exists);
      EXPECT_EQ(bed.height, 0.);
      EXPECT_EQ(bed.expanded_height, 0.);
      EXPECT_EQ(bed.mean_void_fraction, 1.);
    }

    static constexpr int    n = 5;
    static constexpr double d = 2e-3;
    const Cylinder          tube;
    ParticleArrays          particles;
    unsigned int            n_added = 0;
  };

  HalfSpace
  level(const double z, const double up)
  {
    return {Point<3>(0., 0., z), dealii::Tensor<1, 3>({0., 0., up})};
  }

  // The same bed wherever it is: on the bottom, on a plane above it, on a plane of
  // which the vessel does not know (a grid), in the air, under the lid. Limits: the
  // bisection.
  TEST_F(Layers, OnTheBottom)
  {
    add_layers(20, 0.);
    expect_bed(bed_in(Vessel(tube)), 0., 20. * d);
  }

  TEST_F(Layers, OnARaisedFloor)
  {
    add_layers(20, 0.003);
    expect_bed(bed_in(Vessel(tube, {level(0.003, -1.)})), 0.003, 20. * d);
  }

  TEST_F(Layers, InTheAir)
  {
    add_layers(20, 17.3 * d);
    expect_bed(bed_in(Vessel(tube)), 17.3 * d, 20. * d);
  }

  TEST_F(Layers, UnderTheLid)
  {
    add_layers(20, 40. * d);
    expect_bed(bed_in(Vessel(tube)), 40. * d, 20. * d);
    expect_bed(bed_in(Vessel(tube, {level(60. * d, 1.)})), 40. * d, 20. * d);
  }

  TEST_F(Layers, UnderALowerLid)
  {
    add_layers(20, 30. * d);
    expect_bed(bed_in(Vessel(tube, {level(50. * d, 1.)})), 30. * d, 20. * d);
  }

  // Stragglers below a slug are not its bottom, those above not its top.
  TEST_F(Layers, StragglersDoNotCount)
  {
    add_layers(20, 17. * d);
    add(Point<3>(0., 0., d / 2.));
    add(Point<3>(d, 0., 5. * d));
    add(Point<3>(0., d, 50. * d));
    const auto bed = bed_in(Vessel(tube));
    EXPECT_NEAR(bed.bottom, 17. * d, 1e-5 * d);
    EXPECT_NEAR(bed.height, 20. * d, 1e-5 * d);
    EXPECT_NEAR(bed.mean_void_fraction, 1. - PI / 6., 1e-5);
    // Each by twice its part of the solid, times its way: at most 2 / 500 of 20 d.
    EXPECT_NEAR(bed.expanded_height, 20. * d, 0.3 * d);
  }

  TEST_F(Layers, WhatIsNoBed)
  {
    const Vessel vessel(tube);
    expect_no_bed(bed_in(vessel)); // none
    add(Point<3>(0., 0., d / 2.));
    expect_no_bed(bed_in(vessel)); // one
    add(Point<3>(2. * d, 0., 7. * d));
    expect_no_bed(bed_in(vessel)); // two, one in the air
    add(Point<3>(d, d, 33. * d));
    expect_no_bed(bed_in(vessel)); // three, far apart
    add_layers(1, 0.);
    expect_no_bed(bed_in(vessel)); // one layer
  }

  TEST_F(Layers, ASphereInTheAirOrUnderTheLid)
  {
    add(Point<3>(0., 0., 60. * d - d / 2.));
    expect_no_bed(bed_in(Vessel(tube)));
  }

  // More solid than spheres can be is no bed, and no void fraction.
  TEST_F(Layers, OverlappingSpheres)
  {
    add_layers(4, 0.);
    add_layers(4, 0.1 * d);
    expect_no_bed(bed_in(Vessel(tube)));
  }

  // A bubble as wide as the vessel does not end the bed, wherever it is: its top is that
  // of what lies above, with 5 % of the solid and more. Less than that above it is spray.
  // Limit: with a bubble in it the middle half is less dense, by which the top is found.
  TEST_F(Layers, ABubbleDoesNotEndTheBed)
  {
    for (const unsigned int below : {4, 18, 20, 22, 36})
      {
        particles = ParticleArrays();
        n_added   = 0;
        add_layers(below, 0.);
        add_layers(40 - below, (below + 5.) * d);
        const auto bed = bed_in(Vessel(tube));
        EXPECT_TRUE(bed.exists);
        EXPECT_EQ(bed.bottom, 0.);
        EXPECT_NEAR(bed.top, 45. * d, 0.1 * d) << below << " layers below the bubble";
      }
    particles = ParticleArrays();
    n_added   = 0;
    add_layers(39, 0.);
    add_layers(1, 44. * d);
    EXPECT_NEAR(bed_in(Vessel(tube)).top, 39. * d, 0.1 * d);
  }

  // A bed of 40 layers comes apart: the upper ones rise by 20 diameters. Law: the
  // expanded height never changes by more than twice the way of the slug, and in the end
  // by twice its part of the solid, times its way.
  TEST_F(Layers, SlugsMakeTheExpandedHeightNotJump)
  {
    for (const unsigned int above : {4, 20})
      {
        const Vessel vessel(tube);
        const double step   = d / 8.;
        double       before = 0., jump_of_height = 0., jump = 0., last = 0.;
        for (unsigned int k = 0; k <= 160; ++k)
          {
            particles = ParticleArrays();
            n_added   = 0;
            add_layers(40 - above, 0.);
            add_layers(above, (40. - above) * d + k * step);
            const auto bed = bed_in(vessel);
            if (k == 0)
              {
                EXPECT_NEAR(bed.expanded_height, 40. * d, 0.1 * d);
              }
            else
              {
                jump           = std::max(jump, std::abs(bed.expanded_height - last));
                jump_of_height = std::max(jump_of_height, std::abs(bed.height - before));
              }
            last   = bed.expanded_height;
            before = bed.height;
          }
        const double rise = 2. * above / 40. * 20. * d;
        std::cout << above << " layers: expanded height jumps by " << jump / step
                  << " steps at most, the height by " << jump_of_height / step
                  << "; rise " << (last - 40. * d) / d << " d, " << rise / d
                  << " expected\n";
        EXPECT_LT(jump, 2.1 * step);
        EXPECT_NEAR(last, 40. * d + rise, d);
      }
  }

  // Particle by particle, a slug rains down through a gap of 15 diameters. Law: each
  // changes the height by twice its part of the solid, times its way, and by what it
  // takes from one front and gives to the other, a few times its share of a layer.
  TEST_F(Layers, RainFromASlugMakesNoJump)
  {
    const Vessel       vessel(tube);
    const unsigned int per_layer = n * n, slug = 10, rest = 30;
    const double       gap  = 15.;
    double             last = 0., jump = 0.;
    for (unsigned int fallen = 0; fallen <= slug * per_layer; fallen += 5)
      {
        particles = ParticleArrays();
        n_added   = 0;
        add_layers(rest, 0.);
        for (unsigned int k = 0; k < slug * per_layer; ++k)
          {
            const double z =
              k < fallen ? rest + k / per_layer : rest + gap + k / per_layer;
            add(Point<3>((k % n) * d, (k / n % n) * d, (z + 0.5) * d));
          }
        const double height = bed_in(vessel).expanded_height;
        if (fallen > 0)
          jump = std::max(jump, std::abs(height - last));
        last = height;
      }
    const double part = 5. / ((slug + rest) * per_layer), way = gap * d;
    const double bound = 2. * part * way + 4. * (5. / per_layer) * d;
    std::cout << "five spheres fall by 15 d: the height changes by " << jump / d
              << " d at most (" << bound / d << ")\n";
    EXPECT_LT(jump, bound);
    EXPECT_NEAR(last, (rest + slug) * d, 0.1 * d);
  }
} // namespace
