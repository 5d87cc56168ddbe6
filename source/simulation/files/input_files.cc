#include <graupel/mesh/gmsh_file.h>
#include <graupel/simulation/files/checkpoint.h>
#include <graupel/simulation/files/input_files.h>

namespace graupel
{
  void
  check_input_files(const RunParameters &parameters)
  {
    parameters.dem.walls.walls(parameters.cylinder); // reads the surfaces
    if (!parameters.mesh.file.empty())
      {
        dealii::Triangulation<3> mesh;
        const auto               boundaries = read_gmsh(parameters.mesh.file, mesh);
        if (parameters.sweep.has_fluid())
          parameters.flow.boundaries.by_id(boundaries);
      }
    if (!parameters.filling.start_from.empty())
      read_bed(parameters.filling.start_from + "/bed.bin", parameters);
  }
} // namespace graupel
