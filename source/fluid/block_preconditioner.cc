#include <graupel/fluid/block_preconditioner.h>

namespace graupel
{
  BlockPreconditioner::BlockPreconditioner(const NodeBlockMatrix &system)
    : system(system)
    , diffusion_inverse(system)
  {
    system.initialize_values(values);
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
    const auto take = [&](const unsigned int unknown) {
      for (unsigned int row = 0; row < system.n_rows(); ++row)
        x.local_element(4 * row + unknown) = values.local_element(row);
      system.add_product(product, values, unknown);
    };
    product = 0.f;
    diffusion_inverse.vmult(values, b);
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      values.local_element(row) += of_grad_div[row] * b.local_element(4 * row + 3);
    take(3);
    for (unsigned int component = 0; component < 3; ++component)
      {
        flux_inverse.solve(values, b, product, component);
        take(component);
      }
  }
} // namespace graupel
