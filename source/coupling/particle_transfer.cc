// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/particle_transfer.h>

namespace graupel
{
  namespace
  {
    // FE_Q's shape functions are the same, at many times the cost.
    using Geometry                    = dealii::GeometryInfo<3>;
    constexpr unsigned int n_vertices = Geometry::vertices_per_cell;

    // The inverse transposed Jacobian of the trilinear cell.
    template <typename Cell>
    dealii::Tensor<2, 3>
    inverse_jacobian(const Cell &cell, const dealii::Point<3> &x)
    {
      dealii::Tensor<2, 3> transposed;
      for (unsigned int a = 0; a < n_vertices; ++a)
        transposed += outer_product(Geometry::d_linear_shape_function_gradient(x, a),
                                    cell->vertex(a));
      return invert(transposed);
    }

    // Mean lengths of the four edges in each direction [m].
    template <typename Cell>
    std::array<double, 3>
    mean_edges(const Cell &cell)
    {
      std::array<double, 3> length{};
      for (unsigned int a = 0; a < n_vertices; ++a)
        for (unsigned int i = 0; i < 3; ++i)
          if (!(a & (1u << i)))
            length[i] += 0.25 * cell->vertex(a).distance(cell->vertex(a | (1u << i)));
      return length;
    }
  } // namespace

  ParticleTransfer::ParticleTransfer(const NodalSpace &nodes)
    : nodes(nodes)
  {
  }

  void
  ParticleTransfer::update(const ParticleStore &store)
  {
    cells.clear();
    edge.clear();
    weights.clear();
    place.clear();
    const auto &partitioner = *nodes.measure().get_partitioner();
    store.visit_cells([&](const auto                          &cell,
                          const unsigned int                   first_row,
                          const std::vector<dealii::Point<3>> &locations) {
      Cell entry;
      entry.first_row = first_row;
      entry.end_row   = first_row + locations.size();
      entry.nodes.resize(n_nodes);
      const typename dealii::DoFHandler<3>::active_cell_iterator dof_cell(
        &nodes.dof_handler.get_triangulation(),
        cell->level(),
        cell->index(),
        &nodes.dof_handler);
      dof_cell->get_dof_indices(entry.nodes);
      for (unsigned int a = 0; a < n_nodes; ++a)
        entry.local_nodes[a] = partitioner.global_to_local(entry.nodes[a]);
      cells.push_back(entry);
      edge.push_back(mean_edges(dof_cell));

      weights.resize(std::max<std::size_t>(weights.size(), entry.end_row));
      place.resize(weights.size());
      for (unsigned int p = 0; p < locations.size(); ++p)
        {
          for (unsigned int a = 0; a < n_nodes; ++a)
            weights[first_row + p][a] =
              Geometry::d_linear_shape_function(locations[p], a);
          place[first_row + p] = {static_cast<unsigned int>(cells.size() - 1),
                                  locations[p],
                                  inverse_jacobian(dof_cell, locations[p])};
        }
    });
  }

  void
  ParticleTransfer::deposit(NodalVector &sums, const std::vector<double> &values) const
  {
    AssertDimension(values.size(), weights.size());
    sums = 0.;
    sums.zero_out_ghost_values();
    dealii::Vector<double> local(n_nodes);
    for (const Cell &cell : cells)
      {
        local = 0.;
        for (unsigned int row = cell.first_row; row < cell.end_row; ++row)
          for (unsigned int a = 0; a < n_nodes; ++a)
            local[a] += weights[row][a] * values[row];
        nodes.hanging_nodes.distribute_local_to_global(local, cell.nodes, sums);
      }
    sums.compress(dealii::VectorOperation::add);
  }

  std::vector<double>
  ParticleTransfer::sample(const NodalVector &field) const
  {
    std::vector<double> values(weights.size(), 0.);
    for (const Cell &cell : cells)
      for (unsigned int row = cell.first_row; row < cell.end_row; ++row)
        for (unsigned int a = 0; a < n_nodes; ++a)
          values[row] += weights[row][a] * field.local_element(cell.local_nodes[a]);
    return values;
  }

  std::vector<dealii::Tensor<1, 3>>
  ParticleTransfer::sample(const NodalVectorField &field) const
  {
    std::vector<dealii::Tensor<1, 3>> values(weights.size());
    for (const Cell &cell : cells)
      for (unsigned int row = cell.first_row; row < cell.end_row; ++row)
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            values[row][i] +=
              weights[row][a] * field[i].local_element(cell.local_nodes[a]);
    return values;
  }

  std::vector<dealii::Tensor<1, 3>>
  ParticleTransfer::sample_gradient(const NodalVector &field) const
  {
    std::vector<dealii::Tensor<1, 3>> values(weights.size());
    for (const Cell &cell : cells)
      for (unsigned int row = cell.first_row; row < cell.end_row; ++row)
        {
          dealii::Tensor<1, 3> by_x;
          for (unsigned int a = 0; a < n_nodes; ++a)
            by_x += field.local_element(cell.local_nodes[a]) *
                    Geometry::d_linear_shape_function_gradient(place[row].x, a);
          values[row] = place[row].by_x * by_x;
        }
    return values;
  }

  double
  ParticleTransfer::variance(const unsigned int row) const
  {
    const Place &at  = place[row];
    double       sum = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      sum += edge[at.cell][i] * edge[at.cell][i] * at.x[i] * (1. - at.x[i]);
    return sum;
  }
} // namespace graupel
