// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

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

    find_hanging_nodes();

    coupling_pattern.reinit(owned, owned, relevant, mesh.communicator());
    dealii::DoFTools::make_sparsity_pattern(
      dof_handler, coupling_pattern, hanging_nodes, false);
    coupling_pattern.compress();

    initialize(volumes);
    dealii::FEValues<3> values(
      mesh.mapping(), fe, quadrature, dealii::update_values | dealii::update_JxW_values);
    dealii::Vector<double>                       cell_volumes(fe.n_dofs_per_cell());
    std::vector<dealii::types::global_dof_index> nodes(fe.n_dofs_per_cell());
    for (const auto &cell : owned_cells())
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

  std::vector<dealii::DoFHandler<3>::active_cell_iterator>
  NodalSpace::owned_cells() const
  {
    std::vector<dealii::DoFHandler<3>::active_cell_iterator> result;
    for (const auto &cell : mesh.owned_cells())
      result.emplace_back(
        &dof_handler.get_triangulation(), cell->level(), cell->index(), &dof_handler);
    return result;
  }

  void
  NodalSpace::append(VesselMesh::CellBytes                  &bytes,
                     const std::vector<const NodalVector *> &fields) const
  {
    const auto cells = owned_cells();
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
    const auto cells = owned_cells();
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
  NodalSpace::find_hanging_nodes()
  {
    bool is_distant = false;
    for (const auto &line : hanging_nodes.get_lines())
      {
        if (!owned.is_element(line.index))
          continue;
        own_hanging_nodes.push_back({partitioner->global_to_local(line.index), {}});
        for (const auto &[node, weight] : line.entries)
          if (owned.is_element(node) || partitioner->ghost_indices().is_element(node))
            own_hanging_nodes.back().ends.emplace_back(partitioner->global_to_local(node),
                                                       weight);
          else
            is_distant = true;
      }
    const auto any = [&](const bool here) {
      return dealii::Utilities::MPI::max(here ? 1 : 0, mesh.communicator()) == 1;
    };
    has_hanging_nodes = any(!own_hanging_nodes.empty());
    has_distant_ends  = any(is_distant);
  }

  void
  NodalSpace::distribute(NodalVector &vector) const
  {
    if (has_distant_ends)
      hanging_nodes.distribute(vector); // finds who has them, each time anew
    else if (has_hanging_nodes)
      {
        vector.update_ghost_values();
        for (const HangingNode &hanging : own_hanging_nodes)
          {
            double value = 0.;
            for (const auto &[node, weight] : hanging.ends)
              value += weight * vector.local_element(node);
            vector.local_element(hanging.node) = value;
          }
      }
    vector.update_ghost_values();
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
