// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_gmsh_file_h
#define graupel_mesh_gmsh_file_h

#include <graupel/mesh/vessel_mesh.h>

#include <deal.II/grid/tria.h>

namespace graupel
{
  /**
   * Reads a mesh of hexahedra in metres from a Gmsh file (text, format 2 or 4.1) into
   * @p mesh, which must be empty, and gives the boundary ids by the names of the file's
   * physical surfaces: "bottom", "top" and "wall" have the ids of VesselMesh::Boundary,
   * others the next ones in the order of their names. Throws InputError("Mesh/file",
   * ...) for a file that cannot be read, has other cells, or leaves a part of the
   * boundary without a name.
   */
  VesselMesh::BoundaryIds read_gmsh(const std::string        &file,
                                    dealii::Triangulation<3> &mesh);
} // namespace graupel

#endif
