// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

using namespace graupel;

namespace
{
  DemParameters
  parameters_with_a_moving_plane()
  {
    DemParameters parameters = SmallColumn::parameters();
    parameters.walls.planes  = "0 0 0.001 0 0 -1 0 0 0.02"; // lifts the floor
    parameters.contact.particle_surface.rolling_resistance = 0.1;
    parameters.contact.wall_surface.rolling_resistance     = 0.1;
    return parameters;
  }
} // namespace

// A bed that is written down while it falls, touches and slides, and read again by
// another column, on as many ranks and alone, goes on as if nothing had been.
TEST(DemState, GoesOnBitByBitOnAnyNumberOfRanks)
{
  const auto                    parameters = parameters_with_a_moving_plane();
  SmallColumn                   whole(parameters);
  std::vector<dealii::Point<3>> positions;
  for (unsigned int k = 0; k < 40; ++k)
    positions.push_back({2.1e-3 * (static_cast<int>(k % 2) - 0.4),
                         2.1e-3 * (static_cast<int>(k / 2 % 2) - 0.6),
                         2.5e-3 + 2.3e-3 * (k / 4)});
  whole.dem.insert(positions);
  whole.dem.advance(0.08);
  for (unsigned int row = 0; row < whole.dem.particles().n_owned; ++row)
    {
      const auto id                                 = whole.dem.particles().id[row];
      whole.dem.particles().external_force[row][0]  = 1e-6 * id;
      whole.dem.particles().external_torque[row][1] = 1e-10 * id;
    }
  whole.dem.advance(1e-4);

  const DemState state = whole_state(whole.dem);
  EXPECT_EQ(state.particles.size(), 40u);
  EXPECT_GT(state.contacts.size(), 60u) << "without contacts this shows nothing";
  EXPECT_EQ(whole.dem.state().particles.size(), whole.dem.particles().n_owned);

  // Whoever has which part of it.
  SmallColumn together(parameters), given_by_one(parameters),
    alone(parameters, MPI_COMM_SELF);
  together.dem.restore(whole.dem.state());
  DemState of_first = state;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
    {
      of_first.particles.clear();
      of_first.contacts.clear();
    }
  given_by_one.dem.restore(of_first);
  alone.dem.restore(state);
  EXPECT_EQ(alone.dem.n_global(), 40u);
  EXPECT_EQ(alone.dem.weight(), whole.dem.weight());
  for (unsigned int n = 0; n < 3; ++n)
    {
      const auto expected = whole.state();
      EXPECT_EQ(together.state(), expected);
      EXPECT_EQ(given_by_one.state(), expected);
      EXPECT_EQ(alone.state(), expected);
      whole.dem.advance(1e-2);
      together.dem.advance(1e-2);
      given_by_one.dem.advance(1e-2);
      alone.dem.advance(1e-2);
    }
  // New particles get numbers of their own.
  alone.dem.insert({dealii::Point<3>(0., 0., 0.028)});
  EXPECT_EQ(alone.dem.particles().id.back(), 40);
}

TEST(DemState, OfTypesThatAreNotThereIsRefused)
{
  DemState           state;
  DemState::Particle particle;
  particle.parcel.type = 7;
  state.particles.push_back(particle);
  SmallColumn column(SmallColumn::parameters());
  EXPECT_THROW(column.dem.restore(state), std::runtime_error);
}
