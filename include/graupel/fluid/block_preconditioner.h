#ifndef graupel_fluid_block_preconditioner_h
#define graupel_fluid_block_preconditioner_h

#include <graupel/fluid/flux_factors.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace graupel
{
  /**
   * Block triangular preconditioner [A G; 0 S] of the coupled system [A G; D C] of
   * flux and pressure: FluxFactors for A, and one algebraic multigrid cycle on an
   * approximation S of the Schur complement C - D A^-1 G.
   * Source: Elman, Silvester & Wathen, Finite Elements and Fast Iterative Solvers (2014),
   * ch. 9.
   */
  class BlockPreconditioner
  {
  public:
    /** Of @p system, which must outlive this object. */
    explicit BlockPreconditioner(const NodeBlockMatrix &system);

    /** Factorises; again when the system or @p schur have changed too much, of which the
     * latter must stay. */
    void refresh(const dealii::TrilinosWrappers::SparseMatrix &schur);

    void vmult(NodeBlockVector &dst, const NodeBlockVector &src) const;

  private:
    const NodeBlockMatrix                                     &system;
    FluxFactors                                                flux_inverse;
    dealii::TrilinosWrappers::PreconditionAMG                  schur_inverse;
    mutable dealii::LinearAlgebra::distributed::Vector<double> residual, pressure;
  };
} // namespace graupel

#endif
