#include <graupel/mesh/cell_order.h>
#include <graupel/mesh/nodal_space.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

#include <cstring>

namespace graupel
{
  NodalSpace::NodalSpace(const VesselMesh &mesh)
    : mesh(mesh)
    , fe(1)
    , quadrature(dealii::QGauss<3>(2))
    , dof_handler(mesh.triangulation())
  {
    number_nodes();
    owned = dof_handler.locally_owned_dofs();
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    hanging_nodes.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dof_handler, hanging_nodes);
    hanging_nodes.close();
    partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      owned, relevant, mesh.communicator());

    coupling_pattern.reinit(owned, owned, relevant, mesh.communicator());
    dealii::DoFTools::make_sparsity_pattern(
      dof_handler, coupling_pattern, hanging_nodes, false);
    coupling_pattern.compress();

    initialize(volumes);
    dealii::FEValues<3> values(
      mesh.mapping(), fe, quadrature, dealii::update_values | dealii::update_JxW_values);
    dealii::Vector<double>                       cell_volumes(fe.n_dofs_per_cell());
    std::vector<dealii::types::global_dof_index> nodes(fe.n_dofs_per_cell());
    for (const auto &cell : owned_cells(dof_handler))
      {
        values.reinit(cell);
        cell_volumes = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (const unsigned int a : values.dof_indices())
            cell_volumes[a] += values.shape_value(a, q) * values.JxW(q);
        cell->get_dof_indices(nodes);
        hanging_nodes.distribute_local_to_global(cell_volumes, nodes, volumes);
      }
    volumes.compress(dealii::VectorOperation::add);
    volumes.update_ghost_values();
  }

  void
  NodalSpace::append(VesselMesh::CellBytes                  &bytes,
                     const std::vector<const NodalVector *> &fields) const
  {
    const auto cells = owned_cells(dof_handler);
    bytes.resize(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (const auto *field : fields)
        for (const unsigned int v : cells[c]->vertex_indices())
          {
            const double value = (*field)(cells[c]->vertex_dof_index(v, 0));
            const auto  *begin = reinterpret_cast<const char *>(&value);
            bytes[c].insert(bytes[c].end(), begin, begin + sizeof(double));
          }
  }

  void
  NodalSpace::take(VesselMesh::CellBytes            &bytes,
                   const std::vector<NodalVector *> &fields) const
  {
    for (NodalVector *field : fields)
      initialize(*field);
    const auto cells = owned_cells(dof_handler);
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const std::size_t of_cell = fields.size() * fe.n_dofs_per_cell() * sizeof(double);
        AssertThrow(bytes[c].size() >= of_cell, dealii::ExcInternalError());
        const char *place = bytes[c].data() + bytes[c].size() - of_cell;
        for (NodalVector *field : fields)
          for (const unsigned int v : cells[c]->vertex_indices())
            {
              const auto dof = cells[c]->vertex_dof_index(v, 0);
              if (owned.is_element(dof))
                std::memcpy(&(*field)(dof), place, sizeof(double));
              place += sizeof(double);
            }
        bytes[c].resize(bytes[c].size() - of_cell);
      }
    for (NodalVector *field : fields)
      field->update_ghost_values();
  }

  void
  NodalSpace::number_nodes()
  {
    dof_handler.distribute_dofs(fe);
    dealii::DoFRenumbering::hierarchical(dof_handler);
  }

  void
  NodalSpace::initialize(NodalVector &vector) const
  {
    vector.reinit(partitioner);
  }
} // namespace graupel
