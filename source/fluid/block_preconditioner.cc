#include <graupel/fluid/block_preconditioner.h>

namespace graupel
{
  void
  BlockPreconditioner::refresh(const dealii::TrilinosWrappers::BlockSparseMatrix &system,
                               const dealii::TrilinosWrappers::SparseMatrix      &schur)
  {
    this->system = &system;
    flux_inverse.initialize(system.block(0, 0));
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.smoother_sweeps       = 2;
    data.aggregation_threshold = 0.02;
    schur_inverse.initialize(schur, data);
  }

  void
  BlockPreconditioner::vmult(BlockVector &dst, const BlockVector &src) const
  {
    scratch.reinit(src, true);
    flux_inverse.vmult(dst.block(0), src.block(0));
    system->block(1, 0).vmult(scratch.block(1), dst.block(0));
    scratch.block(1).sadd(-1., 1., src.block(1));
    schur_inverse.vmult(dst.block(1), scratch.block(1));
    // dst_q = A^-1 (src_q - G p): one solve more than subtracting, but of the
    // full right-hand side, so that the ILU's error is not counted twice.
    system->block(0, 1).vmult(scratch.block(0), dst.block(1));
    scratch.block(0).sadd(-1., 1., src.block(0));
    flux_inverse.vmult(dst.block(0), scratch.block(0));
  }
} // namespace graupel
