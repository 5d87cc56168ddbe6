// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_vessel_mesh_planes_h
#define graupel_dem_vessel_mesh_planes_h

#include <graupel/dem/walls/walls.h>
#include <graupel/mesh/vessel_mesh.h>

namespace graupel
{
  /**
   * The planes in which the boundary of a mesh from a file lies, as walls for particles
   * beside the cylinder and its ends. Each has the name of the boundary, with a number
   * behind it if one name has several planes, or if it is that of a wall of the cylinder;
   * where several boundaries share a plane it has the name of the largest.
   *
   * Throws InputError("Walls/from mesh", ...) without such a file, and for a boundary of
   * which planes are no wall: one that is curved, but not on the cylinder, and a vessel
   * that is not convex.
   */
  std::vector<Wall> planes_from_mesh(const VesselMesh &mesh);

  /** All walls of @p parameters, and those from the mesh if wanted. */
  std::vector<Wall> all_walls(const WallParameters &parameters, const VesselMesh &mesh);
} // namespace graupel

#endif
