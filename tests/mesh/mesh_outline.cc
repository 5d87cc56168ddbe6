// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/mesh/mesh_outline.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;

  constexpr dealii::types::manifold_id curved = 0;

  Cylinder
  cylinder(const double diameter, const double height)
  {
    Cylinder result;
    result.diameter = diameter;
    result.height   = height;
    return result;
  }

  // All of its boundary is named "side".
  MeshOutline
  outline_of(const Cylinder &around, const dealii::Triangulation<3> &mesh)
  {
    return MeshOutline(around, mesh, curved, {{"side", 0}});
  }

  // A box from z = 0 on, its corners moved.
  void
  make_box(dealii::Triangulation<3>                        &mesh,
           const unsigned int                               n,
           const double                                     half,
           const double                                     height,
           const std::function<Point<3>(const Point<3> &)> &move = {})
  {
    dealii::GridGenerator::subdivided_hyper_rectangle(
      mesh, {n, n, n}, Point<3>(-half, -half, 0.), Point<3>(half, half, height));
    if (move)
      dealii::GridTools::transform(move, mesh);
    mesh.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
  }

  TEST(AreaProfile, ParabolasAreExact)
  {
    const auto area = [](const double z) {
      return z < 0.3 ? 1. + z : 2. + (z - 0.5) * (z - 0.5);
    };
    const AreaProfile profile(area, {0., 0.3, 1.}, 0.25);
    for (const double z : {0.01, 0.29, 0.3, 0.31, 0.7, 0.999})
      EXPECT_NEAR(profile.area(z), area(z), 1e-14) << z;
    EXPECT_EQ(profile.area(1.1), 0.);
    const double low = 0.1 + 0.1 * 0.1 / 2., until_step = 0.3 + 0.3 * 0.3 / 2.;
    EXPECT_NEAR(profile.volume(0.1, 0.3), until_step - low, 1e-14);
    EXPECT_NEAR(profile.volume(-1., 0.5), until_step + 0.4 + 0.2 * 0.2 * 0.2 / 3., 1e-14);
    for (const double volume : {0.01, 0.3, 0.345, 1.})
      EXPECT_NEAR(profile.volume(0., profile.level(volume)), volume, 1e-14);
  }

  TEST(MeshOutline, ATaperedBoxHasItsSectionAndPlanes)
  {
    const double             half = 0.004, height = 0.03;
    dealii::Triangulation<3> mesh;
    make_box(mesh, 2, half, height, [&](const Point<3> &x) {
      const double wider = 1. + x[2] / height;
      return Point<3>(x[0] * wider, x[1] * wider, x[2]);
    });
    const auto outline = outline_of(cylinder(0.024, height), mesh);
    for (const double z : {0., 0.001, 0.015, 0.0299})
      {
        EXPECT_NEAR(
          outline.cross_section(z), std::pow(2. * half * (1. + z / height), 2), 1e-15);
      }
    EXPECT_NEAR(outline.volume(0., height), dealii::GridTools::volume(mesh), 1e-9 * 1e-6);
    ASSERT_EQ(outline.planes().size(), 4u);
    for (const FlatBoundary &plane : outline.planes())
      {
        EXPECT_EQ(plane.name, "side");
        EXPECT_NEAR(plane.normal[2], -half / std::hypot(half, height), 1e-9);
        EXPECT_NEAR(std::hypot(plane.point[0], plane.point[1]), half * 1.5, half * 0.1);
      }
    EXPECT_LT(outline.farthest_beyond_planes(), 1e-12);
    EXPECT_EQ(outline.curved_boundary(), "");
  }

  // Two boxes on top of each other, the upper one half as wide on each side: the section
  // jumps, and the top lies beyond the plane of the step by 10 mm.
  TEST(MeshOutline, AStepIsNotConvex)
  {
    dealii::Triangulation<3> mesh;
    dealii::GridGenerator::subdivided_hyper_rectangle(
      mesh, {4, 4, 2}, Point<3>(-0.008, -0.008, 0.), Point<3>(0.008, 0.008, 0.02));
    std::set<dealii::Triangulation<3>::active_cell_iterator> removed;
    for (const auto &cell : mesh.active_cell_iterators())
      if (const auto x = cell->center();
          x[2] > 0.01 && std::max(std::abs(x[0]), std::abs(x[1])) > 0.004)
        removed.insert(cell);
    dealii::Triangulation<3> stepped;
    dealii::GridGenerator::create_triangulation_with_removed_cells(
      mesh, removed, stepped);
    stepped.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
    const auto outline = outline_of(cylinder(0.024, 0.02), stepped);
    EXPECT_NEAR(outline.cross_section(0.00999), 256e-6, 1e-15);
    EXPECT_NEAR(outline.cross_section(0.01001), 64e-6, 1e-15);
    EXPECT_NEAR(outline.volume(0.005, 0.015), 1.6e-6, 1e-16);
    EXPECT_NEAR(outline.farthest_beyond_planes(), 0.01, 1e-12);
  }

  // Faces that are not flat: by triangles, to 1 % of what makes them curved.
  TEST(MeshOutline, ATwistedBoxIsCurved)
  {
    const double             half = 0.005, height = 0.02;
    dealii::Triangulation<3> mesh;
    make_box(mesh, 1, half, height, [&](const Point<3> &x) {
      const double angle = 0.5 * x[2] / height;
      return Point<3>(std::cos(angle) * x[0] - std::sin(angle) * x[1],
                      std::sin(angle) * x[0] + std::cos(angle) * x[1],
                      x[2]);
    });
    const auto   outline = outline_of(cylinder(0.024, height), mesh);
    const double volume = dealii::GridTools::volume(mesh), straight = 1e-4 * height;
    std::cout << "volume " << outline.volume(0., height) << ", of the mesh " << volume
              << ", not twisted " << straight << '\n';
    EXPECT_NEAR(outline.volume(0., height), volume, 0.02 * (straight - volume));
    EXPECT_EQ(outline.curved_boundary(), "side");
  }

  TEST(MeshOutline, ACylinderIsItsCircle)
  {
    const double             radius = 0.0125, height = 0.05;
    dealii::Triangulation<2> disc;
    dealii::Triangulation<3> mesh;
    dealii::GridGenerator::hyper_ball(disc, Point<2>(), radius);
    dealii::GridGenerator::extrude_triangulation(disc, 4, height, mesh);
    mesh.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && face->center()[2] > 1e-6 &&
            face->center()[2] < height - 1e-6)
          face->set_all_manifold_ids(curved);
    mesh.set_manifold(curved, dealii::CylindricalManifold<3>(2));
    const auto outline = outline_of(cylinder(2. * radius, height), mesh);
    for (const double z : {0., 0.01, 0.0499})
      EXPECT_NEAR(outline.cross_section(z), PI * radius * radius, 1e-15);
    EXPECT_TRUE(outline.planes().empty());
    EXPECT_EQ(outline.curved_boundary(), "");
  }
} // namespace
