#include <graupel/mesh/cylinder.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

namespace graupel
{
  namespace
  {
    constexpr dealii::types::manifold_id curved = 0;

    // Cells across the diameter of hyper_ball_balanced, before refinement. Its
    // twelve cells stay compact (scaled Jacobian 0.84 after extrusion), where
    // GridGenerator::cylinder has cells of aspect ratio 11.
    constexpr double coarse_cells_across = 4.;

    // The coarse cylinder: boundary ids set, curved on the lateral faces alone.
    // Manifold ids are set by hand, since set_all_manifold_ids_on_boundary would
    // take lines of the end caps along and invert cells.
    void
    make_coarse_cylinder(const Cylinder             &cylinder,
                         const unsigned int          layers,
                         dealii::Triangulation<3>   &solid)
    {
      dealii::Triangulation<2> disc;
      dealii::GridGenerator::hyper_ball_balanced(disc, dealii::Point<2>(), cylinder.diameter / 2.);
      disc.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
      dealii::GridGenerator::extrude_triangulation(disc, layers + 1, cylinder.height, solid);
      solid.set_all_manifold_ids(dealii::numbers::flat_manifold_id);

      for (const auto &cell : solid.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const double z         = face->center()[2];
              const double tolerance = 1e-6 * cylinder.height;
              if (z < tolerance)
                face->set_boundary_id(CylinderMesh::bottom);
              else if (z > cylinder.height - tolerance)
                face->set_boundary_id(CylinderMesh::top);
              else
                face->set_boundary_id(CylinderMesh::wall);
            }
      for (const auto &cell : solid.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == CylinderMesh::wall)
            face->set_all_manifold_ids(curved);
    }
  } // namespace

  CylinderMesh::CylinderMesh(const Cylinder       &cylinder,
                             const MeshParameters &parameters,
                             MPI_Comm              communicator)
    : vessel(cylinder)
    , forest(communicator,
             dealii::Triangulation<3>::limit_level_difference_at_vertices,
             dealii::parallel::distributed::Triangulation<3>::default_setting)
    , quadratic(2)
  {
    const double coarse_size = cylinder.diameter / coarse_cells_across;
    const auto   refinements = static_cast<unsigned int>(
      std::max(0l, std::lround(std::log2(coarse_size / parameters.cell_size))));
    const auto layers = static_cast<unsigned int>(
      std::max(1l, std::lround(cylinder.height / (parameters.cell_size * (1u << refinements)))));

    dealii::Triangulation<3> solid;
    make_coarse_cylinder(cylinder, layers, solid);
    forest.copy_triangulation(solid);
    forest.set_manifold(curved, dealii::CylindricalManifold<3>(2));
    forest.refine_global(refinements);
  }

  double
  CylinderMesh::smallest_edge() const
  {
    double smallest = std::numeric_limits<double>::max();
    for (const auto &cell : forest.active_cell_iterators())
      if (cell->is_locally_owned())
        smallest = std::min(smallest, cell->minimum_vertex_distance());
    return dealii::Utilities::MPI::min(smallest, communicator());
  }
} // namespace graupel
