// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/adaption.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // A bed in the lower half of a column, on the mesh as it is now.
  struct Bed
  {
    explicit Bed(VesselMesh &mesh)
      : mesh(mesh)
      , nodes(mesh)
    {
      for (NodalVector *field : {&void_fraction, &flux, &pressure})
        nodes.initialize(*field);
      for (const auto &cell : nodes.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            if (const auto k = cell->vertex_dof_index(v, 0);
                nodes.measure().get_partitioner()->in_local_range(k))
              {
                void_fraction(k) = cell->vertex(v)[2] < surface ? 0.4 : 1.;
                pressure(k)      = std::abs(cell->vertex(v)[2] - kink);
              }
      for (NodalVector *field : {&void_fraction, &flux, &pressure})
        {
          nodes.hanging_nodes.distribute(*field);
          field->update_ghost_values();
        }
    }

    bool
    mark(const AdaptionParameters &parameters)
    {
      return mark_cells(parameters, nodes, {void_fraction, flux, pressure}, mesh);
    }

    static constexpr double surface = 0.025, kink = 0.0375;
    VesselMesh             &mesh;
    NodalSpace              nodes;
    NodalVector             void_fraction, flux, pressure;
  };

  // Adapts until nothing changes any more; the number of cells.
  unsigned int
  adapt(VesselMesh &mesh, const AdaptionParameters &parameters)
  {
    for (unsigned int n = 0; n < 8 && Bed(mesh).mark(parameters); ++n)
      mesh.adapt([](const auto &, const auto) { return 1000u; });
    return mesh.triangulation().n_global_active_cells();
  }

  std::unique_ptr<VesselMesh>
  column()
  {
    return std::make_unique<VesselMesh>(
      Cylinder{0.025, 0.05}, MeshParameters{6.4e-3, 0.}, MPI_COMM_WORLD);
  }

  // Height of the highest and lowest refined cell of any rank.
  std::pair<double, double>
  refined_heights(const VesselMesh &mesh)
  {
    double low = 1., high = 0.;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->level() > mesh.base_level())
        {
          low  = std::min(low, cell->center()[2]);
          high = std::max(high, cell->center()[2]);
        }
    return {dealii::Utilities::MPI::min(low, MPI_COMM_WORLD),
            dealii::Utilities::MPI::max(high, MPI_COMM_WORLD)};
  }
} // namespace

TEST(Adaption, RefinesTheSurfaceOfABedToItsLimits)
{
  AdaptionParameters parameters;
  unsigned int       last = column()->triangulation().n_global_active_cells();
  for (const unsigned int levels : {1, 2})
    {
      const auto mesh           = column();
      parameters.maximum_levels = levels;
      const unsigned int cells  = adapt(*mesh, parameters);
      EXPECT_GT(cells, last);
      last                   = cells;
      const auto [low, high] = refined_heights(*mesh);
      EXPECT_NEAR(low, Bed::surface, 8e-3);
      EXPECT_NEAR(high, Bed::surface, 8e-3);
    }
}

TEST(Adaption, ObeysItsOtherLimits)
{
  const unsigned int n_coarse = column()->triangulation().n_global_active_cells();
  const auto         cells    = [](const AdaptionParameters &parameters) {
    return adapt(*column(), parameters);
  };
  AdaptionParameters parameters;
  parameters.smallest_cell = 4e-3;
  EXPECT_EQ(cells(parameters), n_coarse);
  parameters               = {};
  parameters.maximum_cells = n_coarse + 10;
  EXPECT_EQ(cells(parameters), n_coarse);
  parameters                = {};
  parameters.maximum_levels = 0;
  EXPECT_EQ(cells(parameters), n_coarse);
}

TEST(Adaption, RefinesAtTheWallAndWhereTheIndicatorIs)
{
  VesselMesh         at_wall({0.025, 0.05}, {6.4e-3, 0.}, MPI_COMM_WORLD);
  AdaptionParameters parameters;
  parameters.surface_threshold = 0.;
  parameters.at_wall           = true;
  adapt(at_wall, parameters);
  for (const auto &cell : at_wall.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && face->boundary_id() == VesselMesh::wall)
          {
            EXPECT_EQ(cell->level(), at_wall.base_level() + 1);
          }

  VesselMesh by_pressure({0.025, 0.05}, {6.4e-3, 0.}, MPI_COMM_WORLD);
  parameters.at_wall   = false;
  parameters.indicator = "pressure";
  ASSERT_TRUE(Bed(by_pressure).mark(parameters));
  by_pressure.adapt([](const auto &, const auto) { return 1000u; });
  const auto [low, high] = refined_heights(by_pressure);
  EXPECT_NEAR(low, Bed::kink, 8e-3);
  EXPECT_NEAR(high, Bed::kink, 8e-3);
}

TEST(Adaption, CoarsensWhereNothingAsksForMore)
{
  VesselMesh         mesh({0.025, 0.05}, {6.4e-3, 0.}, MPI_COMM_WORLD);
  const unsigned int n_coarse = mesh.triangulation().n_global_active_cells();
  AdaptionParameters parameters;
  EXPECT_GT(adapt(mesh, parameters), n_coarse);
  parameters.surface_threshold = 0.;
  EXPECT_EQ(adapt(mesh, parameters), n_coarse);
}
