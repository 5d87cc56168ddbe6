// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/gmsh_file.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <fstream>
#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    [[noreturn]] void
    refuse(const std::string &reason)
    {
      throw InputError("Mesh/file", reason);
    }

    // Names of the physical surfaces by their numbers; deal.II keeps the numbers only.
    std::map<dealii::types::boundary_id, std::string>
    physical_surfaces(std::istream &stream)
    {
      std::map<dealii::types::boundary_id, std::string> names;
      std::string                                       line;
      while (std::getline(stream, line))
        if (line.rfind("$PhysicalNames", 0) == 0)
          break;
      unsigned int n = 0;
      stream >> n;
      for (unsigned int i = 0; i < n; ++i)
        {
          unsigned int dimension, number;
          std::string  name;
          if (!(stream >> dimension >> number >> std::quoted(name)))
            refuse("its list of physical names is cut off");
          if (dimension == 2)
            names[number] = name;
        }
      return names;
    }

    VesselMesh::BoundaryIds
    number(const std::map<dealii::types::boundary_id, std::string> &names)
    {
      VesselMesh::BoundaryIds ids{{"wall", VesselMesh::wall},
                                  {"bottom", VesselMesh::bottom},
                                  {"top", VesselMesh::top}};
      VesselMesh::BoundaryIds result;
      for (const auto &entry : names)
        result[entry.second] = 0;
      dealii::types::boundary_id next = VesselMesh::top + 1;
      for (auto &[name, id] : result)
        id = ids.count(name) > 0 ? ids.at(name) : next++;
      return result;
    }
  } // namespace

  VesselMesh::BoundaryIds
  read_gmsh(const std::string &file, dealii::Triangulation<3> &mesh)
  {
    std::ifstream text(file);
    if (!text)
      refuse("the file cannot be read; is the path right?");
    const auto names = physical_surfaces(text);
    const auto ids   = number(names);

    std::ifstream     stream(file);
    dealii::GridIn<3> reader(mesh);
    try
      {
        reader.read_msh(stream);
      }
    catch (const std::exception &)
      {
        refuse("it is not a whole mesh as Gmsh writes it as text in format 2 or 4.1. "
               "Save it with \"Mesh.MshFileVersion = 2.2\"; all its volumes and "
               "surfaces must be physical ones, and no surface may lie inside");
      }
    if (mesh.n_active_cells() == 0 || !mesh.all_reference_cells_are_hyper_cube())
      refuse("it has cells other than hexahedra; in Gmsh use transfinite volumes or "
             "extrude with \"Recombine\"");

    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            const auto name = names.find(face->boundary_id());
            if (name == names.end())
              {
                std::ostringstream where;
                where << "the boundary around (" << face->center()
                      << ") m has no name; make every surface a physical one with a "
                         "name, such as bottom, top and wall";
                refuse(where.str());
              }
            face->set_boundary_id(ids.at(name->second));
          }
    return ids;
  }
} // namespace graupel
