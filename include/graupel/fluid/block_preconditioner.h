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
   * flux and pressure. Of A, FluxFactors of each component in turn, which knows those
   * before it: grad-div couples them. Of the inverse of the Schur complement
   * S = C - D A^-1 G, one cycle of algebraic multigrid for a diffusion of the pressure,
   * plus what grad-div adds to it, its coefficient over the volume of each node. Source:
   * Elman, Silvester & Wathen, Finite Elements and Fast Iterative Solvers (2014), ch. 9;
   * Cahouet & Chabard, Int. J. Numer. Methods Fluids 8 (1988) 869,
   * doi:10.1002/fld.1650080802, and Heister & Rapin, ibid. 71 (2013) 118,
   * doi:10.1002/fld.3654 (grad-div).
   */
  class BlockPreconditioner
  {
  public:
    /** Of @p system, which must outlive this object. */
    explicit BlockPreconditioner(const NodeBlockMatrix &system);

    /** Factorises; again when the system has changed too much. @p diffusion is that of
     * the pressure, and must stay; @p of_grad_div what is added to its inverse, by node.
     */
    void refresh(const dealii::TrilinosWrappers::SparseMatrix &diffusion,
                 const NodalVector                            &of_grad_div);

    /** @p x becomes about the solution for @p b, and @p product what the system makes of
     * x, which is found on the way. Collective. */
    void vmult(NodeBlockVector       &x,
               NodeBlockVector       &product,
               const NodeBlockVector &b) const;

  private:
    const NodeBlockMatrix            &system;
    FluxFactors                       flux_inverse;
    PressureMultigrid                 diffusion_inverse;
    std::vector<float>                of_grad_div;
    mutable std::array<NodeValues, 4> values; // by unknown
  };
} // namespace graupel

#endif
