// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <graupel/base/parameters.h>
#include <graupel/mesh/vessel_mesh.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  struct Measures
  {
    double volume = 0., wall = 0., bottom = 0., top = 0.;
  };

  // Volume and areas by quadrature with the mesh's own mapping, over all ranks.
  Measures
  measure(const VesselMesh &mesh)
  {
    const dealii::FE_Nothing<3> nothing;
    const dealii::QGauss<3>     points(3);
    const dealii::QGauss<2>     face_points(3);
    dealii::FEValues<3>         cell_values(
      mesh.mapping(), nothing, points, dealii::update_JxW_values);
    dealii::FEFaceValues<3> face_values(
      mesh.mapping(), nothing, face_points, dealii::update_JxW_values);
    Measures              sum;
    std::array<double, 3> areas{};
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell_values.reinit(cell);
          for (const double weight : cell_values.get_JxW_values())
            sum.volume += weight;
          for (const unsigned int face : cell->face_indices())
            if (cell->face(face)->at_boundary())
              {
                face_values.reinit(cell, face);
                for (const double weight : face_values.get_JxW_values())
                  areas[cell->face(face)->boundary_id()] += weight;
              }
        }
    const auto total = [&](const double value) {
      return dealii::Utilities::MPI::sum(value, mesh.communicator());
    };
    return {total(sum.volume),
            total(areas[VesselMesh::wall]),
            total(areas[VesselMesh::bottom]),
            total(areas[VesselMesh::top])};
  }
} // namespace

TEST(VesselMesh, FillsTheCylinderToTheOrderOfTheMapping)
{
  const Cylinder cylinder;
  double         last_error = 0.;
  for (const double cell_size : {6.4e-3, 3.2e-3})
    {
      const VesselMesh mesh(cylinder, {cell_size}, MPI_COMM_WORLD);
      const Measures   found  = measure(mesh);
      const double     volume = cylinder.cross_section() * cylinder.height;
      const double     error  = std::abs(found.volume / volume - 1.);
      // A quadratic arc over an angle t errs by t^4 in area: with 16 arcs round
      // the coarse circle below 1e-4, and 16 times less after one refinement.
      EXPECT_LE(error, 1e-3) << "volume " << found.volume << " of " << volume;
      EXPECT_NEAR(
        found.bottom, cylinder.cross_section(), 1e-3 * cylinder.cross_section());
      EXPECT_NEAR(found.top, found.bottom, 1e-10 * found.bottom);
      EXPECT_NEAR(found.wall,
                  dealii::numbers::PI * cylinder.diameter * cylinder.height,
                  1e-3 * found.wall);
      if (last_error > 0.)
        {
          EXPECT_NEAR(std::log2(last_error / error), 4., 0.3)
            << "errors " << last_error << " and " << error;
        }
      last_error = error;
    }
}

TEST(VesselMesh, HasTheCellsOfThePaperColumn)
{
  const VesselMesh mesh(Cylinder{}, {3.2e-3}, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.triangulation().n_global_active_cells(), 2496u);
  EXPECT_GE(mesh.smallest_edge(), 1.5e-3);
  EXPECT_LE(mesh.smallest_edge(), 3.2e-3);
}

TEST(VesselMesh, RefusesImpossibleSizes)
{
  const auto parameter_refused = [](const auto &action) -> std::string {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return "nothing";
  };
  EXPECT_EQ(parameter_refused([] { Cylinder{0., 0.1}.check(); }), "Geometry/diameter");
  EXPECT_EQ(parameter_refused([] { Cylinder{0.1, -1.}.check(); }), "Geometry/height");
  EXPECT_EQ(parameter_refused([] { MeshParameters{std::nan("")}.check(Cylinder{}); }),
            "Mesh/cell size");
  EXPECT_EQ(parameter_refused([] { MeshParameters{0.02}.check(Cylinder{}); }),
            "Mesh/cell size");
}
