// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/node_blocks.h>

#include <algorithm>

namespace graupel
{
  NodeBlockMatrix::NodeBlockMatrix(const FlowMatrix &original)
    : original(original)
  {
    for (auto &column : blocks)
      column.resize(4 * original.columns().size());
  }

  void
  NodeBlockMatrix::take()
  {
    continuity_norms   = {};
    const auto &starts = rows();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        std::array<float, 4> sums{};
        for (std::size_t k = starts[row]; k < starts[row + 1]; ++k)
          for (unsigned int c = 0; c < 4; ++c)
            {
              const double *const column = original.block(k) + 4 * c;
              std::copy(column, column + 4, &blocks[c][4 * k]);
              sums[c] += std::abs(blocks[c][4 * k + 3]);
            }
        continuity_norms[0] =
          std::max<double>(continuity_norms[0], sums[0] + sums[1] + sums[2]);
        continuity_norms[1] = std::max<double>(continuity_norms[1], sums[3]);
      }
    for (double &norm : continuity_norms)
      norm = dealii::Utilities::MPI::max(norm, nodes()->get_mpi_communicator());
  }

  void
  NodeBlockMatrix::initialize(NodeBlockVector &vector) const
  {
    vector.reinit(unknowns_of_nodes(nodes()->locally_owned_range(), 4),
                  nodes()->get_mpi_communicator());
  }

  void
  NodeBlockMatrix::initialize_values(NodeValues &values) const
  {
    values.reinit(nodes());
  }

  void
  NodeBlockMatrix::multiply(NodeBlockVector   &product,
                            const NodeValues  &x,
                            const unsigned int unknown) const
  {
    add_column(product, x, unknown, [](const unsigned int) { return NodeUnknowns(0.f); });
  }

  void
  NodeBlockMatrix::add_product(NodeBlockVector   &product,
                               const NodeValues  &x,
                               const unsigned int unknown) const
  {
    add_column(product, x, unknown, [&](const unsigned int row) {
      return unknowns_of(product.begin(), row);
    });
  }

  template <typename Begin>
  void
  NodeBlockMatrix::add_column(NodeBlockVector   &product,
                              const NodeValues  &x,
                              const unsigned int unknown,
                              const Begin       &begin) const
  {
    x.update_ghost_values();
    const auto        &starts = rows(), &nodes = columns();
    const float *const from   = x.begin();
    const float       *column = blocks[unknown].data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum[4]{begin(row), 0.f, 0.f, 0.f};
        unsigned int k = starts[row];
        for (; k + 4 <= starts[row + 1]; k += 4, column += 16)
          for (unsigned int i = 0; i < 4; ++i)
            sum[i] += unknowns_of(column, i) * from[nodes[k + i]];
        for (; k < starts[row + 1]; ++k, column += 4)
          sum[0] += unknowns_of(column, 0) * from[nodes[k]];
        sum[0] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
        sum[0].copy_to(product.begin() + std::size_t{4} * row,
                       std::experimental::element_aligned);
      }
    x.zero_out_ghost_values();
  }

  void
  NodeBlockMatrix::to_nodes(NodeBlockVector   &dst,
                            const BlockVector &src,
                            const double       size) const
  {
    for (unsigned int node = 0; node < n_rows(); ++node)
      {
        for (unsigned int i = 0; i < 3; ++i)
          dst.local_element(4 * node + i) =
            src.block(0).local_element(3 * node + i) / size;
        dst.local_element(4 * node + 3) = src.block(1).local_element(node) / size;
      }
  }

  void
  NodeBlockMatrix::add_to(BlockVector           &dst,
                          const NodeBlockVector &src,
                          const double           size) const
  {
    for (unsigned int node = 0; node < n_rows(); ++node)
      {
        for (unsigned int i = 0; i < 3; ++i)
          dst.block(0).local_element(3 * node + i) +=
            size * src.local_element(4 * node + i);
        dst.block(1).local_element(node) += size * src.local_element(4 * node + 3);
      }
  }
} // namespace graupel
