// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/particles/dem_error.h>

#include <fstream>

namespace
{
  using namespace graupel;
  using dealii::Point;

  std::string
  list_file(const std::string &text)
  {
    const std::string name =
      testing::TempDir() + "sizes" +
      std::to_string(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".csv";
    std::ofstream(name) << text;
    return name;
  }

  FillingParameters
  from_list(const std::string &text)
  {
    FillingParameters filling;
    filling.method = "list";
    filling.file   = list_file(text);
    return filling;
  }

  std::string
  refusal(const FillingParameters &filling, const DemParameters &parameters)
  {
    try
      {
        filling.check(SmallColumn::vessel(), parameters);
      }
    catch (const InputError &error)
      {
        return error.parameter + ": " + error.what();
      }
    return "";
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  std::string
  fault_of(const DemParameters &parameters)
  {
    try
      {
        parameters.check(SmallColumn::vessel());
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return "";
  }
} // namespace

// A list is read and looked through before anything is built.
TEST(Sizes, AListIsCheckedRowByRow)
{
  const DemParameters spheres = SmallColumn::parameters();
  const std::string   header  = "x,y,z,diameter,type\n";
  EXPECT_EQ(refusal(from_list(header + "0,0,0.01,2e-3,1\n"), spheres), "");
  // Rounded in the fifth digit.
  EXPECT_EQ(refusal(from_list(header + "0,0,0.01,2.00003e-3,1\n"), spheres), "");
  for (const std::string row : {"0,0,0.01,6e-3,1", "0,0,0.01,2e-4,1"})
    {
      const auto said = refusal(from_list(header + "0,0,0.02,2e-3,1\n" + row), spheres);
      EXPECT_TRUE(contains(said, "Filling/file")) << said;
      EXPECT_TRUE(contains(said, "line 3")) << said;
      EXPECT_TRUE(contains(said, "number 1")) << said;
    }
  for (const std::string row : {"4.5e-3,0,0.01,2e-3,1",
                                "0,0,0.03,2e-3,1",
                                "0,0,-0.001,2e-3,1",
                                "0,0.02,0.01,2e-3,1"})
    EXPECT_TRUE(contains(refusal(from_list(header + row), spheres), "line 2")) << row;
  EXPECT_TRUE(contains(refusal(from_list(header + "0,0,0.01,2e-3,2"), spheres), "types"));
  FillingParameters missing = from_list("");
  missing.file              = "no-such-file.csv";
  EXPECT_TRUE(contains(refusal(missing, spheres), "cannot be opened"));

  // The type says which sizes there are.
  DemParameters sizes            = spheres;
  sizes.particles.sizes.kind     = "uniform";
  sizes.particles.sizes.smallest = 2e-4;
  sizes.particles.sizes.largest  = 6e-3;
  EXPECT_EQ(refusal(from_list(header + "0,0,0.01,6e-3,1"), sizes), "");
  EXPECT_EQ(refusal(from_list(header + "0,0,0.01,2e-4,1"), sizes), "");
}

// Nor do they come in any other way: put in directly, or with a bed of another run.
TEST(Sizes, WhatNoTypeHasIsRefusedByName)
{
  DemParameters large      = SmallColumn::parameters();
  large.particles.diameter = 3e-3;
  SmallColumn from(large), to(SmallColumn::parameters());
  from.dem.insert({Point<3>(0., 0., 0.01)});
  try
    {
      to.dem.restore(from.dem.state());
      FAIL() << "a sphere of 3 mm among those of 2 mm";
    }
  catch (const DemError &error)
    {
      EXPECT_TRUE(contains(error.what(), "particle 0")) << error.what();
      EXPECT_TRUE(contains(error.what(), "number 1")) << error.what();
    }
  EXPECT_THROW(to.dem.insert({NewParticle{Point<3>(0., 0., 0.01), 1e-4}}), DemError);
}

// Two spheres of 6 mm that touch across the borders of ranks move as on one rank.
TEST(Sizes, LargeSpheresOfAListAreSeenAcrossRanks)
{
  DemParameters parameters            = SmallColumn::parameters();
  parameters.particles.gravity        = 0.;
  parameters.particles.sizes.kind     = "uniform";
  parameters.particles.sizes.smallest = 2e-3;
  parameters.particles.sizes.largest  = 4.6e-3;
  const auto file = list_file("x,y,z,diameter\n0.001,0,0.0128,0.0046\n"
                              "-0.001,0,0.0168,0.0046\n");
  std::map<std::int64_t, std::vector<double>> states[2];
  unsigned int                                k = 0;
  for (MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF})
    {
      SmallColumn       column(parameters, communicator);
      FillingParameters filling;
      filling.method = "list";
      filling.file   = file;
      Filling phase(filling, column.dem);
      phase.step();
      column.dem.advance(5e-3);
      EXPECT_GT(column.velocity(1)[2], 1e-3) << "they must push each other away";
      states[k++] = column.state();
    }
  EXPECT_EQ(states[0], states[1]);
}

// Law: d32 = sum n d^3 / sum n d^2; by shares w of the volume 1 / sum(w / d).
TEST(Sizes, SauterMeanOfWhatIsFilledIn)
{
  DemParameters p        = SmallColumn::parameters();
  p.particles.sizes.kind = "list";
  p.particles.sizes.list = "1e-3: 1, 2e-3: 3";
  EXPECT_NEAR(p.mean_original_diameter(), 1.6e-3, 1e-15);
  p.particles.sizes.measure = "number";
  EXPECT_NEAR(p.mean_original_diameter(), 25. / 13. * 1e-3, 1e-15);
  p.particles.scale = 2.;
  EXPECT_NEAR(p.mean_simulated_diameter(), 50. / 13. * 1e-3, 1e-15);

  // By mass evenly from a to b: the harmonic mean (b - a) / ln(b / a). Limit: the
  // samples of the mean.
  p                          = SmallColumn::parameters();
  p.particles.sizes.kind     = "uniform";
  p.particles.sizes.smallest = 1e-3;
  p.particles.sizes.largest  = 2e-3;
  EXPECT_NEAR(p.mean_original_diameter(), 1e-3 / std::log(2.), 1e-10);

  // Two types: half of the mass each, hence 2/3 and 1/3 of the volume.
  p                                          = SmallColumn::parameters();
  p.particles.density                        = 1000.;
  p.particles.further_types[0].mass_fraction = 0.5;
  p.particles.further_types[0].density       = 2000.;
  p.particles.further_types[0].diameter      = 1e-3;
  p.particles.further_types[0].scale         = 3.;
  EXPECT_NEAR(p.mean_original_diameter(), 1. / (2. / 2e-3 + 1. / 1e-3) * 3., 1e-15);
  EXPECT_NEAR(p.mean_simulated_diameter(), 3. / (2. / 2e-3 + 1. / 3e-3), 1e-15);

  for (const double scale : {1., 2., 1.7})
    for (const double diameter : {1.6e-3, 3e-3, 0.7e-3})
      {
        DemParameters one      = SmallColumn::parameters();
        one.particles.scale    = scale;
        one.particles.diameter = diameter;
        EXPECT_EQ(one.mean_simulated_diameter(), scale * diameter);
        EXPECT_EQ(one.mean_original_diameter(), diameter);
      }
}

// The same spheres, whichever way they are given, are the same bed bit by bit.
TEST(Sizes, OfAListOfOneAreThoseOfADiameter)
{
  DemParameters ways[3];
  for (auto &way : ways)
    way = SmallColumn::parameters();
  ways[0].particles.diameter   = 3e-3;
  ways[1].particles.sizes.kind = "list";
  ways[1].particles.sizes.list = "3e-3: 1";
  ways[2].particles.sizes.kind = "list";
  ways[2].particles.sizes.list = "3e-3: 2, 3e-3: 5, 1e-3: 0";

  std::map<std::int64_t, std::vector<double>> first;
  for (const auto &way : ways)
    {
      EXPECT_EQ(fault_of(way), "");
      EXPECT_EQ(way.mean_simulated_diameter(), 3e-3);
      EXPECT_EQ(way.mean_original_diameter(), 3e-3);
      EXPECT_EQ(way.substep(), ways[0].substep());
      SmallColumn       column(way);
      FillingParameters filling;
      filling.method     = "packing";
      filling.mass       = 20. * way.types()[0].mean_mass();
      filling.bed_height = 0.;
      Filling phase(filling, column.dem);
      while (phase.step())
        ;
      if (first.empty())
        first = column.state();
      EXPECT_EQ(first.size(), 20u);
      EXPECT_EQ(column.state(), first);
    }
}

TEST(Sizes, BeyondTheVesselAreRefused)
{
  DemParameters p        = SmallColumn::parameters();
  p.particles.sizes.kind = "list";
  p.particles.sizes.list = "2e-3: 0.9, 11e-3: 0.1";
  EXPECT_EQ(fault_of(p), "Particles/size list");
  p.particles.sizes.list = "1e-3: abc";
  EXPECT_EQ(fault_of(p), "Particles/size list");
  p.particles.sizes.list = "1e-3: 1, 2e-3";
  EXPECT_EQ(fault_of(p), "Particles/size list");
  p.particles.sizes.list = "1e-3: -1";
  EXPECT_EQ(fault_of(p), "Particles/size list");
  p.particles.sizes.list = "1e-3: 0";
  EXPECT_EQ(fault_of(p), "Particles/size list");

  p                                          = SmallColumn::parameters();
  p.particles.further_types[1].mass_fraction = 0.1;
  p.particles.further_types[1].diameter      = 12e-3;
  EXPECT_EQ(fault_of(p), "Particles/Type 3/diameter");
}
