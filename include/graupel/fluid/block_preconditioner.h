// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_block_preconditioner_h
#define graupel_fluid_block_preconditioner_h

#include <graupel/fluid/flux_factors.h>
#include <graupel/fluid/pressure_multigrid.h>

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

    /** @p x becomes about the solution for @p b, and @p product what the system makes of
     * the pressure of x, which is found on the way. */
    void vmult(NodeBlockVector       &x,
               NodeBlockVector       &product,
               const NodeBlockVector &b) const;

  private:
    const NodeBlockMatrix &system;
    FluxFactors            flux_inverse;
    PressureMultigrid      schur_inverse;
  };
} // namespace graupel

#endif
