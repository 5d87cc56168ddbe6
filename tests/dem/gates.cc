// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"
#include "stl_shapes.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/particles/dem_error.h>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  constexpr double R = 1e-3;

  DemParameters
  with_a_plane_at_3_mm(const std::string &planes = "gate: 0 0 0.003 0 0 -1")
  {
    DemParameters p = SmallColumn::parameters();
    p.walls.planes  = planes;
    return p;
  }

  // Three layers of three spheres that rest on the plane.
  void
  settle(SmallColumn &column)
  {
    std::vector<Point<3>> places;
    for (unsigned int k = 0; k < 9; ++k)
      {
        const double angle = 2.1 * (k % 3) + 0.9 * (k / 3);
        places.emplace_back(
          2e-3 * std::cos(angle), 2e-3 * std::sin(angle), 4.1e-3 + 2.1e-3 * (k / 3));
      }
    column.dem.insert(places);
    column.dem.advance(0.2);
  }

  double
  lowest(const SmallColumn &column)
  {
    double z = 1.;
    for (unsigned int i = 0; i < column.dem.particles().n_owned; ++i)
      z = std::min(z, column.dem.particles().body[i].position[2]);
    return dealii::Utilities::MPI::min(z, column.dem.communicator());
  }

  // A gate holds the bed until its time; then the bed falls freely, and 3 mm deeper it
  // rests on the bottom with all its weight. Limit of the fall: 2 % of the way, for the
  // contacts that unload.
  TEST(Gates, OpensAtItsTime)
  {
    DemParameters p = with_a_plane_at_3_mm();
    p.walls.gates   = "gate until 0.05";
    SmallColumn column(p);
    settle(column);
    const double height = lowest(column), weight = column.dem.weight();
    EXPECT_NEAR(height, 3e-3 + R, 1e-2 * R);
    column.dem.start_clock(0.);
    column.dem.advance(0.04);
    EXPECT_EQ(column.dem.bottom_force(), 0.);
    EXPECT_NEAR(column.dem.supported_weight() / weight, 1., 1e-3);
    EXPECT_NEAR(-column.dem.force_on("gate")[2] / weight, 1., 0.1);

    column.dem.advance(0.03);
    const double way = 0.5 * 9.81 * 0.02 * 0.02;
    EXPECT_NEAR(height - lowest(column), way, 0.02 * way);
    column.dem.advance(0.2);
    column.dem.advance(0.01);
    EXPECT_NEAR(height - lowest(column), 3e-3, 1e-2 * R);
    EXPECT_NEAR(column.dem.supported_weight() / weight, 1., 1e-2);
    EXPECT_EQ(column.dem.force_on("gate").norm(), 0.);
    EXPECT_THROW(column.dem.force_on("door"), InputError);
  }

  TEST(Gates, UntilSettledIsGoneWhenTheClockStarts)
  {
    DemParameters p = with_a_plane_at_3_mm();
    p.walls.gates   = "gate until settled";
    SmallColumn column(p);
    settle(column);
    EXPECT_NEAR(lowest(column), 3e-3 + R, 1e-2 * R);
    column.dem.start_clock(0.);
    EXPECT_EQ(column.dem.contact_states().size(), [&]() {
      std::size_t n = 0;
      for (const auto &state : column.dem.contact_states())
        n += state.second >= 0 || wall_of(state.second) != 3;
      return n;
    }());
    column.dem.advance(0.2);
    EXPECT_NEAR(lowest(column), R, 1e-2 * R);
  }

  // A wall that comes later is not felt before, and is then; one that would come into a
  // particle is refused by name.
  TEST(Gates, ComesAtItsTime)
  {
    for (const bool in_the_way : {false, true})
      {
        DemParameters p = SmallColumn::parameters();
        p.walls.planes  = "shelf: 0 0 0.01 0 0 -1";
        p.walls.gates   = in_the_way ? "shelf from 0.04" : "shelf from 0.02";
        SmallColumn column(p);
        column.dem.insert({Point<3>(0., 0., 0.015)});
        column.dem.start_clock(0.);
        if (in_the_way)
          {
            EXPECT_THROW(column.dem.advance(0.2), DemError);
          }
        else
          {
            column.dem.advance(0.5);
            EXPECT_NEAR(column.position(0)[2], 0.011, 1e-2 * R);
          }
      }
  }

  // A bed that rested on a plane comes into a vessel without it, and falls to the bottom.
  TEST(Gates, BedInAVesselWithoutItsWallFalls)
  {
    SmallColumn before(with_a_plane_at_3_mm());
    settle(before);
    const DemState state = before.dem.state();
    EXPECT_GE(whole_state(before.dem).contacts.size(), 9u);

    SmallColumn after(SmallColumn::parameters());
    after.dem.restore(state);
    EXPECT_NEAR(lowest(after), 3e-3 + R, 1e-2 * R);
    after.dem.advance(0.2);
    after.dem.advance(0.01);
    EXPECT_NEAR(lowest(after), R, 1e-2 * R);
    EXPECT_NEAR(after.dem.supported_weight() / after.dem.weight(), 1., 1e-2);
  }

  // Walls are found by their names: in another order, among others, the motion goes on
  // bit by bit; a plane of that name elsewhere is where the parameters say.
  TEST(Gates, WallsAreFoundByName)
  {
    const std::string table = "table: 0 0 0.003 0.1 0 -1",
                      fence = "fence: 0.0035 0 0 1 0 0 0 0 0.5",
                      roof  = "roof: 0 0 0.025 0 0 1";
    SmallColumn before(with_a_plane_at_3_mm(table + ", " + fence));
    settle(before);
    const DemState state = before.dem.state();
    SmallColumn    after(with_a_plane_at_3_mm(roof + "," + fence + "," + table));
    after.dem.restore(state);
    EXPECT_EQ(after.state(), before.state());
    before.dem.advance(0.02);
    after.dem.advance(0.02);
    EXPECT_EQ(after.state(), before.state());
    EXPECT_NEAR(std::get<PlaneWall>(after.dem.vessel()[4].shape).point.z, 0.11, 1e-9);

    SmallColumn lower(with_a_plane_at_3_mm("table: 0 0 0.002 0.1 0 -1"));
    lower.dem.restore(state);
    EXPECT_EQ(std::get<PlaneWall>(lower.dem.vessel()[3].shape).point.z, 0.002);
    lower.dem.advance(0.2);
    EXPECT_LT(lowest(lower), lowest(before) - 0.9e-3);
  }

  // Springs of facets that are no more the same ones end: another file of one name.
  TEST(Gates, AnotherFileOfTheSameNameIsAnotherWall)
  {
    const auto floor_at = [](const double z, const double size) {
      Triangles floor;
      add_quad(floor,
               {{Point<3>(-size, -size, z),
                 Point<3>(size, -size, z),
                 Point<3>(size, size, z),
                 Point<3>(-size, size, z)}});
      return floor;
    };
    DemParameters p  = SmallColumn::parameters();
    p.walls.surfaces = "floor: " + write_stl("first_floor", floor_at(3e-3, 8e-3));
    SmallColumn before(p);
    settle(before);
    const DemState state = before.dem.state();

    const auto n_with_floor = [](const SmallColumn &column) {
      unsigned int n = 0;
      for (const auto &contact : column.dem.contact_states())
        n += contact.second < 0 && wall_of(contact.second) == 3;
      return dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD);
    };
    SmallColumn same(p);
    same.dem.restore(state);
    EXPECT_EQ(n_with_floor(same), n_with_floor(before));
    EXPECT_GT(n_with_floor(same), 0u);
    p.walls.surfaces = "floor: " + write_stl("second_floor", floor_at(2.5e-3, 9e-3));
    SmallColumn other(p);
    other.dem.restore(state);
    EXPECT_EQ(n_with_floor(other), 0u);
    other.dem.advance(0.2);
    EXPECT_NEAR(lowest(other), 2.5e-3 + R, 1e-2 * R);
  }

  // Written down while planes oscillate, a blade turns and a gate is about to open, the
  // motion goes on bit by bit on any number of ranks.
  TEST(Gates, GoesOnInTheMiddleOfMotions)
  {
    DemParameters p =
      with_a_plane_at_3_mm("table: 0 0 0.003 0 0 -1, gate: 0 0 0.0031 0 0 -1");
    p.walls.surfaces = "blade: " + write_stl("blade",
                                             box_shape(Point<3>(-4e-3, -5e-4, 3.5e-3),
                                                       Point<3>(4e-3, 5e-4, 4.5e-3)));
    p.walls.motion   = "table = velocity 0; 0; 0.01 * sin(90 * t) | "
                       "table = rotation 0 0 0.003; 0 0 1; 7 * t | "
                       "blade = rotation 0 0 0.005; 0.1 0 1; -10 * sin(20 * t) | "
                       "wall = rotation 0 0 0; 0 0 1; 3";
    p.walls.gates    = "gate until 0.037";
    SmallColumn           whole(p);
    std::vector<Point<3>> places;
    for (unsigned int k = 0; k < 24; ++k)
      places.emplace_back(2.3e-3 * std::cos(1.5707 * k),
                          2.3e-3 * std::sin(1.5707 * k),
                          6e-3 + 2.3e-3 * (k / 4));
    whole.dem.insert(places);
    whole.dem.advance(0.05);
    whole.dem.start_clock(0.01);
    whole.dem.advance(0.02);
    const DemState state = whole.dem.state();

    SmallColumn together(p), alone(p, MPI_COMM_SELF);
    together.dem.restore(state);
    alone.dem.restore(whole_state(whole.dem));
    EXPECT_EQ(alone.dem.clock(), whole.dem.clock());
    const auto blade_angle = [](const SmallColumn &column) {
      return column.dem.vessel()[5].pose.angle;
    };
    EXPECT_NE(blade_angle(whole), 0.);
    for (unsigned int n = 0; n < 3; ++n)
      {
        EXPECT_EQ(together.state(), whole.state());
        EXPECT_EQ(alone.state(), whole.state());
        EXPECT_EQ(blade_angle(alone), blade_angle(whole));
        whole.dem.advance(0.01);
        together.dem.advance(0.01);
        alone.dem.advance(0.01);
      }
    EXPECT_FALSE(whole.dem.vessel()[4].is_there);

    // About another axis the blade would not be where it was.
    p.walls.motion = "blade = rotation 0 0 0.005; 1 0 0; 1";
    SmallColumn other(p);
    EXPECT_THROW(other.dem.restore(state), DemError);
  }
} // namespace
