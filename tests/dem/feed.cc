// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include "small_column.h"

#include <graupel/base/parameter_entries.h>
#include <graupel/base/parameters.h>
#include <graupel/dem/packing/feed.h>
#include <graupel/dem/particles/dem_error.h>

#include <sstream>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  // Two kinds that fall through an open bottom.
  DemParameters
  draining()
  {
    DemParameters parameters                            = SmallColumn::parameters();
    parameters.walls.bottom                             = "open";
    parameters.particles.further_types[0].mass_fraction = 0.4;
    parameters.particles.further_types[0].diameter      = 1.5e-3;
    parameters.particles.further_types[0].density       = 5000.;
    return parameters;
  }

  unsigned long
  sum(const std::vector<unsigned long> &numbers)
  {
    unsigned long total = 0;
    for (const auto n : numbers)
      total += n;
    return total;
  }
} // namespace

// Law: the floor of rate * (t - from) are in, within one, at any time; what is in and
// what has left through the open end add up to it, type by type.
TEST(Feed, ARateIsKeptForEver)
{
  for (const double dt : {1e-3, 3.7e-3})
    {
      SmallColumn    column(draining());
      FeedParameters feed;
      feed.rate  = 399.;
      feed.from  = 0.05;
      feed.until = 0.2;
      Feed   phase(feed, column.dem);
      double worst = 0., t = 0.;
      while (t < 0.3)
        {
          phase.advance(t, dt);
          column.dem.advance(dt);
          t += dt;
          const double due = std::floor(399. * std::clamp(t - 0.05, 0., 0.15) + 1e-9);
          worst            = std::max(worst, std::abs(due - phase.n_inserted()));
        }
      std::cout << "  steps of " << dt << " s: " << phase.n_inserted()
                << " particles, off by at most " << worst << "; left "
                << column.dem.departed()[0] << " + " << column.dem.departed()[1]
                << std::endl;
      EXPECT_LE(worst, 1.);
      EXPECT_EQ(phase.n_inserted(), 59u); // 399 * 0.15 = 59.85
      EXPECT_EQ(phase.owed(), 0.);
      EXPECT_EQ(column.dem.n_global(), 0u);
      EXPECT_EQ(column.dem.departed(), phase.inserted());
      EXPECT_GT(phase.inserted()[0], 10u);
      const auto mass = column.dem.departed_mass();
      EXPECT_NEAR(mass[0] + mass[1], phase.inserted_mass(), 1e-9 * phase.inserted_mass());
      EXPECT_EQ(column.dem.solid_mass(), 0.);
    }
}

// Law: the mass that is in is that of the rate, short of it by less than one particle.
TEST(Feed, AMassRateIsKeptWithinOneParticle)
{
  SmallColumn    column(draining());
  FeedParameters feed;
  feed.mass_rate       = 4e-3;
  const double largest = 2700. * sphere_volume(1e-3);
  Feed         phase(feed, column.dem);
  for (unsigned int n = 0; n < 120; ++n)
    {
      phase.advance(n * 1e-3, 1e-3);
      column.dem.advance(1e-3);
      const double due = 4e-6 * (n + 1);
      ASSERT_LE(phase.inserted_mass(), due * (1. + 1e-12));
      ASSERT_GT(phase.inserted_mass(), due - largest);
    }
  EXPECT_EQ(sum(column.dem.departed()) + column.dem.n_global(), phase.n_inserted());
}

// New particles touch neither each other nor what is there, in a section in the middle
// as below the top, and those of one type are of that type.
TEST(Feed, PlacesAreFree)
{
  DemParameters parameters     = draining();
  parameters.particles.gravity = 0.;
  SmallColumn column(parameters);
  column.dem.insert({Point<3>(1e-3, 0., 0.015), Point<3>(-2e-3, 1e-3, 0.012)});
  FeedParameters feed;
  feed.rate     = 4e4;
  feed.type     = 2;
  feed.lower    = 0.01;
  feed.upper    = 0.02;
  feed.velocity = Vector({0., 0., 0.25});
  Feed phase(feed, column.dem);
  EXPECT_EQ(phase.advance(0., 1e-3), 40u);
  EXPECT_EQ(column.dem.n_by_type(), (std::vector<unsigned long>{2, 40}));
  const auto &p = column.dem.particles();
  for (unsigned int i = 0; i < p.n_owned; ++i)
    if (p.type[i] == 1)
      {
        EXPECT_GT(p.body[i].position[2], 0.01 + p.body[i].radius);
        EXPECT_LT(p.body[i].position[2], 0.02 - p.body[i].radius);
        EXPECT_EQ(p.body[i].velocity, feed.velocity);
      }
  column.dem.advance(column.dem.substep());
  EXPECT_EQ(column.dem.coordination_number(), 0.);
  for (const auto &contact : column.dem.contact_states())
    ADD_FAILURE() << "contact of " << contact.first << " with " << contact.second;
}

