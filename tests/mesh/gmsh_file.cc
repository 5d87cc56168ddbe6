// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/gmsh_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace graupel;

namespace
{
  const std::string duct = GRAUPEL_SOURCE_DIR "/prm/vessels/side-inlet.msh";
  const Cylinder    around_duct{0.022628, 0.06};

  // A file of each rank's own.
  std::string
  temporary(const std::string &name)
  {
    const auto rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    return (std::filesystem::temp_directory_path() /
            ("graupel-" + std::to_string(rank) + name))
      .string();
  }

  // A mesh in Gmsh's format 2.2, @p name giving the physical surface of a face.
  template <typename Name>
  void
  write(const std::string &file, const dealii::Triangulation<3> &mesh, const Name &name)
  {
    // Gmsh's order of corners: around the bottom, around the top.
    constexpr unsigned int              around[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    std::map<std::string, unsigned int> numbers;
    std::ostringstream                  elements;
    unsigned int                        n = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      {
        elements << ++n << " 5 2 1 1";
        for (const unsigned int v : around)
          elements << ' ' << cell->vertex_index(v) + 1;
        elements << '\n';
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const auto number =
                numbers.emplace(name(face->center()), numbers.size() + 2).first->second;
              elements << ++n << " 3 2 " << number << " 1";
              for (unsigned int v = 0; v < 4; ++v)
                elements << ' ' << face->vertex_index(around[v]) + 1;
              elements << '\n';
            }
      }
    std::ofstream stream(file);
    stream << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << numbers.size();
    for (const auto &[text, number] : numbers)
      stream << "\n2 " << number << " \"" << text << '"';
    stream << "\n$EndPhysicalNames\n$Nodes\n" << mesh.n_vertices() << '\n';
    stream.precision(17);
    for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
      stream << v + 1 << ' ' << mesh.get_vertices()[v] << '\n';
    stream << "$EndNodes\n$Elements\n" << n << '\n' << elements.str() << "$EndElements\n";
  }

  double
  area_of(const VesselMesh &mesh, const std::string &name)
  {
    double area = 0.;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == mesh.boundaries().at(name))
            area += face->measure();
    return dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD);
  }

  std::string
  complaint(const std::string &file, const Cylinder &cylinder)
  {
    try
      {
        const VesselMesh mesh(cylinder, {4e-3, 0., file}, MPI_COMM_WORLD);
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.parameter, "Mesh/file");
        return error.what();
      }
    return "";
  }

  void
  expect_contains(const std::string &text, const std::string &part)
  {
    EXPECT_NE(text.find(part), std::string::npos) << '"' << text << "\" lacks " << part;
  }
} // namespace

// The file is Gmsh's own; the duct's sizes are those of side-inlet.geo.
TEST(GmshFile, BoundariesHaveTheirNamesAndAreas)
{
  for (const double cell_size : {4e-3, 2e-3})
    {
      const VesselMesh mesh(around_duct, {cell_size, 0., duct}, MPI_COMM_WORLD);
      const double     halved = 4e-3 / cell_size;
      EXPECT_EQ(mesh.triangulation().n_global_active_cells(),
                240u * std::lround(std::pow(halved, 3)));
      EXPECT_EQ(mesh.base_level(), std::lround(std::log2(halved)));
      EXPECT_EQ(mesh.boundaries().at("bottom"), VesselMesh::bottom);
      EXPECT_EQ(mesh.boundaries().at("top"), VesselMesh::top);
      EXPECT_EQ(mesh.boundaries().at("wall"), VesselMesh::wall);
      EXPECT_EQ(mesh.boundaries().size(), 4u);
      const double side = 0.016;
      EXPECT_NEAR(area_of(mesh, "bottom"), side * side, 1e-12);
      EXPECT_NEAR(area_of(mesh, "side"), side * 0.012, 1e-12);
      EXPECT_NEAR(area_of(mesh, "wall"), side * (4. * 0.06 - 0.012), 1e-12);
      EXPECT_NEAR(mesh.mean_cross_section(), side * side, 1e-12);
      for (const double z : {0., 1e-6, 0.012, 0.03, 0.0599})
        EXPECT_NEAR(mesh.outline()->cross_section(z), side * side, 1e-12);
      EXPECT_FALSE(mesh.fills_cylinder());
    }
}

TEST(GmshFile, AWallOnTheCylinderFollowsIt)
{
  const double             radius = 0.0125, height = 0.05;
  dealii::Triangulation<2> disc;
  dealii::Triangulation<3> solid;
  dealii::GridGenerator::hyper_ball_balanced(disc, dealii::Point<2>(), radius);
  dealii::GridGenerator::extrude_triangulation(disc, 9, height, solid);
  const std::string file = temporary("-cylinder.msh");
  write(file, solid, [&](const dealii::Point<3> &x) -> std::string {
    return x[2] < 1e-9 ? "bottom" : x[2] > height - 1e-9 ? "top" : "wall";
  });
  const Cylinder   cylinder{2. * radius, height};
  const VesselMesh mesh(cylinder, {1.6e-3, 0., file}, MPI_COMM_WORLD);
  const double     relative = mesh.mean_cross_section() / cylinder.cross_section() - 1.;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << mesh.triangulation().n_global_active_cells()
              << " cells, cross-section off by " << relative << '\n';
  // Arcs by parabolas; a polygon of as many sides would lack 0.6 %.
  EXPECT_NEAR(relative, 0., 1e-5);
  std::filesystem::remove(file);
}

TEST(GmshFile, WhatCannotBeUsedIsRefusedWithTheReason)
{
  EXPECT_EQ(complaint(duct, around_duct), "");
  expect_contains(complaint("no-such-file.msh", around_duct), "cannot be read");
  expect_contains(complaint(duct, {0.022628, 0.07}), "Geometry/height = 0.07");
  expect_contains(complaint(duct, {0.02, 0.06}), "Geometry/diameter");
  expect_contains(
    complaint(GRAUPEL_SOURCE_DIR "/prm/vessels/side-inlet.geo", around_duct),
    "not a whole mesh");

  dealii::Triangulation<3> box;
  dealii::GridGenerator::subdivided_hyper_rectangle(box,
                                                    {2, 2, 4},
                                                    dealii::Point<3>(-0.008, -0.008, 0.),
                                                    dealii::Point<3>(0.008, 0.008, 0.06));
  const std::string file = temporary("-box.msh");
  write(file, box, [](const dealii::Point<3> &) -> std::string { return "wall"; });
  EXPECT_EQ(complaint(file, around_duct), "");
  // Without the list of names.
  std::ifstream     stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  std::string unnamed = text.str();
  const auto  begin = unnamed.find("$PhysicalNames"), end = unnamed.find("$Nodes");
  std::ofstream(file) << unnamed.erase(begin, end - begin);
  expect_contains(complaint(file, around_duct), "has no name");
  std::filesystem::remove(file);
}
