// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/vessel/mesh_planes.h>
#include <graupel/simulation/files/checkpoint.h>
#include <graupel/simulation/files/input_files.h>
#include <graupel/simulation/parameters/run_size.h>

namespace graupel
{
  void
  check_input_files(const RunParameters &parameters)
  {
    check_size(parameters, MPI_COMM_WORLD);
    // The coarsest mesh there is: what is in the file, unrefined.
    MeshParameters coarse = parameters.mesh;
    coarse.cell_size      = parameters.cylinder.diameter;
    coarse.cell_height    = 0.;
    const VesselMesh mesh(parameters.cylinder, coarse, MPI_COMM_SELF);
    all_walls(parameters.dem.walls, mesh); // reads the surfaces
    if (parameters.sweep.has_fluid())
      parameters.flow.boundaries.by_id(mesh.boundaries());
    if (!parameters.filling.start_from.empty())
      read_bed(parameters.filling.start_from + "/bed.bin", parameters, MPI_COMM_WORLD);
  }
} // namespace graupel
