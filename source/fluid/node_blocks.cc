#include <graupel/fluid/node_blocks.h>

#include <algorithm>

namespace graupel
{
  NodeBlockMatrix::NodeBlockMatrix(const FlowMatrix &original)
    : original(original)
    , partitioner(std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        unknowns_of_nodes(original.partitioner().locally_owned_range(), 4),
        unknowns_of_nodes(original.partitioner().ghost_indices(), 4),
        original.partitioner().get_mpi_communicator()))
    , flux_columns(12 * original.columns().size())
    , pressure_columns(4 * original.columns().size())
  {
  }

  void
  NodeBlockMatrix::take()
  {
    for (unsigned int k = 0; k < columns().size(); ++k)
      {
        const double *const block = original.block(k);
        std::copy(block, block + 12, &flux_columns[12 * k]);
        std::copy(block + 12, block + 16, &pressure_columns[4 * k]);
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
    const auto        &starts = rows(), &nodes = columns();
    const float *const from = src.begin();
    const float       *flux = flux_columns.data(), *pressure = pressure_columns.data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum = 0.f, other = 0.f;
        for (unsigned int k = starts[row]; k < starts[row + 1];
             ++k, flux += 12, pressure += 4)
          {
            const float *const x = from + 4 * nodes[k];
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
    const auto  &starts = rows(), &nodes = columns();
    float *const into     = dst.begin();
    const float *pressure = pressure_columns.data();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        NodeUnknowns sum = unknowns_of(src.begin(), row);
        for (unsigned int k = starts[row]; k < starts[row + 1]; ++k, pressure += 4)
          sum -= unknowns_of(pressure, 0) * into[4 * nodes[k] + 3];
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
