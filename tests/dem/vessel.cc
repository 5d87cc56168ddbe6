// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/particles/dem_error.h>

#include <fstream>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  DemParameters
  with_ends(const std::string &bottom, const std::string &top)
  {
    DemParameters p = SmallColumn::parameters();
    p.walls.bottom  = bottom;
    p.walls.top     = top;
    return p;
  }

  std::string
  rank_file(const std::string &name)
  {
    return testing::TempDir() + name +
           std::to_string(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  }

  // Particles leave through an open end, are counted, and take their mass along;
  // the others stay as they are.
  TEST(Vessel, OpenEndLetsParticlesGo)
  {
    SmallColumn column(with_ends("open", "closed"));
    column.dem.insert({Point<3>(0., 0., 0.002), Point<3>(2.5e-3, 0., 0.029)});
    const double both = column.dem.weight();
    column.dem.advance(0.03);
    EXPECT_EQ(column.dem.n_global(), 1u);
    EXPECT_EQ(column.dem.n_departed(), 1u);
    EXPECT_NEAR(column.dem.weight(), both / 2., 1e-9 * both);
    EXPECT_NEAR(column.position(1)[2], 0.029 - 0.5 * 9.81 * 9e-4, 1e-12);
    EXPECT_EQ(column.dem.bottom_force(), 0.);
    column.dem.advance(0.06);
    EXPECT_EQ(column.dem.n_global(), 0u);
    EXPECT_EQ(column.dem.n_departed(), 2u);
  }

  // What leaves a periodic end comes in at the other at the same speed.
  TEST(Vessel, PeriodicEndsReturnParticles)
  {
    DemParameters p     = with_ends("periodic", "periodic");
    p.particles.gravity = 0.;
    SmallColumn column(p);
    column.dem.insert({Point<3>(0., 0., 0.002)}, Vector({0., 0., -0.7}));
    column.dem.advance(0.1);
    column.dem.synchronise();
    EXPECT_NEAR(column.position(0)[2], 0.002 - 0.07 + 3. * 0.03, 1e-12);
    EXPECT_EQ(column.velocity(0)[2], -0.7);
    EXPECT_EQ(column.dem.n_global(), 1u);
  }

  // Law: a periodic vessel looks the same wherever it is cut. Three spheres in a
  // long oblique contact with friction, in the middle and across the ends: the same
  // motion up to the rounding of the shifted places, 1e-9 of a diameter.
  TEST(Vessel, ContactsThroughPeriodicEnds)
  {
    std::vector<Vector> velocities[2], spins[2];
    for (const unsigned int k : {0, 1})
      {
        DemParameters p     = with_ends("periodic", "periodic");
        p.particles.gravity = 0.;
        SmallColumn  column(p);
        const double z  = k == 0 ? 0.015 : 0.03;
        const auto   at = [&](const double x, const double height) {
          return Point<3>(x, 0., std::fmod(z + height, 0.03));
        };
        column.dem.insert({at(-2e-4, -1.1e-3), at(2e-4, 1.1e-3), at(0., 3.2e-3)});
        column.set_velocity(0, Vector({0.1, 0.05, 0.4}));
        for (unsigned int n = 0; n < 20; ++n)
          {
            column.dem.advance(5e-4);
            if (n % 3 == 0)
              column.dem.synchronise();
          }
        for (const int id : {0, 1, 2})
          {
            velocities[k].push_back(column.velocity(id));
            spins[k].push_back(column.spin(id));
          }
        Vector momentum;
        for (const auto &v : velocities[k])
          momentum += v;
        EXPECT_NEAR((momentum - Vector({0.1, 0.05, 0.4})).norm(), 0., 1e-9);
      }
    EXPECT_GT(velocities[0][2].norm(), 0.1);
    for (const unsigned int id : {0, 1, 2})
      {
        EXPECT_NEAR((velocities[0][id] - velocities[1][id]).norm(), 0., 1e-7);
        EXPECT_NEAR((spins[0][id] - spins[1][id]).norm(), 0., 1e-3);
      }
  }

  // A plane that moves pushes what it meets: in its frame the sphere approaches at
  // its speed and returns at e times that. Limit 1 %: time error of the impact.
  TEST(Vessel, MovingPlanePushes)
  {
    DemParameters p                    = SmallColumn::parameters();
    p.particles.gravity                = 0.;
    p.contact.wall_surface.restitution = 0.8;
    p.contact.time_fraction            = 0.05;
    p.walls.planes                     = "0 0 0.004  0 0 -1  0 0 0.5";
    SmallColumn column(p);
    column.dem.insert({Point<3>(0., 0., 0.006)});
    column.dem.advance(8e-3);
    EXPECT_NEAR(column.velocity(0)[2], 0.9, 0.01 * 0.9);
    EXPECT_NEAR(std::get<PlaneWall>(column.dem.vessel()[3].shape).point.z, 0.008, 1e-12);
  }

  // Writes a square of two triangles at a height, in millimetres.
  std::string
  write_floor(const double height)
  {
    const std::string name = rank_file("floor.stl");
    std::ofstream     file(name);
    const double      a       = 8.;
    const double      c[4][2] = {{-a, -a}, {a, -a}, {a, a}, {-a, a}};
    file << "solid floor\n";
    for (const auto &corners : {std::array<int, 3>{{0, 1, 2}}, {{0, 2, 3}}})
      {
        file << "facet normal 0 0 1\nouter loop\n";
        for (const int k : corners)
          file << "vertex " << c[k][0] << ' ' << c[k][1] << ' ' << 1e3 * height << '\n';
        file << "endloop\nendfacet\n";
      }
    file << "endsolid floor\n";
    return name;
  }

  // A floor of triangles is a plane: a sphere that hits it obliquely, slides and
  // rolls over its diagonal moves as on the plane wall, through migrations. Limit:
  // the rounding of the nearest point.
  TEST(Vessel, FloorOfTrianglesIsAPlane)
  {
    std::vector<Vector> after[2];
    for (const unsigned int k : {0, 1})
      {
        DemParameters p = SmallColumn::parameters();
        if (k == 0)
          p.walls.planes = "0 0 0.005  0 0 -1";
        else
          p.walls.surfaces = write_floor(0.005);
        SmallColumn column(p);
        column.dem.insert({Point<3>(-2e-3, 1e-4, 0.008), Point<3>(1e-3, -2e-3, 0.0062)},
                          Vector({0.03, 0.01, 0.}));
        for (unsigned int n = 0; n < 20; ++n)
          {
            column.dem.advance(3e-3);
            column.dem.synchronise();
          }
        after[k] = {Vector(column.position(0)),
                    column.velocity(0),
                    1e-3 * column.spin(0),
                    Vector(column.position(1)),
                    column.dem.force_on(3)};
        EXPECT_NEAR(
          -column.dem.force_on(3)[2], column.dem.weight(), 0.02 * column.dem.weight());
        EXPECT_NEAR(column.position(0)[2], 0.006, 2e-5);
        const auto states = column.dem.contact_states();
        for (const auto &state : states)
          if (state.second < 0 && wall_of(state.second) == 3)
            {
              EXPECT_NEAR(state.normal[2], -1., 1e-9);
            }
      }
    for (unsigned int n = 0; n < after[0].size(); ++n)
      EXPECT_NEAR((after[0][n] - after[1][n]).norm(), 0., 1e-9) << n;
  }

  TEST(Vessel, WallsThatCannotBe)
  {
    const auto walls = [](const auto &change) {
      WallParameters parameters;
      change(parameters);
      parameters.check();
      return parameters.walls(SmallColumn::vessel());
    };
    EXPECT_EQ(walls([](auto &w) { w.planes = "0 0 1 0 0 1, 0 0 1 0 0 2 1 1 1"; }).size(),
              5u);
    EXPECT_THROW(walls([](auto &w) { w.planes = "0 0 1 0 0"; }), InputError);
    EXPECT_THROW(walls([](auto &w) { w.planes = "0 0 1 0 0 0"; }), InputError);
    EXPECT_THROW(walls([](auto &w) { w.planes = "0 0 a 0 0 1"; }), InputError);
    EXPECT_THROW(walls([](auto &w) { w.top = "periodic"; }), InputError);
    EXPECT_THROW(walls([](auto &w) { w.surfaces = "no-such-file.stl"; }), InputError);
  }
} // namespace
