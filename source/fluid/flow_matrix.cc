// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/even_share.h>
#include <graupel/fluid/flow_matrix.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <experimental/simd>
#include <set>

namespace graupel
{
  namespace
  {
    using FourDoubles =
      std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 4>>;

    FourDoubles
    column(const double *const block, const unsigned int number)
    {
      return FourDoubles(block + 4 * number, std::experimental::element_aligned);
    }
  } // namespace

  dealii::IndexSet
  unknowns_of_nodes(const dealii::IndexSet &nodes, const unsigned int per_node)
  {
    dealii::IndexSet result(per_node * nodes.size());
    for (auto interval = nodes.begin_intervals(); interval != nodes.end_intervals();
         ++interval)
      result.add_range(per_node * *interval->begin(), per_node * (interval->last() + 1));
    result.compress();
    return result;
  }

  FlowMatrix::FlowMatrix(const NodalSpace &space)
  {
    const MPI_Comm                 communicator = space.mesh.communicator();
    dealii::DynamicSparsityPattern pattern(space.relevant);
    dealii::DoFTools::make_sparsity_pattern(
      space.dof_handler, pattern, space.hanging_nodes, false);
    std::vector<Pair> foreign;
    for (const auto row : space.relevant)
      if (!space.owned.is_element(row))
        for (unsigned int k = 0; k < pattern.row_length(row); ++k)
          foreign.push_back({row, pattern.column_number(row, k)});
    dealii::SparsityTools::distribute_sparsity_pattern(
      pattern, space.owned, communicator, space.relevant);
    store_pattern(pattern, space);
    number_blocks(foreign, space);
  }

  void
  FlowMatrix::store_pattern(const dealii::DynamicSparsityPattern &pattern,
                            const NodalSpace                     &space)
  {
    std::set<dealii::types::global_dof_index> foreign_columns;
    for (const auto row : space.owned)
      for (unsigned int k = 0; k < pattern.row_length(row); ++k)
        if (const auto column = pattern.column_number(row, k);
            !space.owned.is_element(column))
          foreign_columns.insert(column);
    dealii::IndexSet ghosts(space.owned.size());
    ghosts.add_indices(foreign_columns.begin(), foreign_columns.end());
    nodes = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      space.owned, ghosts, space.mesh.communicator());

    row_starts.assign(1, 0);
    for (const auto row : space.owned)
      {
        for (unsigned int k = 0; k < pattern.row_length(row); ++k)
          column_nodes.push_back(nodes->global_to_local(pattern.column_number(row, k)));
        std::sort(column_nodes.begin() + row_starts.back(), column_nodes.end());
        row_starts.push_back(column_nodes.size());
      }
  }

  void
  FlowMatrix::number_blocks(const std::vector<Pair> &foreign, const NodalSpace &space)
  {
    using Number                = dealii::types::global_dof_index;
    const MPI_Comm communicator = space.mesh.communicator();
    // All numbers of the ranks' blocks one behind another, with a block that counts for
    // nothing at the end of each rank's.
    const std::uint64_t n_own = block_size * (column_nodes.size() + std::uint64_t(1));
    const std::uint64_t begin = on_lower_ranks(n_own, communicator);
    const std::uint64_t n_all = dealii::Utilities::MPI::sum(n_own, communicator);
    AssertThrow(n_all <= std::numeric_limits<Number>::max(),
                dealii::ExcMessage(
                  "The flow's matrix has more entries than deal.II's indices of 32 bits "
                  "can number: configure deal.II with DEAL_II_WITH_64BIT_INDICES."));

    // Owners tell the numbers of their blocks.
    dealii::IndexSet foreign_rows(space.owned.size());
    for (const auto &pair : foreign)
      foreign_rows.add_index(pair.first);
    const auto owners = dealii::Utilities::MPI::compute_index_owner(
      space.owned, foreign_rows, communicator);
    std::map<unsigned int, std::vector<Pair>> wanted;
    for (const auto &pair : foreign)
      wanted[owners[foreign_rows.index_within_set(pair.first)]].push_back(pair);
    std::map<unsigned int, std::vector<Number>> answers;
    for (const auto &[rank, pairs] :
         dealii::Utilities::MPI::some_to_some(communicator, wanted))
      for (const auto &[row, column] : pairs)
        answers[rank].push_back(begin + block_size * place(row, column));
    answers = dealii::Utilities::MPI::some_to_some(communicator, answers);

    dealii::IndexSet own(n_all), ghosts(n_all);
    own.add_range(begin, begin + n_own);
    for (const auto &[rank, numbers] : answers)
      for (const Number number : numbers)
        ghosts.add_range(number, number + block_size);
    values.reinit(own, ghosts, communicator);
    for (const auto &[rank, pairs] : wanted)
      for (unsigned int k = 0; k < pairs.size(); ++k)
        foreign_places[pairs[k]] =
          values.get_partitioner()->global_to_local(answers.at(rank)[k]) / block_size;
  }

  void
  FlowMatrix::initialize(BlockVector &vector) const
  {
    std::vector<dealii::IndexSet> own, ghosts;
    for (const unsigned int per_node : {3, 1})
      {
        own.push_back(unknowns_of_nodes(nodes->locally_owned_range(), per_node));
        ghosts.push_back(unknowns_of_nodes(nodes->ghost_indices(), per_node));
      }
    vector.reinit(BlockVector(own, ghosts, nodes->get_mpi_communicator()));
  }

  unsigned int
  FlowMatrix::place(const dealii::types::global_dof_index row,
                    const dealii::types::global_dof_index column) const
  {
    if (!nodes->in_local_range(row))
      {
        const auto found = foreign_places.find({row, column});
        return found == foreign_places.end() ? nowhere() : found->second;
      }
    if (!nodes->in_local_range(column) && !nodes->is_ghost_entry(column))
      return nowhere();
    const unsigned int local_row = nodes->global_to_local(row),
                       wanted    = nodes->global_to_local(column);
    const auto begin             = column_nodes.begin() + row_starts[local_row],
               end               = column_nodes.begin() + row_starts[local_row + 1],
               found             = std::lower_bound(begin, end, wanted);
    return found == end || *found != wanted ? nowhere() : found - column_nodes.begin();
  }

  void
  FlowMatrix::clear()
  {
    values = 0.;
  }

  void
  FlowMatrix::compress()
  {
    values.compress(dealii::VectorOperation::add);
  }

  void
  FlowMatrix::vmult(BlockVector &dst, const BlockVector &src) const
  {
    src.update_ghost_values();
    const double *const flux = src.block(0).begin(), *const pressure =
                                                       src.block(1).begin();
    const double *a = values.begin();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        FourDoubles sum = 0., other = 0.;
        for (unsigned int k = row_starts[row]; k < row_starts[row + 1];
             ++k, a += block_size)
          {
            const double *const q = flux + 3 * column_nodes[k];
            sum += column(a, 0) * q[0];
            other += column(a, 1) * q[1];
            sum += column(a, 2) * q[2];
            other += column(a, 3) * pressure[column_nodes[k]];
          }
        sum += other;
        for (unsigned int i = 0; i < 3; ++i)
          dst.block(0).local_element(3 * row + i) = sum[i];
        dst.block(1).local_element(row) = sum[3];
      }
    src.zero_out_ghost_values();
  }
} // namespace graupel
