// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/gmsh_file.h>
#include <graupel/mesh/vessel_mesh.h>

#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <numeric>
#include <sstream>

namespace graupel
{
  using Forest = dealii::parallel::distributed::Triangulation<3>;

  namespace
  {
    constexpr dealii::types::manifold_id curved = 0;

    // Of the vessel's sizes, within which a vertex lies where it is meant to.
    constexpr double vertex_tolerance = 1e-4;
    // Of the cylinder's volume, which a mesh of it may lack.
    constexpr double section_tolerance = 1e-3;

    // A disc of a few cells, and how many of them lie across its diameter; after
    // extrusion their cells stay compact, where GridGenerator::cylinder has
    // cells of aspect ratio 11. Two kinds, so that the sizes that refinement can
    // reach lie closer together than a factor of two.
    struct CoarseDisc
    {
      double       cells_across;
      unsigned int refinements;

      void
      make(dealii::Triangulation<2> &disc, const double radius) const
      {
        if (cells_across == 4.)
          dealii::GridGenerator::hyper_ball_balanced(disc, dealii::Point<2>(), radius);
        else
          dealii::GridGenerator::hyper_ball(disc, dealii::Point<2>(), radius);
      }

      double
      cell_size(const double diameter) const
      {
        return diameter / (cells_across * (1u << refinements));
      }
    };

    CoarseDisc
    disc_for(const double diameter, const double wanted_size)
    {
      CoarseDisc best{4., 0};
      const auto misfit = [&](const CoarseDisc &disc) {
        return std::abs(std::log(disc.cell_size(diameter) / wanted_size));
      };
      for (const double cells_across : {4., 3.})
        for (unsigned int refinements = 0; refinements <= 9; ++refinements)
          if (const CoarseDisc disc{cells_across, refinements};
              misfit(disc) < misfit(best))
            best = disc;
      return best;
    }

    // Of coarse cells along the axis.
    unsigned int
    layers_of(const CoarseDisc     &disc,
              const Cylinder       &cylinder,
              const MeshParameters &parameters)
    {
      const double height =
        parameters.cell_height > 0. ? parameters.cell_height : parameters.cell_size;
      return std::max(1l,
                      std::lround(cylinder.height / (height * (1u << disc.refinements))));
    }

    // To the nearest size that halving cells reaches.
    unsigned int
    halvings(const double volume, const double n_cells, const double cell_size)
    {
      return std::max(
        0., std::ceil(std::log2(std::cbrt(volume / n_cells) / cell_size) - 0.5));
    }

    // The coarse cylinder: boundary ids set, curved on the lateral faces alone.
    // Manifold ids are set by hand, since set_all_manifold_ids_on_boundary would
    // take lines of the end caps along and invert cells.
    void
    make_coarse_cylinder(const Cylinder           &cylinder,
                         const CoarseDisc         &coarse,
                         const unsigned int        layers,
                         dealii::Triangulation<3> &solid)
    {
      dealii::Triangulation<2> disc;
      coarse.make(disc, cylinder.diameter / 2.);
      disc.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
      dealii::GridGenerator::extrude_triangulation(
        disc, layers + 1, cylinder.height, solid);
      solid.set_all_manifold_ids(dealii::numbers::flat_manifold_id);

      for (const auto &cell : solid.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const double z         = face->center()[2];
              const double tolerance = 1e-6 * cylinder.height;
              if (z < tolerance)
                face->set_boundary_id(VesselMesh::bottom);
              else if (z > cylinder.height - tolerance)
                face->set_boundary_id(VesselMesh::top);
              else
                face->set_boundary_id(VesselMesh::wall);
            }
      for (const auto &cell : solid.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == VesselMesh::wall)
            face->set_all_manifold_ids(curved);
    }

    void
    check_vessel(const Cylinder &cylinder, const dealii::Triangulation<3> &solid)
    {
      double lowest = std::numeric_limits<double>::max(), highest = -lowest, widest = 0.;
      for (const auto &vertex : solid.get_vertices())
        {
          lowest  = std::min(lowest, vertex[2]);
          highest = std::max(highest, vertex[2]);
          widest  = std::max(widest, std::hypot(vertex[0], vertex[1]));
        }
      std::ostringstream text;
      text << "the mesh reaches from z = " << lowest << " to " << highest << " m and "
           << widest << " m away from the axis, but ";
      const double tolerance = vertex_tolerance * cylinder.height;
      if (std::abs(lowest) > tolerance || std::abs(highest - cylinder.height) > tolerance)
        {
          text << "the vessel reaches from 0 to Geometry/height = " << cylinder.height
               << " m; are both in metres?";
          throw InputError("Mesh/file", text.str());
        }
      if (widest > cylinder.diameter / 2. * (1. + vertex_tolerance))
        {
          text << "the cylinder around the particles has a radius of "
               << cylinder.diameter / 2.
               << " m; choose a Geometry/diameter that holds the mesh";
          throw InputError("Mesh/file", text.str());
        }
    }

