// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_pressure_multigrid_h
#define graupel_fluid_pressure_multigrid_h

#include <graupel/fluid/node_blocks.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

struct ML_Struct;

namespace graupel
{
  /**
   * A cycle of algebraic multigrid for an elliptic equation of the pressure. Smoothed
   * aggregates and the coarser levels are those of Trilinos' ML. The finest level, where
   * nearly all entries are, is smoothed here, in single precision: by Gauss-Seidel within
   * each rank, forwards before and backwards after the coarser ones.
   * Source: Vanek, Mandel & Brezina, Computing 56 (1996) 179, doi:10.1007/BF02238511.
   */
  class PressureMultigrid
  {
  public:
    /** For matrices with the pattern of the nodes of @p system, which must outlive this
     * object. */
    explicit PressureMultigrid(const NodeBlockMatrix &system);

    /** Makes the levels of @p matrix, which must stay. Collective. */
    void refresh(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    /** @p x becomes about the solution for the continuity equations of @p b. Collective.
     */
    void vmult(NodeValues &x, const NodeBlockVector &b) const;

  private:
    void take_finest(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    // Sum over the entries at these places.
    float product(const NodeValues  &x,
                  const unsigned int begin,
                  const unsigned int end) const;
    // From 0.
    void smooth_forwards(NodeValues &x, const NodeBlockVector &b) const;
    // What is left after that.
    void find_residual(const NodeValues &x) const;
    // Adds to the pressure what the coarser levels make of the residual.
    void correct(NodeValues &x) const;
    void smooth_backwards(NodeValues &x, const NodeBlockVector &b) const;

    const NodeBlockMatrix                    &system;
    dealii::TrilinosWrappers::PreconditionAMG levels;
    ML_Struct                                *ml          = nullptr; // of the levels
    bool                                      has_coarser = false;
    std::vector<float>                        values;    // by the system's blocks
    std::vector<unsigned int>                 diagonals; // their places
    std::vector<float>                        inverse_diagonal;
    mutable dealii::LinearAlgebra::distributed::Vector<double> residual, correction;
    mutable std::vector<double> coarse_residual, coarse_correction;
  };
} // namespace graupel

#endif
