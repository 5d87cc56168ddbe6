// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_space.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

namespace graupel
{
  FlowSpace::FlowSpace(const NodalSpace                              &nodes,
                       const std::vector<dealii::types::boundary_id> &outlets)
    : nodes(nodes)
    , fe(nodes.fe, unknowns_per_node)
    , dof_handler(nodes.dof_handler.get_triangulation())
  {
    AssertDimension(nodes.quadrature.size(), points_per_cell);
    number_unknowns();
    store_cells();
    store_faces();
    measure_hanging();
    assemble_gradient(outlets);
  }

  void
  FlowSpace::number_unknowns()
  {
    dof_handler.distribute_dofs(fe);
    const std::vector<unsigned int> blocks{0, 0, 0, 1};
    dealii::DoFRenumbering::hierarchical(dof_handler);
    dealii::DoFRenumbering::component_wise(dof_handler, blocks);
    const auto sizes = dealii::DoFTools::count_dofs_per_fe_block(dof_handler, blocks);
    dealii::IndexSet all;
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, all);
    const auto end = sizes[0] + sizes[1];
    owned          = {dof_handler.locally_owned_dofs().get_view(0, sizes[0]),
                      dof_handler.locally_owned_dofs().get_view(sizes[0], end)};
    relevant       = {all.get_view(0, sizes[0]), all.get_view(sizes[0], end)};
    AssertThrow(
      owned[1] == nodes.owned && owned[0].n_elements() == 3 * owned[1].n_elements(),
      dealii::ExcMessage("The flow's nodes are not numbered as the scalar nodes are."));
  }

  void
  FlowSpace::store_cells()
  {
    dealii::FEValues<3> values(nodes.mesh.mapping(),
                               nodes.fe,
                               nodes.quadrature,
                               dealii::update_values | dealii::update_gradients |
                                 dealii::update_JxW_values);
    const auto         &partitioner = *nodes.measure().get_partitioner();
    std::vector<dealii::types::global_dof_index> scalar(nodes_per_cell);
    std::vector<dealii::types::global_dof_index> unknowns(fe.n_dofs_per_cell());
    for (const auto &cell : nodes.owned_cells())
      {
        values.reinit(cell);
        cell->get_dof_indices(scalar);
        const typename dealii::DoFHandler<3>::active_cell_iterator flow_cell(
          &dof_handler.get_triangulation(), cell->level(), cell->index(), &dof_handler);
        flow_cell->get_dof_indices(unknowns);
        LocalNodes local;
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          {
            local[a] = partitioner.global_to_local(scalar[a]);
            for (unsigned int c = 0; c < 3; ++c)
              AssertThrow(unknowns[unknowns_per_node * a + c] == 3 * scalar[a] + c,
                          dealii::ExcMessage("Unexpected numbering of the flux."));
          }
        cell_nodes.push_back(local);
        cell_unknowns.push_back(unknowns);

        double      volume = 0.;
        ShapePoints points;
        for (const unsigned int q : values.quadrature_point_indices())
          {
            ShapePoint &point = points[q];
            point.weight      = values.JxW(q);
            volume += point.weight;
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              {
                point.value[a] = values.shape_value(a, q);
                for (unsigned int i = 0; i < 3; ++i)
                  point.gradient[i][a] = values.shape_grad(a, q)[i];
              }
          }
        shapes.push_back(points);
        cell_sizes.push_back(std::cbrt(volume));
        cell_centers.push_back(cell->center());
      }
  }

  void
  FlowSpace::store_faces()
  {
    dealii::FEFaceValues<3> values(
      nodes.mesh.mapping(),
      nodes.fe,
      dealii::QGauss<2>(2),
      dealii::update_values | dealii::update_gradients | dealii::update_JxW_values |
        dealii::update_normal_vectors | dealii::update_quadrature_points);
    unsigned int number = 0;
    for (const auto &cell : nodes.owned_cells())
      {
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              values.reinit(cell, f);
              for (const unsigned int q : values.quadrature_point_indices())
                {
                  FacePoint point;
                  point.position = values.quadrature_point(q);
                  point.normal   = values.normal_vector(q);
                  point.cell     = number;
                  point.weight   = values.JxW(q);
                  for (unsigned int a = 0; a < nodes_per_cell; ++a)
                    {
                      point.value[a]    = values.shape_value(a, q);
                      point.gradient[a] = values.shape_grad(a, q);
                    }
                  faces[cell->face(f)->boundary_id()].push_back(point);
                }
            }
        ++number;
      }
  }

  const std::vector<FlowSpace::FacePoint> &
  FlowSpace::boundary(const dealii::types::boundary_id id) const
  {
    static const std::vector<FacePoint> none;
    const auto                          found = faces.find(id);
    return found == faces.end() ? none : found->second;
  }

  double
  FlowSpace::value(const FacePoint &point, const NodalVector &field) const
  {
    double result = 0.;
    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      result += point.value[a] * field.local_element(cell_nodes[point.cell][a]);
    return result;
  }

  double
  FlowSpace::normal_component(const FacePoint &point, const NodalVectorField &field) const
  {
    double result = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      result += point.normal[i] * value(point, field[i]);
    return result;
  }

  void
  FlowSpace::measure_hanging()
  {
    const auto &partitioner = *nodes.measure().get_partitioner();
    nodes.initialize(hanging_measure);
    dealii::Vector<double>                       volumes(nodes_per_cell);
    std::vector<dealii::types::global_dof_index> indices(nodes_per_cell);
    for (unsigned int cell = 0; cell < n_cells(); ++cell)
      {
        bool hanging = false;
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          {
            indices[a] = partitioner.local_to_global(cell_nodes[cell][a]);
            hanging    = hanging || nodes.hanging_nodes.is_constrained(indices[a]);
          }
        has_hanging_node.push_back(hanging);
        if (!hanging)
          continue;
        volumes = 0.;
        for (const ShapePoint &point : shapes[cell])
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            volumes[a] += point.weight * point.value[a];
        nodes.hanging_nodes.distribute_local_to_global(volumes, indices, hanging_measure);
      }
    hanging_measure.compress(dealii::VectorOperation::add);
    hanging_measure.update_ghost_values();
  }

  void
  FlowSpace::assemble_gradient(const std::vector<dealii::types::boundary_id> &outlets)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        gradient[i].reinit(nodes.coupling_pattern);
        std::vector<dealii::FullMatrix<double>> local(
          n_cells(), dealii::FullMatrix<double>(nodes_per_cell, nodes_per_cell));
        for (unsigned int cell = 0; cell < n_cells(); ++cell)
          for (const ShapePoint &point : shapes[cell])
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              for (unsigned int b = 0; b < nodes_per_cell; ++b)
                local[cell](a, b) += point.weight * point.value[a] * point.gradient[i][b];
        for (const auto id : outlets)
          for (const FacePoint &point : boundary(id))
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              for (unsigned int b = 0; b < nodes_per_cell; ++b)
                local[point.cell](a, b) -=
                  point.weight * point.normal[i] * point.value[a] * point.value[b];

        const auto &partitioner = *nodes.measure().get_partitioner();
        std::vector<dealii::types::global_dof_index> indices(nodes_per_cell);
        for (unsigned int cell = 0; cell < n_cells(); ++cell)
          {
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              indices[a] = partitioner.local_to_global(cell_nodes[cell][a]);
            nodes.hanging_nodes.distribute_local_to_global(
              local[cell], indices, gradient[i]);
          }
        gradient[i].compress(dealii::VectorOperation::add);
      }
  }
} // namespace graupel
