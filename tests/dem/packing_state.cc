// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include "small_column.h"

#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>

#include <sstream>

namespace
{
  using namespace graupel;

  // As it would be read from a file.
  template <class Record>
  Record
  through_a_file(const Record &record)
  {
    std::stringstream file;
    {
      boost::archive::binary_oarchive archive(file);
      archive << record;
    }
    Record                          result;
    boost::archive::binary_iarchive archive(file);
    archive >> result;
    return result;
  }

  // Law: a phase that is stopped after @p n_before steps and goes on in another column,
  // on as many ranks and alone, makes the same bed bit by bit after @p n_after more.
  template <class Phase, class Parameters, class Prepare>
  void
  expect_the_same_after_a_stop(const DemParameters &spheres,
                               const Parameters    &parameters,
                               const unsigned int   n_before,
                               const unsigned int   n_after,
                               const Prepare       &prepare)
  {
    const auto go = [](Phase &phase, const unsigned int n) {
      for (unsigned int k = 0; k < n && phase.step(); ++k)
        ;
    };
    SmallColumn whole(spheres);
    prepare(whole.dem);
    Phase phase(parameters, whole.dem);
    go(phase, n_before);
    const auto part = whole.dem.state(), all = whole_state(whole.dem);
    const auto state   = through_a_file(phase.state());
    const bool packing = whole.dem.packing_materials();
    go(phase, n_after);
    EXPECT_GT(phase.time(), 0.);
    for (MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF})
      {
        SmallColumn column(spheres, communicator);
        Phase       again(parameters, column.dem);
        column.dem.restore(communicator == MPI_COMM_SELF ? all : part);
        again.restore(state);
        EXPECT_EQ(column.dem.packing_materials(), packing);
        go(again, n_after);
        EXPECT_EQ(again.time(), phase.time());
        EXPECT_EQ(column.dem.n_global(), whole.dem.n_global());
        EXPECT_EQ(column.dem.solid_volume(), whole.dem.solid_volume());
        EXPECT_EQ(column.dem.packing_materials(), whole.dem.packing_materials());
        EXPECT_EQ(column.state(), whole.state());
      }
  }

  DemParameters
  mixture(const std::string &bottom)
  {
    DemParameters parameters                            = SmallColumn::parameters();
    parameters.walls.bottom                             = bottom;
    parameters.particles.further_types[0].mass_fraction = 0.5;
    parameters.particles.further_types[0].diameter      = 1.4e-3;
    parameters.particles.further_types[0].density       = 4000.;
    return parameters;
  }

  void
  nothing(Dem &)
  {
  }

  void
  fill(Dem &dem)
  {
    FillingParameters filling;
    filling.method     = "packing";
    filling.bed_height = 0.;
    filling.count      = 150;
    Filling phase(filling, dem);
    while (phase.step())
      ;
  }
} // namespace

TEST(PackingState, OfRain)
{
  FillingParameters filling;
  filling.bed_height = 0.;
  filling.count      = 120;
  expect_the_same_after_a_stop<Filling>(mixture("closed"), filling, 5, 30, nothing);
  // Through an open bottom the numbers of those that left are not given again.
  filling.rate = 650.;
  expect_the_same_after_a_stop<Filling>(mixture("open"), filling, 90, 60, nothing);
}

TEST(PackingState, OfPacking)
{
  FillingParameters filling;
  filling.method     = "packing";
  filling.bed_height = 0.02;
  expect_the_same_after_a_stop<Filling>(mixture("closed"), filling, 70, 200, nothing);
}

TEST(PackingState, OfTapping)
{
  SettlingParameters settling;
  settling.target_void_fraction = 0.4;
  // Until the first tap, into it, and on until after the second.
  SmallColumn column(SmallColumn::parameters());
  fill(column.dem);
  Settling     phase(settling, column.dem);
  unsigned int n = 0;
  for (; phase.n_taps() == 0 && n < 200; ++n)
    ASSERT_TRUE(phase.step());
  expect_the_same_after_a_stop<Settling>(
    SmallColumn::parameters(), settling, n + 20, 80, fill);
}

TEST(PackingState, OfTheFrictionOfTheFlow)
{
  SettlingParameters settling;
  SmallColumn        column(SmallColumn::parameters());
  fill(column.dem);
  Settling     phase(settling, column.dem);
  unsigned int n = 0;
  for (; column.dem.packing_materials() && n < 200; ++n)
    ASSERT_TRUE(phase.step());
  ASSERT_EQ(through_a_file(phase.state()).phase, Settling::State::Phase::relaxing);
  expect_the_same_after_a_stop<Settling>(
    SmallColumn::parameters(), SettlingParameters(), n, 5, fill);
}

// Loads of a bed that was made with a softer solid are taken over in newtons, so that
// the first half of a substep is right as well.
TEST(PackingState, IntoAnotherSolidKeepsTheForces)
{
  SmallColumn soft(SmallColumn::parameters());
  fill(soft.dem);
  soft.dem.advance(0.05);
  DemParameters stiff = SmallColumn::parameters();
  stiff.contact.particle_elasticity.young_modulus *= 8.;
  SmallColumn column(stiff);
  column.dem.restore(soft.dem.state());
  double largest = 0.;
  for (unsigned int id = 0; id < 150; ++id)
    {
      const auto before = soft.force(id), after = column.force(id);
      largest = std::max(largest, before.norm());
      EXPECT_NEAR((after - before).norm(), 0., 1e-12 * (1e-3 + before.norm())) << id;
    }
  EXPECT_GT(largest, 1e-5);
}
