// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/node_blocks.h>

#include <algorithm>

namespace graupel
{
  NodeBlockMatrix::NodeBlockMatrix(const FlowMatrix &original)
    : original(original)
    , partitioner(std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        unknowns_of_nodes(original.partitioner()->locally_owned_range(), 4),
        unknowns_of_nodes(original.partitioner()->ghost_indices(), 4),
        original.partitioner()->get_mpi_communicator()))
    , flux_columns(12 * original.columns().size())
    , pressure_columns(4 * original.columns().size())
  {
  }

  void
  NodeBlockMatrix::take()
  {
    continuity_norms   = {};
    const auto &starts = rows();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        std::array<float, 2> sums{};
        for (unsigned int k = starts[row]; k < starts[row + 1]; ++k)
          {
            const double *const block = original.block(k);
            float *const flux         = &flux_columns[12 * k], *const pressure =
                                                         &pressure_columns[4 * k];
            std::copy(block, block + 12, flux);
            std::copy(block + 12, block + 16, pressure);
            sums[0] += std::abs(flux[3]) + std::abs(flux[7]) + std::abs(flux[11]);
            sums[1] += std::abs(pressure[3]);
          }
        for (unsigned int i = 0; i < 2; ++i)
          continuity_norms[i] = std::max<double>(continuity_norms[i], sums[i]);
      }
    for (double &norm : continuity_norms)
      norm = dealii::Utilities::MPI::max(norm, nodes()->get_mpi_communicator());
  }

  void
  NodeBlockMatrix::initialize(NodeBlockVector &vector) const
  {
    vector.reinit(partitioner);
  }

  void
  NodeBlockMatrix::multiply_pressure(NodeBlockVector       &product,
                                     const NodeBlockVector &x) const
  {
    x.update_ghost_values();
    const auto        &starts = rows(), &nodes = columns();
    const float *const from     = x.begin();
    const float       *pressure = pressure_columns.data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum = 0.f, other = 0.f;
        unsigned int k = starts[row];
        for (; k + 2 <= starts[row + 1]; k += 2, pressure += 8)
          {
            sum += unknowns_of(pressure, 0) * from[4 * nodes[k] + 3];
            other += unknowns_of(pressure, 1) * from[4 * nodes[k + 1] + 3];
          }
        for (; k < starts[row + 1]; ++k, pressure += 4)
          sum += unknowns_of(pressure, 0) * from[4 * nodes[k] + 3];
        sum += other;
        sum.copy_to(product.begin() + 4 * row, std::experimental::element_aligned);
      }
    x.zero_out_ghost_values();
  }

  void
  NodeBlockMatrix::add_flux_product(NodeBlockVector       &product,
                                    const NodeBlockVector &x) const
  {
    x.update_ghost_values();
    const auto        &starts = rows(), &nodes = columns();
    const float *const from = x.begin();
    const float       *flux = flux_columns.data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum[3]{unknowns_of(product.begin(), row), 0.f, 0.f};
        for (unsigned int k = starts[row]; k < starts[row + 1]; ++k, flux += 12)
          for (unsigned int i = 0; i < 3; ++i)
            sum[i] += unknowns_of(flux, i) * from[4 * nodes[k] + i];
        sum[0] += sum[1] + sum[2];
        sum[0].copy_to(product.begin() + 4 * row, std::experimental::element_aligned);
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
