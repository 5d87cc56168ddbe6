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
  using dealii::numbers::PI;
  using Vector = dealii::Tensor<1, 3>;

  constexpr double R = 1e-3;

  DemParameters
  smooth_rolling()
  {
    DemParameters p                               = SmallColumn::parameters();
    p.contact.wall_surface.rolling_resistance     = 0.;
    p.contact.particle_surface.rolling_resistance = 0.;
    return p;
  }

  double
  height_of_plane(const SmallColumn &column)
  {
    return std::get<PlaneWall>(column.dem.vessel()[3].shape).point.z;
  }

  // A plane is where the integral of its velocity is (midpoint rule, 1e-9 m of 2e-4),
  // and a sphere upon it is pressed by its weight and its inertia. Before the clock
  // runs, nothing moves. Limit: 1 % of the overlap, which is small against the way.
  TEST(MovingWalls, SphereFollowsAnOscillatingPlane)
  {
    DemParameters p                    = SmallColumn::parameters();
    p.contact.wall_surface.restitution = 0.05;
    p.walls.planes                     = "floor: 0 0 0.004  0 0 -1";
    p.walls.motion = "floor = velocity 0; 0; 2e-4 * 100 * cos(100 * t)";
    SmallColumn  column(p);
    const double young = p.materials(false, column.dem.vessel()).with_wall(3, 0).young;
    column.dem.insert({Point<3>(1e-3, 0., 0.005)});
    column.dem.advance(0.05);
    EXPECT_EQ(height_of_plane(column), 0.004);
    EXPECT_EQ(column.dem.clock(), 0.);

    column.dem.start_clock(0.);
    for (unsigned int n = 1; n <= 100; ++n)
      {
        column.dem.advance(1e-3);
        const double phase = 100. * column.dem.clock();
        EXPECT_NEAR(column.dem.clock(), 1e-3 * n, 1e-15);
        EXPECT_NEAR(height_of_plane(column), 0.004 + 2e-4 * std::sin(phase), 1e-9);
        if (n < 20)
          continue;
        const double force = p.particles.simulated_mass() * (9.81 - 2. * std::sin(phase));
        const double overlap = hertz_overlap(force, young, R);
        EXPECT_NEAR(
          height_of_plane(column) + R - column.position(0)[2], overlap, 0.01 * overlap);
      }
  }

  // A blade that turns about the axis of the vessel, ever faster, pushes a sphere along
  // the wall: it goes round with the blade, a radius ahead of it, and the blade's torque
  // is what speeds it up. Limits: overlaps.
  TEST(MovingWalls, PaddlePushesASphere)
  {
    DemParameters p                    = smooth_rolling();
    p.particles.gravity                = 0.;
    p.contact.wall_surface.friction    = 0.;
    p.contact.wall_surface.restitution = 0.05;
    Triangles blade;
    add_quad(blade,
             {{Point<3>(0., 0., 2e-3),
               Point<3>(4.9e-3, 0., 2e-3),
               Point<3>(4.9e-3, 0., 12e-3),
               Point<3>(0., 0., 12e-3)}});
    p.walls.surfaces = "paddle: " + write_stl("paddle", blade);
    p.walls.motion   = "paddle = rotation 0 0 0; 0 0 2; 20 * t";
    SmallColumn column(p);
    column.dem.insert({Point<3>(2e-3, 1.01e-3, 7e-3)});
    column.dem.start_clock(0.);
    column.dem.advance(0.8);

    const auto   x     = column.position(0);
    const double rho   = std::hypot(x[0], x[1]);
    const double angle = 10. * 0.8 * 0.8 + std::asin(R / rho);
    EXPECT_NEAR(rho, 4e-3, 1e-2 * R);
    EXPECT_NEAR(x[0], rho * std::cos(angle), 2e-2 * R);
    EXPECT_NEAR(x[1], rho * std::sin(angle), 2e-2 * R);
    const auto v = column.velocity(0);
    EXPECT_NEAR((x[0] * v[1] - x[1] * v[0]) / (rho * rho), 16., 0.01 * 16.);
    column.dem.advance(0.05);
    const double torque = p.particles.simulated_mass() * rho * rho * 20.;
    EXPECT_NEAR(
      column.dem.torque_on(column.dem.wall_number("paddle")), -torque, 0.02 * torque);
  }

  // A sphere that rolls without slip on a turntable goes round at 2/7 of its speed.
  // Source: Weltner (1979), doi:10.1119/1.11602. The same on the end of the vessel, on a
  // plane and on triangles. Limit 0.5 % of the way: the spring that holds it is
  // stretched.
  TEST(MovingWalls, SphereOnATurntable)
  {
    const double r = 2.5e-3, omega = 20., duration = 0.25;
    for (const std::string kind : {"bottom", "plane", "surface"})
      {
        DemParameters p = smooth_rolling();
        const double  z = kind == "bottom" ? 0. : 3e-3;
        if (kind == "plane")
          p.walls.planes = "table: 0 0 0.003  0 0 -1";
        if (kind == "surface")
          {
            Triangles    floor;
            const double a = 8e-3;
            add_quad(floor,
                     {{Point<3>(-a, -a, z),
                       Point<3>(a, -a, z),
                       Point<3>(a, a, z),
                       Point<3>(-a, a, z)}});
            p.walls.surfaces = "table: " + write_stl("table", floor);
          }
        p.walls.motion = (kind == "bottom" ? "bottom" : "table") +
                         std::string(" = rotation 0 0 0; 0 0 1; 20");
        SmallColumn column(p);
        const auto  materials = p.materials(false, column.dem.vessel());
        const auto  overlap   = hertz_overlap(9.81 * p.particles.simulated_mass(),
                                           materials.with_wall(bottom_wall, 0).young,
                                           R);
        NewParticle sphere;
        sphere.position = Point<3>(r, 0., z + R - overlap);
        sphere.radius   = R;
        sphere.velocity = Vector({0., 2. / 7. * omega * r, 0.});
        sphere.spin     = Vector({5. / 7. * omega * r / R, 0., 0.});
        column.dem.insert({sphere});
        column.dem.start_clock(0.);
        column.dem.advance(duration);
        const double angle = 2. / 7. * omega * duration;
        const double limit = 5e-3 * angle * r;
        EXPECT_NEAR(column.position(0)[0], r * std::cos(angle), limit) << kind;
        EXPECT_NEAR(column.position(0)[1], r * std::sin(angle), limit) << kind;
      }
  }

  // A sphere in a drum that turns about a level axis rests where its weight and the
  // resistance to rolling balance: tan(angle) = mu_r. The drum's torque carries the
  // weight's, and its power is what the rolling loses.
  TEST(MovingWalls, SphereInADrumReachesTheAngleOfRollingFriction)
  {
    const double  mu = 0.2, omega = 5., drum = 5e-3;
    DemParameters p                           = SmallColumn::parameters();
    p.contact.rolling_model                   = "constant-torque";
    p.contact.wall_surface.rolling_resistance = mu;
    p.particles.gravity_direction             = Vector({-1., 0., 0.});
    p.walls.motion                            = "wall = rotation 0 0 0; 0 0 1; 5";
    SmallColumn  column(p);
    const double weight = 9.81 * p.particles.simulated_mass(), angle = std::atan(mu);
    const double young =
      p.materials(false, column.dem.vessel()).with_wall(lateral_wall, 0).young;
    const double arm = drum - R + hertz_overlap(weight * std::cos(angle), young, R);
    NewParticle  sphere;
    sphere.position = Point<3>(-arm * std::cos(angle), -arm * std::sin(angle), 0.015);
    sphere.radius   = R;
    sphere.spin     = Vector({0., 0., omega * drum / arm * arm / R});
    column.dem.insert({sphere});
    column.dem.start_clock(0.);
    column.dem.advance(0.5);
    const auto x = column.position(0);
    EXPECT_NEAR(std::atan2(-x[1], -x[0]), angle, 5e-3);
    column.dem.advance(0.2);
    EXPECT_NEAR(
      column.dem.torque_on(lateral_wall) / (weight * std::sin(angle) * arm), -1., 0.01);
    EXPECT_NEAR(column.dem.wall_force() / weight, 1., 1e-3);
    EXPECT_NEAR(column.dem.supported_weight() / weight, 1., 1e-3);
    EXPECT_EQ(column.dem.bottom_force(), 0.);
  }

  // A sphere that sticks to a table in a corner of it goes along as the table turns: all
  // that turns together is at rest. It is held by friction for half a turn; without the
  // springs turning with the table it would creep. Limit: 1 % of the way.
  TEST(MovingWalls, ABodyThatTurnsWithItsTableRests)
  {
    DemParameters p                           = SmallColumn::parameters();
    p.contact.rolling_model                   = "spring-dashpot";
    p.contact.wall_surface.rolling_resistance = 1.;
    p.contact.wall_surface.friction           = 1.;
    p.walls.motion = "bottom = rotation 0 0 0; 0 0 1; 4 * min(1, 10 * t)";
    SmallColumn column(p);
    column.dem.insert({Point<3>(3e-3, 0., R)});
    column.dem.advance(0.05);
    column.dem.start_clock(0.);
    column.dem.advance(0.8);
    const auto   x     = column.position(0);
    const double angle = 4. * (0.8 - 0.05);
    EXPECT_NEAR(x[0], 3e-3 * std::cos(angle), 1e-2 * angle * 3e-3);
    EXPECT_NEAR(x[1], 3e-3 * std::sin(angle), 1e-2 * angle * 3e-3);
  }

  // What moves a list of neighbours must notice: a fast blade that comes from afar meets
  // the sphere with any skin in the same way, bit by bit.
  TEST(MovingWalls, TheSkinChangesNothing)
  {
    std::map<std::int64_t, std::vector<double>> states[2];
    for (const unsigned int k : {0, 1})
      {
        DemParameters p     = SmallColumn::parameters();
        p.particles.gravity = 0.;
        p.contact.skin      = k == 0 ? 0.1 : 0.8;
        p.contact.substep   = 1e-5;
        p.walls.planes      = "press: 0 0 0.02  0 0 1";
        p.walls.surfaces    = "box: " + write_stl("box",
                                               box_shape(Point<3>(-4e-3, -4e-3, 22e-3),
                                                         Point<3>(-1e-3, 4e-3, 25e-3)));
        p.walls.motion      = "press = velocity 0; 0; -0.3 | box = velocity 0; 0; -0.8 | "
                              "box = rotation 0 0 0.025; 0 1 0; 30 * t";
        SmallColumn column(p);
        column.dem.insert({Point<3>(-2e-3, 0., 4e-3), Point<3>(2e-3, 1e-3, 5e-3)});
        column.dem.start_clock(0.);
        column.dem.advance(0.022);
        states[k] = column.state();
      }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_GT(std::abs(states[0][0][5]) + std::abs(states[0][1][5]), 0.2);
  }

  WallParameters
  walls_with(const std::function<void(WallParameters &)> &change)
  {
    WallParameters walls;
    walls.planes   = "floor: 0 0 0.003 0 0 -1, 0 0 0.02 0 0 1";
    walls.surfaces = "drum: drum.stl, parts/side-2.stl";
    change(walls);
    return walls;
  }

  TEST(MovingWalls, NamesAreThoseOfThePlanesAndSurfaces)
  {
    const auto                     walls = walls_with([](auto &) {});
    const std::vector<std::string> expected{
      "wall", "bottom", "top", "floor", "plane 2", "drum", "parts/side-2.stl"};
    EXPECT_EQ(walls.names(), expected);
    walls.check();
    walls_with([](auto &w) {
      w.motion = "floor = velocity 0; 0; sin(2*pi*t) | drum = rotation 0 0 0; 1 0 0; 2 |"
                 "drum = velocity 1; 0; 0 | wall = rotation 0 0 1; 0 0 -1; t |"
                 "wall = velocity 0; 0; 0.1 | bottom = velocity t; 1; 0 |"
                 "top = rotation 1 2 3; 0 0 1; 5";
      w.gates  = "floor until settled, floor from 3, plane 2 from 0.5, plane 2 until 1";
      w.containers = "drum";
    }).check();
  }

  TEST(MovingWalls, WhatCannotBeIsRefused)
  {
    for (const std::string planes : {"wall: 0 0 1 0 0 1",
                                     "top: 0 0 1 0 0 1",
                                     "a: 0 0 1 0 0 1, a: 0 0 2 0 0 1",
                                     "2: 0 0 1 0 0 1",
                                     ": 0 0 1 0 0 1",
                                     "a=b: 0 0 1 0 0 1",
                                     "plane 2: 0 0 1 0 0 1, 0 0 2 0 0 1",
                                     "a: 0 0 1 0 0",
                                     "a: 0 0 nan 0 0 1"})
      EXPECT_THROW(walls_with([&](auto &w) { w.planes = planes; }).check(), InputError)
        << planes;
    EXPECT_THROW(walls_with([&](auto &w) { w.surfaces = "a.stl, a.stl"; }).check(),
                 InputError);
    EXPECT_THROW(walls_with([&](auto &w) { w.containers = "floor"; }).check(),
                 InputError);
    EXPECT_THROW(walls_with([&](auto &w) { w.containers = "tank"; }).check(), InputError);
    for (const std::string motion :
         {"floor",
          "roof = velocity 0; 0; 1",
          "floor = velocity 0; 1",
          "floor = velocity 0; 0; sin(",
          "floor = velocity 0; 0; x",
          "floor = shake 0; 0; 1",
          "floor = rotation 0 0 0; 0 0 0; 1",
          "floor = rotation 0 0; 0 0 1; 1",
          "floor = rotation 0 0 0; 0 0 1",
          "floor = velocity 0; 0; 1 | floor = velocity 1; 0; 0",
          "wall = velocity 1; 0; 0",
          "wall = rotation 1 0 0; 0 0 1; 1",
          "wall = rotation 0 0 0; 1 0 0; 1",
          "bottom = velocity 0; 0; 1",
          "top = rotation 0 0 0; 0 1 0; 1"})
      EXPECT_THROW(walls_with([&](auto &w) { w.motion = motion; }).check(), InputError)
        << motion;
    EXPECT_THROW(walls_with([](auto &w) {
                   w.bottom = "open";
                   w.motion = "bottom = rotation 0 0 0; 0 0 1; 1";
                 }).check(),
                 InputError);
    EXPECT_THROW(walls_with([](auto &w) {
                   w.planes = "lift: 0 0 0 0 0 -1 0 0 1";
                   w.motion = "lift = velocity 0; 0; 1";
                 }).check(),
                 InputError);
    for (const std::string gates : {"floor",
                                    "floor until",
                                    "roof until 1",
                                    "floor until now",
                                    "floor until -1",
                                    "floor from settled",
                                    "floor until 1, floor until 2",
                                    "floor until 1, floor from 1",
                                    "bottom until 1",
                                    "wall from 1"})
      EXPECT_THROW(walls_with([&](auto &w) { w.gates = gates; }).check(), InputError)
        << gates;
  }

  // A speed that is no number any more stops the run, by name.
  TEST(MovingWalls, SpeedThatIsNoNumberStops)
  {
    DemParameters p = SmallColumn::parameters();
    p.walls.planes  = "floor: 0 0 0.003 0 0 -1";
    p.walls.motion  = "floor = velocity 0; 0; -sqrt(0.01 - t)";
    SmallColumn column(p);
    column.dem.insert({Point<3>(0., 0., 0.02)});
    column.dem.start_clock(0.);
    try
      {
        column.dem.advance(0.02);
        FAIL() << "went on";
      }
    catch (const DemError &error)
      {
        EXPECT_NE(std::string(error.what()).find("floor"), std::string::npos);
      }
  }

  TEST(MovingWalls, PairsNameWallsThatExist)
  {
    const auto check = [](const std::string &pairs) {
      DemParameters p  = SmallColumn::parameters();
      p.walls.planes   = "floor: 0 0 0.003 0 0 -1, 0 0 0.02 0 0 1";
      p.walls.surfaces = "parts/side-2.stl";
      p.contact.pairs  = pairs;
      p.check(SmallColumn::vessel());
      return p;
    };
    check(
      "1-floor friction 0.3, plane 2-1 friction 0.2, 1-parts/side-2.stl friction 0.1, "
      "parts/side-2.stl-1 restitution 0.5");
    const auto p     = check("floor-1 friction 0.3");
    auto       walls = p.walls;
    walls.surfaces   = "";
    EXPECT_EQ(
      p.materials(false, walls.walls(SmallColumn::vessel())).with_wall(3, 0).friction,
      0.3);
    for (const std::string pairs : {"1-plane 7 friction 0.3",
                                    "1-plane 1 friction 0.3",
                                    "1-side friction 0.3",
                                    "1-2 friction 0.3",
                                    "floor-wall friction 0.3",
                                    "1-floor friction 0.3m"})
      EXPECT_THROW(check(pairs), InputError) << pairs;
  }

  // Files are meant as seen from the parameter file, and keep the names they have there.
  TEST(MovingWalls, SurfacesAreRelativeToTheParameterFile)
  {
    WallParameters           walls;
    dealii::ParameterHandler prm;
    walls.declare(prm);
    ParameterFile      file(prm);
    std::istringstream text(
      "subsection Walls\n set surfaces = drum: a/drum.stl, b.stl\nend\n");
    file.read(text, "/somewhere/case.prm");
    EXPECT_EQ(walls.surfaces, "drum: /somewhere/a/drum.stl, b.stl: /somewhere/b.stl");
    const std::vector<std::string> expected{"wall", "bottom", "top", "drum", "b.stl"};
    EXPECT_EQ(walls.names(), expected);
    // Written and read again it is the same.
    std::istringstream again("subsection Walls\n set surfaces = " + walls.surfaces +
                             "\nend\n");
    file.read(again, "/elsewhere/case.prm");
    EXPECT_EQ(walls.surfaces, "drum: /somewhere/a/drum.stl, b.stl: /somewhere/b.stl");
  }
} // namespace
