// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/pressure_matrix.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>

namespace graupel
{
  PressureMatrix::PressureMatrix(const FlowSpace &space)
    : space(space)
    , number(space.n_cells(), dealii::numbers::invalid_unsigned_int)
  {
    matrix.reinit(space.nodes.coupling_pattern);
    // From here on Trilinos keeps the values in one piece.
    matrix.compress(dealii::VectorOperation::add);
    int *starts, *columns;
    if (matrix.trilinos_matrix().ExtractCrsDataPointers(starts, columns, values) == 0)
      for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
        find_places(cell);
  }

  void
  PressureMatrix::find_places(const unsigned int cell)
  {
    const NodalSpace       &nodes       = space.nodes;
    const auto             &partitioner = *nodes.measure().get_partitioner();
    const Epetra_CrsMatrix &all         = matrix.trilinos_matrix();
    int                    *starts, *columns;
    double                 *of_rows;
    all.ExtractCrsDataPointers(starts, columns, of_rows);
    Places found;
    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      {
        const auto row = partitioner.local_to_global(space.cell_nodes[cell][a]);
        if (!partitioner.in_local_range(row) || nodes.hanging_nodes.is_constrained(row))
          return;
        const int  local = all.LRID(static_cast<int>(row));
        const auto begin = columns + starts[local], end = columns + starts[local + 1];
        for (unsigned int b = 0; b < nodes_per_cell; ++b)
          {
            const auto column = partitioner.local_to_global(space.cell_nodes[cell][b]);
            const auto at     = std::find(begin, end, all.LCID(static_cast<int>(column)));
            if (at == end)
              return;
            found[nodes_per_cell * a + b] = at - columns;
          }
      }
    number[cell] = places.size();
    places.push_back(found);
  }

  void
  PressureMatrix::clear()
  {
    matrix = 0.;
  }

  void
  PressureMatrix::add(const unsigned int cell, const CellMatrix &entries)
  {
    if (number[cell] != dealii::numbers::invalid_unsigned_int)
      {
        const Places &of_cell = places[number[cell]];
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          for (unsigned int b = 0; b < nodes_per_cell; ++b)
            values[of_cell[nodes_per_cell * a + b]] += entries[a][b];
        return;
      }
    const auto &partitioner = *space.nodes.measure().get_partitioner();
    dealii::FullMatrix<double> local(nodes_per_cell, nodes_per_cell, entries[0].data());
    std::vector<dealii::types::global_dof_index> indices;
    for (const unsigned int node : space.cell_nodes[cell])
      indices.push_back(partitioner.local_to_global(node));
    space.nodes.hanging_nodes.distribute_local_to_global(local, indices, matrix);
  }

  void
  PressureMatrix::compress()
  {
    matrix.compress(dealii::VectorOperation::add);
  }
} // namespace graupel
