// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_matrix_h
#define graupel_fluid_flow_matrix_h

#include <graupel/mesh/nodal_space.h>

#include <deal.II/lac/la_parallel_block_vector.h>

namespace graupel
{
  /** Flux, three components a node, and pressure. */
  using BlockVector = dealii::LinearAlgebra::distributed::BlockVector<double>;

  /** The numbers of the unknowns of @p nodes that have @p per_node each, side by side. */
  dealii::IndexSet unknowns_of_nodes(const dealii::IndexSet &nodes,
                                     const unsigned int      per_node);

  /**
   * The flow's linear system [A G; D C] as blocks of 4 x 4 by pairs of nodes that share a
   * cell, in double precision: rows and columns are three components of the flux or of
   * the momentum equation, then pressure and continuity. A rank has the rows of its own
   * nodes. What its cells add to those of others it sends home in compress().
   */
  class FlowMatrix
  {
  public:
    /** Numbers in a block. */
    static constexpr unsigned int block_size = 16;

    /** All 0. A hanging node has a diagonal block only, its parents are coupled in its
     * place. Collective. */
    explicit FlowMatrix(const NodalSpace &nodes);

    /** Makes @p vector a zero vector, with room for the ghosts that vmult() reads. */
    void initialize(BlockVector &vector) const;

    /** Of the block of two nodes by their global numbers, @p row one of the nodes that an
     * owned cell couples; nowhere() where one of them hangs and there is no such block.
     */
    unsigned int place(const dealii::types::global_dof_index row,
                       const dealii::types::global_dof_index column) const;

    /** The place of a block that counts for nothing. */
    unsigned int
    nowhere() const
    {
      return column_nodes.size();
    }

    /** The block at a place, column by column. */
    double *
    block(const unsigned int place)
    {
      return values.begin() + static_cast<std::size_t>(block_size) * place;
    }
    const double *
    block(const unsigned int place) const
    {
      return values.begin() + static_cast<std::size_t>(block_size) * place;
    }

    /** Makes all blocks 0. */
    void clear();

    /** Sends home what was added to rows of other ranks. Collective. */
    void compress();

    /** @p dst = [A G; D C] @p src, of which the ghosts must not be up to date.
     * Collective. */
    void vmult(BlockVector &dst, const BlockVector &src) const;

    unsigned int
    n_rows() const
    {
      return row_starts.size() - 1;
    }

    /** Where the blocks of a row begin; those of the last row end at n_rows(). */
    const std::vector<unsigned int> &
    rows() const
    {
      return row_starts;
    }

    /** The local node of each block's columns, ascending in a row; from n_rows() on they
     * are ghosts. */
    const std::vector<unsigned int> &
    columns() const
    {
      return column_nodes;
    }

    /** Of the nodes: own ones, and the ghosts among the columns. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    partitioner() const
    {
      return nodes;
    }

  private:
    using Pair =
      std::pair<dealii::types::global_dof_index, dealii::types::global_dof_index>;

    void store_pattern(const dealii::DynamicSparsityPattern &pattern,
                       const NodalSpace                     &space);
    void number_blocks(const std::vector<Pair> &foreign, const NodalSpace &space);

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> nodes;
    std::vector<unsigned int>                                  row_starts, column_nodes;
    // Of the blocks of other ranks' rows, which follow the own ones as ghosts.
    std::map<Pair, unsigned int>                       foreign_places;
    dealii::LinearAlgebra::distributed::Vector<double> values;
  };
} // namespace graupel

#endif
