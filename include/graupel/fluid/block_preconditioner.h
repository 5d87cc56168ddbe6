#ifndef graupel_fluid_block_preconditioner_h
#define graupel_fluid_block_preconditioner_h

#include <deal.II/lac/la_parallel_block_vector.h>
#include <deal.II/lac/trilinos_block_sparse_matrix.h>
#include <deal.II/lac/trilinos_precondition.h>

namespace graupel
{
  using BlockVector = dealii::LinearAlgebra::distributed::BlockVector<double>;

  /**
   * Block triangular preconditioner [A G; 0 S] of the coupled system [A G; D C] of
   * flux and pressure: ILU(0) for A, and one algebraic multigrid cycle on an
   * approximation S of the Schur complement C - D A^-1 G.
   * Source: Elman, Silvester & Wathen, Finite Elements and Fast Iterative Solvers (2014),
   * ch. 9.
   */
  class BlockPreconditioner
  {
  public:
    /**
     * Factorises. @p system and @p schur must outlive this object; refresh()
     * again when they have changed too much.
     */
    void refresh(const dealii::TrilinosWrappers::BlockSparseMatrix &system,
                 const dealii::TrilinosWrappers::SparseMatrix      &schur);

    void vmult(BlockVector &dst, const BlockVector &src) const;

  private:
    const dealii::TrilinosWrappers::BlockSparseMatrix         *system = nullptr;
    dealii::TrilinosWrappers::PreconditionILU                  flux_inverse;
    dealii::TrilinosWrappers::PreconditionAMG                  schur_inverse;
    mutable dealii::LinearAlgebra::distributed::Vector<double> scratch;
  };
} // namespace graupel

#endif
