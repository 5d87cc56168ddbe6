// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_vessel_mesh_h
#define graupel_mesh_vessel_mesh_h

#include <graupel/mesh/cylinder.h>
#include <graupel/mesh/mesh_outline.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace graupel
{
  /** How the vessel is cut into hexahedra. */
  struct MeshParameters
  {
    /** Aimed-at edge length of a cell across the vessel [m]. */
    double cell_size = 3.2e-3;
    /** Aimed-at height of a cell [m]; 0: as across. */
    double cell_height = 0.;
    /** A Gmsh file; empty: the cylinder is meshed. */
    std::string file = {};

    void declare(dealii::ParameterHandler &prm);
    void check(const Cylinder &cylinder) const;
  };

  /**
   * A distributed mesh of hexahedra (a p4est forest) that fills the cylinder
   * exactly up to the order of the mapping, or a vessel inside the cylinder whose coarse
   * mesh comes from a Gmsh file (see read_gmsh()). Faces of a file that are named "wall"
   * and whose corners lie on the cylinder follow it; all others are flat.
   *
   * The mapping has degree 2: degree 1 would cut 2.5 % of the volume off at
   * the wall, and lose particles that lie there.
   */
  class VesselMesh
  {
  public:
    /** Boundary ids; further boundaries of a file have larger ones. */
    enum Boundary : dealii::types::boundary_id
    {
      wall   = 0,
      bottom = 1,
      top    = 2
    };

    /** Cells of a mesh of these parameters, without making it. Throws as the constructor.
     */
    static double n_expected_cells(const Cylinder       &cylinder,
                                   const MeshParameters &parameters);

    /** Throws InputError("Mesh/file", ...) for a file that cannot be used. */
    VesselMesh(const Cylinder       &cylinder,
               const MeshParameters &parameters,
               MPI_Comm              communicator);

    using BoundaryIds = std::map<std::string, dealii::types::boundary_id>;

    /** Boundary ids by name. */
    const BoundaryIds &
    boundaries() const
    {
      return boundary_ids;
    }

    const dealii::parallel::distributed::Triangulation<3> &
    triangulation() const
    {
      return forest;
    }

    using CellIterator = dealii::Triangulation<3>::active_cell_iterator;

    /**
     * The active cells that this rank owns, in the order of their CellIds: by coarse cell
     * and its children, however the mesh came to be what it is. The library's own order
     * is another after a mesh was read or divided anew, and with it the rounding of every
     * sum over cells. Found once for a mesh.
     */
    const std::vector<CellIterator> &owned_cells() const;

    const dealii::Mapping<3> &
    mapping() const
    {
      return quadratic;
    }

    /** The particles' vessel, around the mesh. */
    const Cylinder &
    cylinder() const
    {
      return vessel;
    }

    /** What a mesh from a file encloses; null for the cylinder itself. Of the vessel as
     * such: the same after every adaption. */
    const std::shared_ptr<const MeshOutline> &
    outline() const
    {
      return contour;
    }

    /** Whether the mesh fills the cylinder, be it from a file or not. */
    bool fills_cylinder() const;

    /** Area of the mesh's section, mean over the height [m^2]. */
    double mean_cross_section() const;

    MPI_Comm
    communicator() const
    {
      return forest.get_communicator();
    }

    /**
     * Divides the cells among the ranks anew, so that the sum of @p weight is
     * even. Everything that knows the old partition is void. Collective.
     */
    void repartition(
      const std::function<unsigned int(
        const dealii::parallel::distributed::Triangulation<3>::active_cell_iterator &)>
        &weight);

    /** Level of all cells before any adaption [-]. */
    int
    base_level() const
    {
      return initial_level;
    }

    /** Takes all marks for refinement and coarsening away. */
    void clear_marks();

    /** Marks the parts @p refine and @p coarsen of all cells with the largest and the
     * smallest @p errors. Collective. */
    void mark_by(const dealii::Vector<float> &errors,
                 const double                 refine,
                 const double                 coarsen);

    /** Makes the marks such as the mesh can follow; false if nothing will change.
     * Collective. */
    bool prepare_adaption();

    using CellStatus = dealii::Triangulation<3>::CellStatus;
    using CellWeight = std::function<unsigned int(
      const dealii::Triangulation<3>::cell_iterator &cell, const CellStatus status)>;

    /**
     * Refines and coarsens as marked and divides the cells among the ranks by
     * @p weight, which is asked of cells that stay, of cells that will be refined (for
     * each child) and of parents whose children will be joined. Everything that
     * knows the old mesh is void. Collective.
     */
    void adapt(const CellWeight &weight);

    /** Bytes of each own active cell, in the order of owned_cells(); equally many each.
     */
    using CellBytes = std::vector<std::vector<char>>;

    /** Writes the refinement and @p bytes to files whose names begin with @p file.
     * Collective. */
    void save(const std::string &file, const CellBytes &bytes) const;

    /** Cells of each rank. Collective. */
    std::vector<unsigned int> partition() const;

    /**
     * Takes the refinement over from save(), of a mesh with the same parameters, on any
     * number of ranks; on as many as @p partition has numbers, with that partition(), so
     * that sums over ranks come out the same. Everything that knows the old mesh is void.
     * Returns the bytes that were saved. Collective.
     */
    CellBytes load(const std::string &file, const std::vector<unsigned int> &partition);

    /** The smallest distance between two vertices of one cell, over all ranks [m]. Found
     * once for a mesh, collectively. */
    double smallest_edge() const;

  private:
    void         forget_cells_when_they_change();
    void         make_from_file(const std::string &file, const double cell_size);
    unsigned int attach(const CellBytes &bytes);
    CellBytes    detach(const unsigned int handle);
    CellBytes    divide_as(const std::vector<unsigned int> &partition, const CellBytes &);

    Cylinder                                        vessel;
    BoundaryIds                                     boundary_ids;
    dealii::parallel::distributed::Triangulation<3> forest;
    dealii::MappingQ<3>                             quadratic;
    int                                             initial_level = 0;
    mutable std::vector<CellIterator>               cells; // of owned_cells(), or none
    mutable std::optional<double>                   edge;  // of smallest_edge(), or none
    std::shared_ptr<const MeshOutline>              contour;
  };
} // namespace graupel

#endif
