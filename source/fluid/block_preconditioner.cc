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
    scratch.reinit(src.block(0), true);
    schur_inverse.vmult(dst.block(1), src.block(1));
    system->block(0, 1).vmult(scratch, dst.block(1));
    scratch.sadd(-1., 1., src.block(0));
    flux_inverse.vmult(dst.block(0), scratch);
  }
} // namespace graupel
