// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/vessel_mesh.h>

#include <fstream>

namespace graupel
{
  void
  MeshParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter(
      "file",
      file,
      "A mesh of hexahedra from Gmsh (.msh, text, in metres) for a vessel inside the "
      "cylinder of section Geometry, standing on z = 0 and as high as that; empty: the "
      "cylinder itself. Its physical surfaces name the boundaries: bottom, top, wall, "
      "others. Faces named wall whose corners lie on the cylinder follow it. Particles "
      "meet the cylinder and what section Walls adds, not the mesh. Relative to the "
      "parameter file.",
      dealii::Patterns::FileName());
    prm.add_parameter(
      "cell size",
      cell_size,
      "Edge length of the cells across the vessel that is aimed at; the mesh "
      "takes the nearest size that divides the cylinder evenly, or that halving the "
      "cells "
      "of a file reaches [m].");
    prm.add_parameter(
      "cell height",
      cell_height,
      "Edge length of the cells along the axis that is aimed at, where the "
      "surface of a bed asks for more layers; 0: as across [m].");
    prm.leave_subsection();
  }

  void
  MeshParameters::check(const Cylinder &cylinder) const
  {
    require(cell_size > 0., "Mesh/cell size", "cells need a positive size, in metres");
    require(cell_size <= cylinder.diameter / 2. && cell_size <= cylinder.height / 2.,
            "Mesh/cell size",
            "cells larger than half of the cylinder cannot carry a flow; choose at most "
            "half of Geometry/diameter and Geometry/height");
    require(file.empty() || std::ifstream(file).good(),
            "Mesh/file",
            "the file cannot be read; is the path right?");
    require(cell_height >= 0. && cell_height <= cylinder.height / 2.,
            "Mesh/cell height",
            "must lie between 0 (as Mesh/cell size) and half of Geometry/height");
    require(
      cell_size >= 1e-3 * cylinder.diameter,
      "Mesh/cell size",
      "more than a thousand cells across the cylinder is beyond any machine; units are "
      "metres");
  }
} // namespace graupel
