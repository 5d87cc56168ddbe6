// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/block_preconditioner.h>

namespace graupel
{
  BlockPreconditioner::BlockPreconditioner(const NodeBlockMatrix &system)
    : system(system)
    , schur_inverse(system)
  {
  }

  void
  BlockPreconditioner::refresh(const dealii::TrilinosWrappers::SparseMatrix &schur)
  {
    flux_inverse.refresh(system);
    schur_inverse.refresh(schur);
  }

  void
  BlockPreconditioner::vmult(NodeBlockVector       &x,
                             NodeBlockVector       &product,
                             const NodeBlockVector &b) const
  {
    schur_inverse.vmult(x, b);
    system.multiply_pressure(product, x);
    flux_inverse.solve(x, b, product);
  }
} // namespace graupel