    // Parts of the cylinder, among the faces named "wall".
    void
    curve_wall(const Cylinder &cylinder, dealii::Triangulation<3> &solid)
    {
      const double radius = cylinder.diameter / 2.;
      solid.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
      for (const auto &cell : solid.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          {
            if (!face->at_boundary() || face->boundary_id() != VesselMesh::wall)
              continue;
            bool on_cylinder = true;
            for (const unsigned int v : face->vertex_indices())
              on_cylinder = on_cylinder &&
                            std::abs(std::hypot(face->vertex(v)[0], face->vertex(v)[1]) -
                                     radius) < vertex_tolerance * radius;
            if (on_cylinder)
              face->set_all_manifold_ids(curved);
          }
    }
  } // namespace

  double
  VesselMesh::n_expected_cells(const Cylinder &cylinder, const MeshParameters &parameters)
  {
    if (!parameters.file.empty())
      {
        MeshParameters coarse = parameters;
        coarse.cell_size      = cylinder.diameter + cylinder.height;
        const VesselMesh mesh(cylinder, coarse, MPI_COMM_SELF);
        const double     n      = mesh.forest.n_global_active_cells();
        const double     volume = dealii::GridTools::volume(mesh.forest, mesh.quadratic);
        return n * std::pow(8., halvings(volume, n, parameters.cell_size));
      }
    const CoarseDisc         disc = disc_for(cylinder.diameter, parameters.cell_size);
    dealii::Triangulation<2> coarse;
    disc.make(coarse, cylinder.diameter / 2.);
    return std::pow(8., disc.refinements) * coarse.n_active_cells() *
           layers_of(disc, cylinder, parameters);
  }

  VesselMesh::VesselMesh(const Cylinder       &cylinder,
                         const MeshParameters &parameters,
                         MPI_Comm              communicator)
    : vessel(cylinder)
    , forest(communicator,
             dealii::Triangulation<3>::limit_level_difference_at_vertices,
             dealii::parallel::distributed::Triangulation<3>::default_setting)
    , quadratic(2)
  {
    forget_cells_when_they_change();
    if (!parameters.file.empty())
      {
        make_from_file(parameters.file, parameters.cell_size);
        return;
      }
    boundary_ids              = {{"wall", wall}, {"bottom", bottom}, {"top", top}};
    const CoarseDisc   disc   = disc_for(cylinder.diameter, parameters.cell_size);
    const unsigned int layers = layers_of(disc, cylinder, parameters);

    dealii::Triangulation<3> solid;
    make_coarse_cylinder(cylinder, disc, layers, solid);
    forest.copy_triangulation(solid); // takes the manifolds of solid, which has none
    forest.set_manifold(curved, dealii::CylindricalManifold<3>(2));
    forest.refine_global(disc.refinements);
    initial_level = disc.refinements;
  }

  void
  VesselMesh::forget_cells_when_they_change()
  {
    auto &signals = forest.signals;
    for (auto *signal : {&signals.any_change,
                         &signals.post_distributed_refinement,
                         &signals.post_distributed_repartition,
                         &signals.post_distributed_load})
      signal->connect([this]() {
        cells.clear();
        edge.reset();
      });
  }

  const std::vector<VesselMesh::CellIterator> &
  VesselMesh::owned_cells() const
  {
    if (!cells.empty())
      return cells;
    std::vector<std::pair<dealii::CellId, CellIterator>> by_id;
    for (const auto &cell : forest.active_cell_iterators())
      if (cell->is_locally_owned())
        by_id.emplace_back(cell->id(), cell);
    std::sort(by_id.begin(), by_id.end(), [](const auto &a, const auto &b) {
      return a.first < b.first;
    });
    for (const auto &[id, cell] : by_id)
      cells.push_back(cell);
    return cells;
  }

  void
  VesselMesh::make_from_file(const std::string &file, const double cell_size)
  {
    dealii::Triangulation<3> solid;
    boundary_ids = read_gmsh(file, solid);
    check_vessel(vessel, solid);
    curve_wall(vessel, solid);
    forest.copy_triangulation(solid); // takes the manifolds of solid, which has none
    forest.set_manifold(curved, dealii::CylindricalManifold<3>(2));
    const double volume = dealii::GridTools::volume(forest, quadratic);
    initial_level       = halvings(volume, forest.n_global_active_cells(), cell_size);
    forest.refine_global(initial_level);
    contour = std::make_shared<const MeshOutline>(vessel, forest, curved, boundary_ids);
  }

  bool
  VesselMesh::fills_cylinder() const
  {
    const double full = vessel.cross_section() * vessel.height;
    return !contour ||
           contour->volume(0., vessel.height) > (1. - section_tolerance) * full;
  }

  double
  VesselMesh::mean_cross_section() const
  {
    return contour ? contour->volume(0., vessel.height) / vessel.height
                   : vessel.cross_section();
  }

