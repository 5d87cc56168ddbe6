#include <graupel/fluid/compressed_rows.h>
#include <graupel/fluid/node_blocks.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    constexpr unsigned int nowhere = dealii::numbers::invalid_unsigned_int;
  } // namespace

  NodeBlockMatrix::NodeBlockMatrix(
    const dealii::TrilinosWrappers::BlockSparseMatrix &original)
  {
    const auto            &of_pressure = original.block(1, 1);
    const Epetra_BlockMap &column_map  = of_pressure.trilinos_matrix().ColMap();
    const auto             owned_nodes = of_pressure.locally_owned_range_indices();
    const auto             n_all       = of_pressure.m();
    const unsigned int     n_owned     = owned_nodes.n_elements();
    dealii::IndexSet       owned(4 * n_all), ghosts(4 * n_all);
    for (auto interval = owned_nodes.begin_intervals();
         interval != owned_nodes.end_intervals();
         ++interval)
      owned.add_range(4 * *interval->begin(), 4 * (interval->last() + 1));
    for (int k = 0; k < column_map.NumMyElements(); ++k)
      ghosts.add_range(4 * column_map.GID(k), 4 * (column_map.GID(k) + 1));
    ghosts.subtract_set(owned);
    partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      owned, ghosts, of_pressure.get_mpi_communicator());

    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        {
          const unsigned int     per_node = j == 0 ? 3 : 1;
          const Epetra_BlockMap &map = original.block(i, j).trilinos_matrix().ColMap();
          for (int k = 0; k < map.NumMyElements(); ++k)
            {
              const unsigned int number = map.GID(k), node = number / per_node;
              const bool         is_known = partitioner->in_local_range(4 * node) ||
                                    partitioner->is_ghost_entry(4 * node);
              of_column[i][j].push_back(
                {is_known ? partitioner->global_to_local(4 * node) / 4 : nowhere,
                 j == 0 ? number % per_node : 3});
            }
        }

    const CompressedRows rows = compressed_rows(of_pressure);
    row_starts.assign(1, 0);
    for (unsigned int row = 0; row < n_owned; ++row)
      {
        for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
          column_nodes.push_back(of_column[1][1][rows.columns[k]].node);
        std::sort(column_nodes.begin() + row_starts.back(), column_nodes.end());
        row_starts.push_back(column_nodes.size());
      }
    flux_columns.resize(12 * column_nodes.size());
    pressure_columns.resize(4 * column_nodes.size());
  }

  void
  NodeBlockMatrix::take(const dealii::TrilinosWrappers::BlockSparseMatrix &original)
  {
    for (unsigned int unknown = 0; unknown < 4; ++unknown)
      for (unsigned int block = 0; block < 2; ++block)
        {
          const CompressedRows rows = compressed_rows(original.block(unknown / 3, block));
          for (unsigned int node = 0; node < n_rows(); ++node)
            {
              const unsigned int row   = unknown < 3 ? 3 * node + unknown : node;
              const auto         begin = column_nodes.begin() + row_starts[node],
                         end           = column_nodes.begin() + row_starts[node + 1];
              auto here                = begin;
              for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
                {
                  // Both are sorted but for ghosts.
                  const Column column = of_column[unknown / 3][block][rows.columns[k]];
                  here                = std::find(here, end, column.node);
                  if (here == end)
                    here = std::find(begin, end, column.node);
                  if (here == end) // an empty place that deal.II makes for other ranks
                    {
                      here = begin;
                      continue;
                    }
                  const unsigned int place = here - column_nodes.begin();
                  (block == 0 ? flux_columns[12 * place + 4 * column.unknown + unknown]
                              : pressure_columns[4 * place + unknown]) = rows.values[k];
                }
            }
        }
  }

  void
  NodeBlockMatrix::initialize(NodeBlockVector &vector) const
  {
    vector.reinit(partitioner);
  }

  void
  NodeBlockMatrix::vmult(NodeBlockVector &dst, const NodeBlockVector &src) const
  {
    src.update_ghost_values();
    const float *const from = src.begin();
    const float       *flux = flux_columns.data(), *pressure = pressure_columns.data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum = 0.f, other = 0.f;
        for (unsigned int k = row_starts[row]; k < row_starts[row + 1];
             ++k, flux += 12, pressure += 4)
          {
            const float *const x = from + 4 * column_nodes[k];
            sum += unknowns_of(flux, 0) * x[0];
            other += unknowns_of(flux, 1) * x[1];
            sum += unknowns_of(flux, 2) * x[2];
            other += unknowns_of(pressure, 0) * x[3];
          }
        sum += other;
        sum.copy_to(dst.begin() + 4 * row, std::experimental::element_aligned);
      }
    src.zero_out_ghost_values();
  }

  void
  NodeBlockMatrix::subtract_gradient(NodeBlockVector       &dst,
                                     const NodeBlockVector &src) const
  {
    dst.update_ghost_values();
    float *const into     = dst.begin();
    const float *pressure = pressure_columns.data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum = unknowns_of(src.begin(), row);
        for (unsigned int k = row_starts[row]; k < row_starts[row + 1];
             ++k, pressure += 4)
          sum -= unknowns_of(pressure, 0) * into[4 * column_nodes[k] + 3];
        sum[3] = into[4 * row + 3];
        sum.copy_to(into + 4 * row, std::experimental::element_aligned);
      }
    dst.zero_out_ghost_values();
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
