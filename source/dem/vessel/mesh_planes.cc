// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/vessel/mesh_planes.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Of the vessel's size, by which corners may lie out of its planes.
    constexpr double convexity_tolerance = 1e-5;

    const std::string way_out =
      "; write the boundary as an STL file and name it in Walls/surfaces and "
      "Walls/containers, without from mesh";

    void
    check(const MeshOutline &outline, const Cylinder &cylinder)
    {
      const std::string name = "Walls/from mesh";
      require(outline.curved_boundary().empty(),
              name,
              "the boundary \"" + outline.curved_boundary() +
                "\" is neither flat nor part of the cylinder" + way_out);
      const double       size = std::max(cylinder.diameter, cylinder.height);
      std::ostringstream text;
      text << "the vessel is not convex: a corner of the mesh lies "
           << outline.farthest_beyond_planes()
           << " m beyond a plane of its boundary, which would cut it off" << way_out;
      require(
        outline.farthest_beyond_planes() <= convexity_tolerance * size, name, text.str());
    }
  } // namespace

  std::vector<Wall>
  planes_from_mesh(const VesselMesh &mesh)
  {
    require(mesh.outline() != nullptr,
            "Walls/from mesh",
            "there is no Mesh/file to take planes from; the walls of the cylinder are "
            "there in any case");
    check(*mesh.outline(), mesh.cylinder());
    std::map<std::string, unsigned int> n_planes, number;
    for (const FlatBoundary &plane : mesh.outline()->planes())
      ++n_planes[plane.name];
    std::vector<Wall> walls;
    for (const FlatBoundary &plane : mesh.outline()->planes())
      {
        const bool is_taken =
          plane.name == "wall" || plane.name == "bottom" || plane.name == "top";
        const std::string name =
          n_planes[plane.name] > 1 || is_taken
            ? plane.name + " " + std::to_string(++number[plane.name])
            : plane.name;
        Wall wall;
        wall.name  = name;
        wall.shape = PlaneWall{triple(plane.point), triple(plane.normal)};
        walls.push_back(wall);
      }
    return walls;
  }

  std::vector<Wall>
  all_walls(const WallParameters &parameters, const VesselMesh &mesh)
  {
    std::vector<Wall> walls = parameters.walls(mesh.cylinder());
    if (parameters.from_mesh)
      for (const Wall &wall : planes_from_mesh(mesh))
        {
          require(std::none_of(walls.begin(),
                               walls.end(),
                               [&](const Wall &w) { return w.name == wall.name; }),
                  "Walls/from mesh",
                  "a plane of the mesh and another wall are both named \"" + wall.name +
                    "\"; give the other wall another name");
          walls.push_back(wall);
        }
    return walls;
  }
} // namespace graupel