// What finds no place is owed, comes in when there is one, and is told if it grows.
TEST(Feed, DebtIsKnownPaidAndTold)
{
  DemParameters parameters = SmallColumn::parameters();
  SmallColumn   column(parameters);
  // A lid of spheres at rest closes the section, until it is let go.
  std::vector<Point<3>> lid;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      lid.push_back({2.2e-3 * x, 2.2e-3 * y, 0.0284});
  column.dem.set_gravity(0.);
  column.dem.insert(lid);
  FeedParameters feed;
  feed.rate      = 500.;
  feed.most_owed = 30;
  Feed   phase(feed, column.dem);
  double t = 0.;
  for (; t < 0.0495; t += 1e-3)
    {
      phase.advance(t, 1e-3);
      column.dem.advance(1e-3);
    }
  EXPECT_GT(phase.owed(), 15.);
  EXPECT_EQ(phase.owed() + phase.n_inserted(), std::floor(500. * t + 1e-6));
  column.dem.set_gravity(9.81);
  for (; t < 0.1495; t += 1e-3)
    {
      phase.advance(t, 1e-3);
      column.dem.advance(1e-3);
    }
  EXPECT_EQ(phase.owed(), 0.);
  EXPECT_EQ(phase.n_inserted(), 75u);

  feed.rate      = 1e5;
  feed.most_owed = 20;
  Feed too_much(feed, column.dem);
  try
    {
      too_much.advance(0., 1e-3);
      FAIL() << "a hundred in a millisecond";
    }
  catch (const DemError &error)
    {
      EXPECT_NE(std::string(error.what()).find("Feed/rate"), std::string::npos)
        << error.what();
    }
}

// The same bit by bit on any number of ranks, and stopped in the middle.
TEST(Feed, GoesOnBitByBitOnAnyNumberOfRanks)
{
  FeedsParameters parameters;
  parameters.feeds[0].rate      = 399.;
  parameters.feeds[1].mass_rate = 2e-3;
  parameters.feeds[1].type      = 2;
  parameters.feeds[1].lower     = 0.004;
  parameters.feeds[1].upper     = 0.014;
  parameters.feeds[1].velocity  = Vector({0.1, 0., 0.5});
  parameters.feeds[1].seed      = 3;
  const auto run =
    [](Feeds &feeds, Dem &dem, const unsigned int from, const unsigned to) {
      for (unsigned int n = from; n < to; ++n)
        {
          feeds.advance(n * 1e-3, 1e-3);
          dem.advance(1e-3);
        }
    };
  SmallColumn whole(draining());
  Feeds       whole_feeds(parameters, whole.dem);
  run(whole_feeds, whole.dem, 0, 90);

  std::stringstream file;
  {
    boost::archive::binary_oarchive archive(file);
    const auto                      feeds = whole_feeds.state();
    archive << feeds;
  }
  Feeds::State state;
  {
    boost::archive::binary_iarchive archive(file);
    archive >> state;
  }
  const auto part = whole.dem.state(), whole_of_it = whole_state(whole.dem);
  EXPECT_GT(whole.dem.n_departed(), 5u) << "or their numbers would not be missed";
  run(whole_feeds, whole.dem, 90, 150);
  for (MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF})
    {
      SmallColumn column(draining(), communicator);
      Feeds       feeds(parameters, column.dem);
      column.dem.restore(communicator == MPI_COMM_SELF ? whole_of_it : part);
      feeds.restore(state);
      run(feeds, column.dem, 90, 150);
      EXPECT_EQ(feeds.inserted(), whole_feeds.inserted());
      EXPECT_EQ(column.dem.departed(), whole.dem.departed());
      EXPECT_EQ(column.dem.departed_mass(), whole.dem.departed_mass());
      EXPECT_EQ(column.dem.solid_volume(), whole.dem.solid_volume());
      EXPECT_EQ(column.state(), whole.state());

      SmallColumn anew(draining(), communicator);
      Feeds       all(parameters, anew.dem);
      run(all, anew.dem, 0, 150);
      EXPECT_EQ(anew.state(), whole.state());
    }
}

TEST(Feed, ParametersHaveUnitsAndAreChecked)
{
  FeedsParameters          parameters;
  dealii::ParameterHandler prm;
  parameters.declare(prm);
  EXPECT_EQ(entries_without_unit(prm), std::vector<std::string>());
  prm.enter_subsection("Feed 2");
  prm.set("rate", "10");
  prm.set("velocity", "1, 2, -3");
  prm.leave_subsection();
  EXPECT_EQ(parameters.feeds[1].velocity, Vector({1., 2., -3.}));
  EXPECT_TRUE(parameters.is_wanted());
  const auto fault = [&]() -> std::string {
    try
      {
        parameters.check(SmallColumn::vessel(), draining());
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return "";
  };
  EXPECT_EQ(fault(), "");
  auto &feed = parameters.feeds[1];
  feed.type  = 3;
  EXPECT_EQ(fault(), "Feed 2/type");
  feed.type      = 2;
  feed.mass_rate = 1.;
  EXPECT_EQ(fault(), "Feed 2/mass rate");
  feed.mass_rate = 0.;
  feed.upper     = 0.04;
  EXPECT_EQ(fault(), "Feed 2/upper");
  feed.upper = 0.;
  feed.from  = 1.;
  feed.until = 0.5;
  EXPECT_EQ(fault(), "Feed 2/until");
  feed.until = 0.;
  feed.rate  = -1.;
  EXPECT_EQ(fault(), "Feed 2/rate");
}
