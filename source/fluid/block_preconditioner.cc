#include <graupel/fluid/block_preconditioner.h>

namespace graupel
{
  BlockPreconditioner::BlockPreconditioner(const NodeBlockMatrix &system)
    : system(system)
  {
  }

  void
  BlockPreconditioner::refresh(const dealii::TrilinosWrappers::SparseMatrix &schur)
  {
    flux_inverse.refresh(system);
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.smoother_sweeps       = 2;
    data.aggregation_threshold = 0.02;
    schur_inverse.initialize(schur, data);
    residual.reinit(schur.locally_owned_range_indices(), schur.get_mpi_communicator());
    pressure.reinit(residual);
  }

  void
  BlockPreconditioner::vmult(NodeBlockVector &dst, const NodeBlockVector &src) const
  {
    for (unsigned int node = 0; node < system.n_rows(); ++node)
      residual.local_element(node) = src.local_element(4 * node + 3);
    schur_inverse.vmult(pressure, residual);
    for (unsigned int node = 0; node < system.n_rows(); ++node)
      dst.local_element(4 * node + 3) = pressure.local_element(node);
    system.subtract_gradient(dst, src);
    flux_inverse.solve(dst);
  }
} // namespace graupel
