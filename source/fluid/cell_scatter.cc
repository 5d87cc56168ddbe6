#include <graupel/fluid/cell_scatter.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    constexpr std::uint16_t nowhere = std::numeric_limits<std::uint16_t>::max();

    // Flux and pressure are different blocks of the linear system.
    unsigned int
    block_of(const unsigned int unknown)
    {
      return unknown % unknowns_per_node < 3 ? 0 : 1;
    }

    // Of an unknown of the cell, in its block.
    unsigned int
    local_index(const FlowSpace::LocalNodes &nodes, const unsigned int unknown)
    {
      const unsigned int node      = nodes[unknown / unknowns_per_node],
                         component = unknown % unknowns_per_node;
      return component < 3 ? 3 * node + component : node;
    }
  } // namespace

  CellScatter::CellScatter(const FlowSpace                             &space,
                           const dealii::AffineConstraints<double>     &constraints,
                           dealii::TrilinosWrappers::BlockSparseMatrix &matrix)
    : space(space)
    , constraints(constraints)
    , matrix(matrix)
    , direct(space.n_cells(), dealii::numbers::invalid_unsigned_int)
  {
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        blocks[i][j] = compressed_rows(matrix.block(i, j));
    std::vector<Constrained> found;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      if (find_constrained(cell, found))
        {
          direct[cell] = places.size();
          constrained.push_back(found);
          places.emplace_back();
          find_places(cell, places.back());
        }
  }

  bool
  CellScatter::find_constrained(const unsigned int        cell,
                                std::vector<Constrained> &found) const
  {
    found.clear();
    const unsigned int n_owned = space.owned[1].n_elements();
    for (const unsigned int node : space.cell_nodes[cell])
      if (node >= n_owned)
        return false;
    const auto &unknowns = space.cell_unknowns[cell];
    for (unsigned int u = 0; u < n_unknowns; ++u)
      if (constraints.is_constrained(unknowns[u]))
        {
          found.push_back({u, {}});
          for (const auto &[other, weight] :
               *constraints.get_constraint_entries(unknowns[u]))
            {
              const auto place = std::find(unknowns.begin(), unknowns.end(), other);
              if (place == unknowns.end())
                return false;
              found.back().weights.push_back(
                {static_cast<unsigned int>(place - unknowns.begin()), weight});
            }
        }
    return true;
  }

  void
  CellScatter::find_places(const unsigned int cell, Places &places) const
  {
    const auto &nodes    = space.cell_nodes[cell];
    const auto &unknowns = space.cell_unknowns[cell];
    const auto  n_fluxes = space.owned[0].size();
    for (unsigned int r = 0; r < n_unknowns; ++r)
      for (unsigned int c = 0; c < n_unknowns; ++c)
        {
          places[r][c]     = nowhere;
          const bool bound = constraints.is_constrained(unknowns[r]) ||
                             constraints.is_constrained(unknowns[c]);
          if (bound && r != c)
            continue;
          const auto &block = matrix.block(block_of(r), block_of(c)).trilinos_matrix();
          const int   column =
            block.ColMap().LID(static_cast<int>(unknowns[c] - block_of(c) * n_fluxes));
          int     n_entries;
          double *values;
          int    *columns;
          block.ExtractMyRowView(local_index(nodes, r), n_entries, values, columns);
          const int *const entry = std::find(columns, columns + n_entries, column);
          AssertThrow(entry != columns + n_entries,
                      dealii::ExcMessage("An entry is missing in the flow's matrix."));
          places[r][c] = entry - columns;
        }
  }

  void
  CellScatter::condense(const unsigned int cell, CellSystem &system) const
  {
    const auto &found = constrained[direct[cell]];
    for (const Constrained &line : found)
      {
        const double value =
          constraints.get_inhomogeneity(space.cell_unknowns[cell][line.unknown]);
        if (value != 0.)
          for (unsigned int r = 0; r < n_unknowns; ++r)
            system.right(r) -= system(r, line.unknown) * value;
      }
    for (const Constrained &line : found)
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
        system.right(line.unknown) = 0.;
      }
    for (const Constrained &line : found)
      system(line.unknown, line.unknown) = std::abs(system(line.unknown, line.unknown));
  }

  void
  CellScatter::add_by_constraints(const unsigned int cell,
                                  CellSystem        &system,
                                  BlockVector       &rhs) const
  {
    dealii::FullMatrix<double> cell_matrix(n_unknowns, n_unknowns);
    dealii::Vector<double>     cell_rhs(n_unknowns);
    for (unsigned int r = 0; r < n_unknowns; ++r)
      {
        cell_rhs[r] = system.right(r);
        for (unsigned int c = 0; c < n_unknowns; ++c)
          cell_matrix(r, c) = system(r, c);
      }
    const auto &unknowns = space.cell_unknowns[cell];
    constraints.distribute_local_to_global(cell_matrix, unknowns, matrix);
    constraints.distribute_local_to_global(cell_rhs, unknowns, rhs, cell_matrix);
  }

  void
  CellScatter::add(const unsigned int cell, CellSystem &system, BlockVector &rhs) const
  {
    if (direct[cell] == dealii::numbers::invalid_unsigned_int)
      add_by_constraints(cell, system, rhs);
    else
      {
        condense(cell, system);
        const auto   &nodes = space.cell_nodes[cell];
        const Places &place = places[direct[cell]];
        for (unsigned int r = 0; r < n_unknowns; ++r)
          {
            const unsigned int row   = local_index(nodes, r);
            const auto        &block = blocks[block_of(r)];
            double *const      into[2]{block[0].values + block[0].starts[row],
                                       block[1].values + block[1].starts[row]};
            for (unsigned int c = 0; c < n_unknowns; ++c)
              if (place[r][c] != nowhere)
                into[block_of(c)][place[r][c]] += system(r, c);
            rhs.block(block_of(r)).local_element(row) += system.right(r);
          }
      }
    system = CellSystem();
  }
} // namespace graupel
