// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/block_preconditioner.h>

namespace graupel
{
  BlockPreconditioner::BlockPreconditioner(const NodeBlockMatrix &system)
    : system(system)
    , diffusion_inverse(system)
  {
    for (NodeValues &value : values)
      system.initialize_values(value);
  }

  void
  BlockPreconditioner::refresh(const dealii::TrilinosWrappers::SparseMatrix &diffusion,
                               const NodalVector                            &of_grad_div)
  {
    flux_inverse.refresh(system);
    diffusion_inverse.refresh(diffusion);
    this->of_grad_div.assign(of_grad_div.begin(), of_grad_div.begin() + system.n_rows());
  }

  void
  BlockPreconditioner::vmult(NodeBlockVector       &x,
                             NodeBlockVector       &product,
                             const NodeBlockVector &b) const
  {
    NodeValues &pressure = values[3];
    diffusion_inverse.vmult(pressure, b);
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      pressure.local_element(row) += of_grad_div[row] * b.local_element(4 * row + 3);
    system.multiply(product, pressure, 3);
    for (unsigned int component = 0; component < 3; ++component)
      {
        flux_inverse.solve(values[component], b, product, component);
        system.add_product(product, values[component], component);
      }
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      for (unsigned int unknown = 0; unknown < 4; ++unknown)
        x.local_element(4 * row + unknown) = values[unknown].local_element(row);
  }
} // namespace graupel
