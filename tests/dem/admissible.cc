// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"
#include "stl_shapes.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/particles/dem_error.h>

#include <random>

namespace
{
  using namespace graupel;
  using dealii::Point;

  // Octahedron |x| + |y| + |z| = a around a center, wound anyhow.
  Triangles
  octahedron(const Point<3> &center, const double a)
  {
    Triangles triangles;
    for (const double x : {-a, a})
      for (const double y : {-a, a})
        for (const double z : {-a, a})
          triangles.push_back({{center + dealii::Tensor<1, 3>({x, 0., 0.}),
                                center + dealii::Tensor<1, 3>({0., y, 0.}),
                                center + dealii::Tensor<1, 3>({0., 0., z})}});
    return triangles;
  }

  TEST(Admissible, InsideOfAnOctahedronByItsFormula)
  {
    const Point<3>    center(3e-3, -2e-3, 0.1);
    const SurfaceMesh mesh(octahedron(center, 2e-3));
    EXPECT_TRUE(mesh.is_closed());
    std::mt19937_64                        generator(7);
    std::uniform_real_distribution<double> even(-2.5e-3, 2.5e-3);
    for (unsigned int n = 0; n < 5000; ++n)
      {
        const dealii::Tensor<1, 3> x({even(generator), even(generator), even(generator)});
        const double size = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
        EXPECT_EQ(mesh.contains(center + x), size < 2e-3) << x;
      }
    // Below corners and edges, where a ray straight up is unclear.
    for (const double z : {-1.9e-3, 0., 1e-4, 1.9e-3})
      EXPECT_TRUE(mesh.contains(center + dealii::Tensor<1, 3>({0., 0., z})));
    EXPECT_TRUE(mesh.contains(center + dealii::Tensor<1, 3>({1e-3, 0., -5e-4})));
    EXPECT_FALSE(mesh.contains(center + dealii::Tensor<1, 3>({0., 0., -2.1e-3})));
  }

  // A hollow is outside; a sheet has no inside.
  TEST(Admissible, HollowBodiesAndSheets)
  {
    Triangles  walls = box_shape(Point<3>(0., 0., 0.), Point<3>(4., 4., 4.));
    const auto inner = box_shape(Point<3>(1., 1., 1.), Point<3>(3., 3., 3.));
    Triangles  sheet = walls;
    sheet.pop_back();
    walls.insert(walls.end(), inner.begin(), inner.end());
    const SurfaceMesh hollow(walls), open(sheet);
    EXPECT_TRUE(hollow.is_closed());
    EXPECT_FALSE(open.is_closed());
    for (double x = -0.5; x < 5.; x += 0.5)
      for (double z = -0.5; z < 5.; z += 0.5)
        {
          if (x == 0. || x == 1. || x == 3. || x == 4. || z == 0. || z == 1. || z == 3. ||
              z == 4.)
            continue; // on a face
          const auto within = [&](const double low, const double high) {
            return x > low && x < high && z > low && z < high;
          };
          EXPECT_EQ(hollow.contains({x, 2., z}), within(0., 4.) && !within(1., 3.));
          EXPECT_FALSE(open.contains({x, 2., z}));
        }
  }

