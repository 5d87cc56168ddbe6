// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/cell_scatter.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    constexpr unsigned int unconstrained = dealii::numbers::invalid_unsigned_int;

    // The linear system of any number of nodes, numbered as a cell's.
    class NodesSystem
    {
    public:
      explicit NodesSystem(const unsigned int n_nodes)
        : matrix(unknowns_per_node * n_nodes, unknowns_per_node * n_nodes)
        , rhs(unknowns_per_node * n_nodes)
      {
      }

      double &
      operator()(const unsigned int row, const unsigned int column)
      {
        return matrix(row, column);
      }

      double &
      right(const unsigned int row)
      {
        return rhs[row];
      }

    private:
      dealii::FullMatrix<double> matrix;
      dealii::Vector<double>     rhs;
    };
    // Adds the blocks of the node a's row to what block(a, b) points to.
    template <typename Block>
    void
    add_row(NodesSystem       &system,
            const unsigned int a,
            const unsigned int n_nodes,
            const Block       &block)
    {
      for (unsigned int b = 0; b < n_nodes; ++b)
        for (unsigned int j = 0; j < unknowns_per_node; ++j)
          for (unsigned int i = 0; i < unknowns_per_node; ++i)
            block(a, b)[unknowns_per_node * j + i] +=
              system(unknowns_per_node * a + i, unknowns_per_node * b + j);
    }

    // The same, four columns at a time: they are transposed in registers.
    template <typename Block>
    void
    add_row(const CellSystem  &system,
            const unsigned int a,
            const unsigned int /*n_nodes*/,
            const Block &block)
    {
      using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
      for (unsigned int b = 0; b < nodes_per_cell; b += 4)
        for (unsigned int j = 0; j < unknowns_per_node; ++j)
          {
            Four row[4];
            for (unsigned int i = 0; i < 4; ++i)
              row[i] = *reinterpret_cast<const Four *>(&system.matrix[a][i][j][b]);
            const Four low[2]{__builtin_shufflevector(row[0], row[1], 0, 4, 2, 6),
                              __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6)},
              high[2]{__builtin_shufflevector(row[0], row[1], 1, 5, 3, 7),
                      __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7)};
            const Four column[4]{__builtin_shufflevector(low[0], low[1], 0, 1, 4, 5),
                                 __builtin_shufflevector(high[0], high[1], 0, 1, 4, 5),
                                 __builtin_shufflevector(low[0], low[1], 2, 3, 6, 7),
                                 __builtin_shufflevector(high[0], high[1], 2, 3, 6, 7)};
            for (unsigned int i = 0; i < 4; ++i)
              *reinterpret_cast<Four *>(block(a, b + i) + 4 * j) += column[i];
          }
    }
  } // namespace

  CellScatter::CellScatter(const FlowSpace                         &space,
                           const dealii::AffineConstraints<double> &constraints,
                           FlowMatrix                              &matrix)
    : space(space)
    , constraints(constraints)
    , matrix(matrix)
    , places(space.n_cells())
    , number(space.n_cells(), unconstrained)
  {
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        const Constrained found =
          find_constrained(space.cell_nodes[cell].data(), nodes_per_cell);
        if (found.nodes.size() == nodes_per_cell)
          std::copy(found.places.begin(), found.places.end(), places[cell].begin());
        if (!found.lines.empty())
          {
            number[cell] = constrained.size();
            constrained.push_back(found);
          }
      }
  }

  CellScatter::Constrained
  CellScatter::find_constrained(const unsigned int *const nodes,
                                const unsigned int        n_nodes) const
  {
    const auto &partitioner = *space.nodes.measure().get_partitioner();
    const auto  n_fluxes    = space.owned[0].size();
    Constrained result;
    result.nodes.assign(nodes, nodes + n_nodes);
    const auto unknown_of = [&](const dealii::types::global_dof_index global) {
      const bool         is_flux   = global < n_fluxes;
      const unsigned int node      = partitioner.global_to_local(is_flux ? global / 3
                                                                    : global - n_fluxes),
                         component = is_flux ? global % 3 : 3;
      const auto found =
        std::find(result.nodes.begin(), result.nodes.end(), node) - result.nodes.begin();
      if (found == static_cast<std::ptrdiff_t>(result.nodes.size()))
        result.nodes.push_back(node);
      return static_cast<unsigned int>(unknowns_per_node * found + component);
    };
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < unknowns_per_node; ++c)
        {
          const auto node   = partitioner.local_to_global(nodes[a]);
          const auto global = c < 3 ? 3 * node + c : n_fluxes + node;
          if (!constraints.is_constrained(global))
            continue;
          result.lines.push_back({unknowns_per_node * a + c, global, {}});
          for (const auto &[other, weight] : *constraints.get_constraint_entries(global))
            result.lines.back().weights.push_back({unknown_of(other), weight});
        }
    for (const unsigned int row : result.nodes)
      for (const unsigned int column : result.nodes)
        result.places.push_back(matrix.place(partitioner.local_to_global(row),
                                             partitioner.local_to_global(column)));
    return result;
  }

  template <typename System>
  void
  CellScatter::condense(const std::vector<Line> &lines,
                        const unsigned int       n_unknowns,
                        System                  &system) const
  {
    for (const Line &line : lines)
      {
        const double value = constraints.get_inhomogeneity(line.global);
        if (value != 0.)
          for (unsigned int r = 0; r < n_unknowns; ++r)
            system.right(r) -= system(r, line.unknown) * value;
      }
    for (const Line &line : lines)
      {
        for (const auto &[other, weight] : line.weights)
          {
            system.right(other) += weight * system.right(line.unknown);
            for (unsigned int c = 0; c < n_unknowns; ++c)
              system(other, c) += weight * system(line.unknown, c);
          }
        for (const auto &[other, weight] : line.weights)
          for (unsigned int r = 0; r < n_unknowns; ++r)
            system(r, other) += weight * system(r, line.unknown);
      }
    for (const Line &line : lines)
      {
        const double diagonal = std::abs(system(line.unknown, line.unknown));
        for (unsigned int k = 0; k < n_unknowns; ++k)
          system(line.unknown, k) = system(k, line.unknown) = 0.;
        system(line.unknown, line.unknown) = diagonal;
        system.right(line.unknown)         = 0.;
      }
  }

  template <typename System>
  void
  CellScatter::scatter(const unsigned int *const nodes,
                       const unsigned int        n_nodes,
                       const unsigned int *const places,
                       System                   &system,
                       BlockVector              &rhs) const
  {
    const auto block = [&](const unsigned int a, const unsigned int b) {
      return matrix.block(places[n_nodes * a + b]);
    };
    for (unsigned int a = 0; a < n_nodes; ++a)
      add_row(system, a, n_nodes, block);
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        for (unsigned int i = 0; i < 3; ++i)
          rhs.block(0).local_element(3 * nodes[a] + i) +=
            system.right(unknowns_per_node * a + i);
        rhs.block(1).local_element(nodes[a]) += system.right(unknowns_per_node * a + 3);
      }
  }

  void
  CellScatter::add(const unsigned int cell, CellSystem &system, BlockVector &rhs) const
  {
    constexpr unsigned int n_unknowns = nodes_per_cell * unknowns_per_node;
    const Constrained     *of_cell =
      number[cell] == unconstrained ? nullptr : &constrained[number[cell]];
    if (of_cell && of_cell->nodes.size() > nodes_per_cell)
      {
        const unsigned int n_nodes = of_cell->nodes.size();
        NodesSystem        wide(n_nodes);
        for (unsigned int r = 0; r < n_unknowns; ++r)
          {
            wide.right(r) = system.right(r);
            for (unsigned int c = 0; c < n_unknowns; ++c)
              wide(r, c) = system(r, c);
          }
        condense(of_cell->lines, unknowns_per_node * n_nodes, wide);
        scatter(of_cell->nodes.data(), n_nodes, of_cell->places.data(), wide, rhs);
      }
    else
      {
        if (of_cell)
          condense(of_cell->lines, n_unknowns, system);
        scatter(space.cell_nodes[cell].data(),
                nodes_per_cell,
                places[cell].data(),
                system,
                rhs);
      }
  }

  void
  CellScatter::add(const unsigned int          node,
                   const double                resistance,
                   const dealii::Tensor<1, 3> &source,
                   BlockVector                &rhs) const
  {
    const Constrained  of_node = find_constrained(&node, 1);
    const unsigned int n_nodes = of_node.nodes.size();
    NodesSystem        system(n_nodes);
    for (unsigned int i = 0; i < 3; ++i)
      {
        system(i, i)    = resistance;
        system.right(i) = source[i];
      }
    condense(of_node.lines, unknowns_per_node * n_nodes, system);
    scatter(of_node.nodes.data(), n_nodes, of_node.places.data(), system, rhs);
  }
} // namespace graupel
