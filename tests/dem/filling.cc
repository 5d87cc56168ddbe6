// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>
#include <graupel/dem/particles/dem_error.h>

#include <fstream>

namespace
{
  using namespace graupel;
  using dealii::Point;

  FillingParameters
  by_count(const std::string &method, const unsigned int count)
  {
    FillingParameters filling;
    filling.method     = method;
    filling.count      = count;
    filling.bed_height = 0.;
    return filling;
  }

  DemParameters
  with_open_bottom()
  {
    DemParameters parameters = SmallColumn::parameters();
    parameters.walls.bottom  = "open";
    return parameters;
  }

  // The parameter that @p check finds fault with, and what it says.
  template <class Check>
  InputError
  fault(const Check &check)
  {
    try
      {
        check();
      }
    catch (const InputError &error)
      {
        return error;
      }
    return InputError("none", "accepted");
  }

  template <class Run>
  std::string
  failure_of(const Run &run)
  {
    try
      {
        run();
      }
    catch (const DemError &error)
      {
        return error.what();
      }
    return "";
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

// Law: after a time t the floor of rate * t are in, within one, and the last of n comes
// at n / rate, within the millisecond of a step. By whole particles a layer it was three
// times as long.
TEST(Filling, ARateIsCarriedOnWhateverTheLayers)
{
  for (const double rate : {290., 630., 3000.})
    for (const double interval : {0., 0.007})
      {
        SmallColumn       column(SmallColumn::parameters());
        FillingParameters filling = by_count("rain", 90);
        filling.rate              = rate;
        filling.interval          = interval;
        filling.check(SmallColumn::vessel(), SmallColumn::parameters());
        Filling phase(filling, column.dem);
        double  worst = 0.;
        while (phase.step())
          worst = std::max(worst,
                           std::abs(column.dem.n_global() -
                                    std::min(90., std::floor(rate * phase.time()))));
        std::cout << "  rate " << rate << " 1/s, interval " << interval
                  << " s: " << phase.time() << " s of " << 90. / rate
                  << ", off by at most " << worst << " particles" << std::endl;
        EXPECT_EQ(column.dem.n_global(), 90u);
        EXPECT_NEAR(phase.time(), 90. / rate, 1.1e-3 + interval);
        EXPECT_LE(worst, 1. + rate * interval);
      }
}

TEST(Filling, ARateForWhichThereIsNoRoomIsRefused)
{
  FillingParameters filling = by_count("rain", 90);
  filling.rate              = 1e5;
  const auto error =
    fault([&] { filling.check(SmallColumn::vessel(), SmallColumn::parameters()); });
  EXPECT_EQ(error.parameter, "Filling/rate");
  EXPECT_TRUE(contains(error.what(), "particles a second")) << error.what();

  filling.rate  = 2e4;
  filling.count = 300;
  SmallColumn column(SmallColumn::parameters());
  Filling     phase(filling, column.dem);
  const auto  failure = failure_of([&] {
    while (phase.step())
      ;
  });
  std::cout << "  " << failure << std::endl;
  EXPECT_TRUE(contains(failure, "Filling/rate")) << failure;

  filling.rate   = 100.;
  filling.method = "packing";
  EXPECT_EQ(fault([&] {
              filling.check(SmallColumn::vessel(), SmallColumn::parameters());
            }).parameter,
            "Filling/rate");
}

// What leaves counts as filled in: by count or mass it ends with as many in as out. A
// height that cannot be reached is told.
TEST(Filling, ThroughALeakEndsOrTells)
{
  for (const bool by_mass : {false, true})
    {
      SmallColumn       column(with_open_bottom());
      FillingParameters filling =
        by_count(by_mass ? "packing" : "rain", by_mass ? 0 : 100);
      if (by_mass)
        filling.mass = 100. * column.dem.parameters().particles.simulated_mass();
      Filling phase(filling, column.dem);
      while (phase.time() < 1. && phase.step())
        ;
      EXPECT_EQ(phase.progress(), 1.) << filling.method;
      EXPECT_EQ(column.dem.n_departed() + column.dem.n_global(), 100u) << filling.method;
      EXPECT_GT(column.dem.n_departed(), 0u) << filling.method;
    }
  SmallColumn       column(with_open_bottom());
  FillingParameters filling;
  filling.method     = "rain";
  filling.rate       = 200.;
  filling.bed_height = 0.01;
  Filling    phase(filling, column.dem);
  const auto failure = failure_of([&] {
    while (phase.time() < 5. && phase.step())
      ;
  });
  EXPECT_TRUE(contains(failure, "Walls/bottom")) << failure;
}

// A vessel without particles: all that is asked of it is zero, and it goes on.
TEST(Filling, WithNothingAtAll)
{
  FillingParameters filling;
  filling.method = "none";
  filling.check(SmallColumn::vessel(), SmallColumn::parameters());
  for (MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF})
    {
      SmallColumn column(with_open_bottom(), communicator);
      Dem        &dem = column.dem;
      Filling     phase(filling, dem);
      EXPECT_FALSE(phase.step());
      EXPECT_EQ(phase.progress(), 1.);
      Settling settling(SettlingParameters(), dem);
      EXPECT_FALSE(settling.step());
      EXPECT_EQ(settling.time(), 0.);
      EXPECT_FALSE(dem.packing_materials());

      dem.advance(1e-3);
      dem.synchronise();
      dem.balance(0.02);
      const auto state = dem.state();
      dem.restore(state);
      dem.advance(1e-3);
      EXPECT_EQ(dem.n_global(), 0u);
      EXPECT_EQ(dem.weight(), 0.);
      EXPECT_EQ(dem.solid_volume(), 0.);
      EXPECT_EQ(dem.mean_density(), 2700.);
      EXPECT_EQ(dem.maximum_speed(), 0.);
      EXPECT_EQ(dem.mean_kinetic_energy(), 0.);
      EXPECT_EQ(dem.coordination_number(), 0.);
      EXPECT_EQ(dem.bottom_force(), 0.);
      EXPECT_EQ(dem.original_sauter_diameter(), 2e-3);
      const auto bed =
        BedObservables(dem.particles(), dem.vessel_shape(), communicator).bed();
      EXPECT_FALSE(bed.exists);
      const auto profiles = bed_profiles(dem, bed, 2e-3);
      for (const auto &slab : profiles.coordination)
        EXPECT_EQ(slab.n_particles, 0u);

      // The first particle after that falls.
      dem.insert({Point<3>(0., 0., 0.02)});
      dem.advance(0.01);
      EXPECT_NEAR(column.position(0)[2], 0.02 - 0.5 * 9.81 * 1e-4, 1e-12);
    }
}

TEST(Filling, AmountsThatCannotBeAreRefused)
{
  const Cylinder cylinder           = SmallColumn::vessel();
  DemParameters  spheres            = SmallColumn::parameters();
  const auto     parameter_at_fault = [&](const FillingParameters &filling) {
    return fault([&] { filling.check(cylinder, spheres); }).parameter;
  };
  FillingParameters filling = by_count("packing", 0);
  filling.mass              = 1e-9;
  EXPECT_EQ(parameter_at_fault(filling), "Filling/mass");
  filling.mass = 1e-3;
  EXPECT_EQ(parameter_at_fault(filling), "none");
  filling.mass = 1.;
  EXPECT_EQ(parameter_at_fault(filling), "Filling/mass");
  filling.mass       = 0.;
  filling.bed_height = 1e-5;
  EXPECT_EQ(parameter_at_fault(filling), "Filling/bed height");

  filling       = by_count("volume", 300);
  filling.lower = 0.01;
  filling.upper = 0.02;
  EXPECT_EQ(parameter_at_fault(filling), "Filling/count");
  filling = by_count("none", 3);
  EXPECT_EQ(parameter_at_fault(filling), "Filling/count");
  filling      = by_count("rain", 3);
  filling.type = 2;
  EXPECT_EQ(parameter_at_fault(filling), "Filling/type");

  // A mixture: 600 of 4 and 2 mm have more solid than the column has room.
  spheres.particles.further_types[0].mass_fraction = 0.5;
  spheres.particles.further_types[0].diameter      = 4e-3;
  EXPECT_EQ(parameter_at_fault(by_count("rain", 600)), "Filling/count");
  EXPECT_EQ(parameter_at_fault(by_count("rain", 60)), "none");
}

// One type of a mixture is filled in, the other is left to a feed.
TEST(Filling, OfOneType)
{
  DemParameters parameters                            = SmallColumn::parameters();
  parameters.particles.further_types[0].mass_fraction = 0.5;
  parameters.particles.further_types[0].diameter      = 1e-3;
  parameters.particles.further_types[0].density       = 1000.;
  for (const unsigned int type : {1u, 2u})
    {
      SmallColumn       column(parameters);
      FillingParameters filling = by_count("volume", 0);
      const double      mass    = parameters.types()[type - 1].mean_mass();
      filling.mass              = 30. * mass;
      filling.type              = type;
      Filling phase(filling, column.dem);
      phase.step();
      EXPECT_EQ(column.dem.n_by_type()[type - 1], 30u);
      EXPECT_EQ(column.dem.n_global(), 30u);
      EXPECT_NEAR(column.dem.solid_mass(), 30. * mass, 1e-12 * mass);
    }
}