  TEST(Admissible, ByWalls)
  {
    const Wall plane{"plane", PlaneWall{{0., 0., 1.}, {0., 0., -1.}}};
    EXPECT_TRUE(plane.is_admissible({0., 0., 1.2}, 0.1));
    EXPECT_FALSE(plane.is_admissible({0., 0., 1.05}, 0.1));
    EXPECT_FALSE(plane.is_admissible({0., 0., -3.}, 0.));
    Wall body{
      "body",
      SurfaceWall{SurfaceMesh(box_shape(Point<3>(0., 0., 0.), Point<3>(1., 1., 1.)))}};
    EXPECT_FALSE(body.is_admissible({0.5, 0.5, 0.5}, 0.1));
    EXPECT_FALSE(body.is_admissible({1.05, 0.5, 0.5}, 0.1));
    EXPECT_TRUE(body.is_admissible({1.2, 0.5, 0.5}, 0.1));
    // Wherever it is now.
    body.place({{2., 0., 0.}, 0.}, {});
    EXPECT_TRUE(body.is_admissible({0.5, 0.5, 0.5}, 0.1));
    EXPECT_FALSE(body.is_admissible({2.5, 0.5, 0.5}, 0.1));
    std::get<SurfaceWall>(body.shape).is_container = true;
    EXPECT_TRUE(body.is_admissible({2.5, 0.5, 0.5}, 0.1));
    EXPECT_FALSE(body.is_admissible({2.5, 0.5, 0.95}, 0.1));
    EXPECT_FALSE(body.is_admissible({0.5, 0.5, 0.5}, 0.1));

    const std::vector<Wall> walls{plane, body};
    EXPECT_EQ(first_refusing_wall(walls, {0.5, 0.5, 0.5}, 0.1), &walls[0]);
    EXPECT_EQ(first_refusing_wall(walls, {0.5, 0.5, 1.5}, 0.1), &walls[1]);
    EXPECT_EQ(first_refusing_wall(walls, {0.5, 0.5, 1.5}, 0.1, 2), nullptr);
  }

  // A place beyond a wall or inside of a body is refused, whoever gives it.
  TEST(Admissible, ParticlesInPlacesThatCannotBe)
  {
    DemParameters p    = SmallColumn::parameters();
    p.walls.planes     = "floor: 0 0 0.003 0 0 -1";
    p.walls.surfaces   = "box: " + write_stl("block",
                                           box_shape(Point<3>(-3e-3, -3e-3, 10e-3),
                                                     Point<3>(3e-3, 3e-3, 16e-3)));
    const auto message = [&](const auto &act) -> std::string {
      try
        {
          act();
        }
      catch (const DemError &error)
        {
          return error.what();
        }
      return {};
    };
    SmallColumn column(p);
    EXPECT_NE(
      message([&]() { column.dem.insert({Point<3>(0., 0., 13e-3)}); }).find("box"),
      std::string::npos);
    EXPECT_NE(
      message([&]() { column.dem.insert({Point<3>(0., 0., 2e-3)}); }).find("floor"),
      std::string::npos);
    SmallColumn empty(SmallColumn::parameters());
    empty.dem.insert({Point<3>(0., 0., 13e-3)});
    const DemState state = empty.dem.state();
    EXPECT_NE(message([&]() { column.dem.restore(state); }).find("box"),
              std::string::npos);
  }

  // No sphere is placed inside a closed box, and all are inside of a container.
  TEST(Admissible, PlacesOfAFilling)
  {
    const Point<3> lower(-2.5e-3, -2.5e-3, 5e-3), upper(2.5e-3, 2.5e-3, 20e-3);
    for (const bool is_container : {false, true})
      {
        DemParameters p      = SmallColumn::parameters();
        p.particles.diameter = 1e-3;
        p.walls.surfaces     = "box: " + write_stl("box", box_shape(lower, upper));
        p.walls.containers   = is_container ? "box" : "";
        SmallColumn       column(p);
        FillingParameters filling;
        filling.method     = "volume";
        filling.count      = 100;
        filling.bed_height = 0.;
        Filling fill(filling, column.dem);
        while (fill.step())
          ;
        unsigned int inside = 0;
        for (unsigned int i = 0; i < column.dem.particles().n_owned; ++i)
          inside += dealii::BoundingBox<3>({lower, upper})
                      .point_inside(column.dem.particles().body[i].position);
        EXPECT_EQ(dealii::Utilities::MPI::sum(inside, column.dem.communicator()),
                  is_container ? 100u : 0u);
        EXPECT_EQ(column.dem.n_global(), 100u);
      }
    WallParameters walls;
    Triangles      open = box_shape(lower, upper);
    open.pop_back();
    walls.surfaces   = "box: " + write_stl("open_box", open);
    walls.containers = "box";
    EXPECT_THROW(walls.walls(SmallColumn::vessel()), InputError);
  }
} // namespace