  void
  VesselMesh::repartition(
    const std::function<unsigned int(
      const dealii::parallel::distributed::Triangulation<3>::active_cell_iterator &)>
      &weight)
  {
    const auto connection = forest.signals.weight.connect(
      [&](const dealii::Triangulation<3>::cell_iterator &cell,
          const dealii::Triangulation<3>::CellStatus) {
        return weight(dealii::Triangulation<3>::active_cell_iterator(cell));
      });
    forest.repartition();
    connection.disconnect();
  }

  void
  VesselMesh::clear_marks()
  {
    for (const auto &cell : forest.active_cell_iterators())
      {
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
      }
  }

  void
  VesselMesh::mark_by(const dealii::Vector<float> &errors,
                      const double                 refine,
                      const double                 coarsen)
  {
    dealii::parallel::distributed::GridRefinement::refine_and_coarsen_fixed_number(
      forest, errors, refine, coarsen);
  }

  bool
  VesselMesh::prepare_adaption()
  {
    forest.prepare_coarsening_and_refinement();
    unsigned int marks = 0;
    for (const auto &cell : forest.active_cell_iterators())
      if (cell->is_locally_owned() &&
          (cell->refine_flag_set() || cell->coarsen_flag_set()))
        ++marks;
    return dealii::Utilities::MPI::sum(marks, communicator()) > 0;
  }

  void
  VesselMesh::adapt(const CellWeight &weight)
  {
    const auto connection = forest.signals.weight.connect(weight);
    forest.execute_coarsening_and_refinement();
    connection.disconnect();
  }

  unsigned int
  VesselMesh::attach(const CellBytes &bytes)
  {
    std::map<dealii::CellId, unsigned int> number;
    for (const auto &cell : owned_cells())
      number.emplace(cell->id(), number.size());
    return forest.register_data_attach(
      [&bytes, number](const Forest::cell_iterator &cell, const CellStatus) {
        return bytes[number.at(cell->id())];
      },
      false);
  }

  VesselMesh::CellBytes
  VesselMesh::detach(const unsigned int handle)
  {
    std::map<dealii::CellId, std::vector<char>> bytes;
    forest.notify_ready_to_unpack(
      handle,
      [&](const Forest::cell_iterator &cell,
          const CellStatus,
          const boost::iterator_range<std::vector<char>::const_iterator> &data) {
        bytes[cell->id()].assign(data.begin(), data.end());
      });
    CellBytes result;
    for (auto &[id, of_cell] : bytes)
      result.push_back(std::move(of_cell));
    return result;
  }

  void
  VesselMesh::save(const std::string &file, const CellBytes &bytes) const
  {
    // The mesh does not change by what is attached to it for the time of the call.
    const_cast<VesselMesh *>(this)->attach(bytes);
    forest.save(file);
  }

  std::vector<unsigned int>
  VesselMesh::partition() const
  {
    return dealii::Utilities::MPI::all_gather(communicator(),
                                              forest.n_locally_owned_active_cells());
  }

  VesselMesh::CellBytes
  VesselMesh::divide_as(const std::vector<unsigned int> &partition,
                        const CellBytes                 &bytes)
  {
    // p4est cuts where the sum of all weights so far reaches the next whole number: at
    // the last cell of each rank. It asks for them in its own order of the cells.
    std::map<unsigned int, unsigned int> ranks_ending_at;
    unsigned int                         end = 0;
    for (const unsigned int n : partition)
      ++ranks_ending_at[end += n];
    const auto   now  = this->partition();
    const auto   mine = dealii::Utilities::MPI::this_mpi_process(communicator());
    unsigned int past = std::accumulate(now.begin(), now.begin() + mine, 0u);
    const auto   connection =
      forest.signals.weight.connect([&](const auto &, const auto) -> unsigned int {
        const auto found = ranks_ending_at.find(++past);
        return found == ranks_ending_at.end() ? 0 : found->second;
      });
    const unsigned int handle = attach(bytes);
    forest.repartition();
    connection.disconnect();
    return detach(handle);
  }

  VesselMesh::CellBytes
  VesselMesh::load(const std::string &file, const std::vector<unsigned int> &partition)
  {
    // p4est reads onto the coarse cells only.
    while (forest.n_global_levels() > 1)
      {
        for (const auto &cell : forest.active_cell_iterators())
          if (cell->is_locally_owned() && cell->level() > 0)
            cell->set_coarsen_flag();
        forest.execute_coarsening_and_refinement();
      }
    forest.load(file);
    CellBytes  bytes = detach(attach({}));
    const auto now   = this->partition();
    if (partition.size() == now.size() && partition != now)
      return divide_as(partition, bytes);
    return bytes;
  }

  double
  VesselMesh::smallest_edge() const
  {
    if (!edge)
      {
        double smallest = std::numeric_limits<double>::max();
        for (const auto &cell : owned_cells())
          smallest = std::min(smallest, cell->minimum_vertex_distance());
        edge = dealii::Utilities::MPI::min(smallest, communicator());
      }
    return *edge;
  }
} // namespace graupel
