// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/pressure_multigrid.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <ml_MultiLevelPreconditioner.h>

namespace graupel
{
  PressureMultigrid::PressureMultigrid(const NodeBlockMatrix &system)
    : system(system)
    , values(system.columns().size())
    , inverse_diagonal(system.n_rows())
  {
    residual.reinit(system.nodes()->locally_owned_range(),
                    system.nodes()->get_mpi_communicator());
    correction.reinit(residual);
    const auto &columns = system.columns();
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      diagonals.push_back(std::lower_bound(columns.begin() + system.rows()[row],
                                           columns.begin() + system.rows()[row + 1],
                                           row) -
                          columns.begin());
  }

  void
  PressureMultigrid::refresh(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.aggregation_threshold = 0.02;
    levels.initialize(matrix, data);
    const auto &all =
      dynamic_cast<ML_Epetra::MultiLevelPreconditioner &>(levels.trilinos_operator());
    ml                                   = const_cast<ML *>(all.GetML());
    const ML_Operator *const restriction = ml->SingleLevel[ml->ML_finest_level].Rmat;
    has_coarser                          = restriction->to;
    if (has_coarser)
      {
        coarse_residual.resize(restriction->outvec_leng);
        coarse_correction.resize(restriction->outvec_leng);
        take_finest(matrix);
      }
  }

  void
  PressureMultigrid::take_finest(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    const auto &original = matrix.trilinos_matrix();
    const auto &columns  = system.columns();
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      {
        int     n_entries;
        double *entries;
        int    *numbers;
        original.ExtractMyRowView(row, n_entries, entries, numbers);
        const auto begin = columns.begin() + system.rows()[row],
                   end   = columns.begin() + system.rows()[row + 1];
        for (int k = 0; k < n_entries; ++k)
          {
            const unsigned int column =
              system.nodes()->global_to_local(original.ColMap().GID(numbers[k]));
            values[std::lower_bound(begin, end, column) - columns.begin()] = entries[k];
            if (column == row)
              inverse_diagonal[row] = 1. / entries[k];
          }
      }
  }

  void
  PressureMultigrid::vmult(NodeValues &x, const NodeBlockVector &b) const
  {
    if (has_coarser)
      {
        smooth_forwards(x, b);
        find_residual(x);
        correct(x);
        smooth_backwards(x, b);
      }
    else
      {
        for (unsigned int row = 0; row < system.n_rows(); ++row)
          residual.local_element(row) = b.local_element(4 * row + 3);
        levels.vmult(correction, residual);
        for (unsigned int row = 0; row < system.n_rows(); ++row)
          x.local_element(row) = correction.local_element(row);
      }
  }

  float
  PressureMultigrid::product(const NodeValues  &x,
                             const unsigned int begin,
                             const unsigned int end) const
  {
    return row_product(&values[begin], &system.columns()[begin], x.begin(), end - begin);
  }

  void
  PressureMultigrid::smooth_forwards(NodeValues &x, const NodeBlockVector &b) const
  {
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      x.local_element(row) =
        inverse_diagonal[row] *
        (b.local_element(4 * row + 3) - product(x, system.rows()[row], diagonals[row]));
  }

  void
  PressureMultigrid::find_residual(const NodeValues &x) const
  {
    // A row has only been told of what comes before its diagonal.
    x.update_ghost_values();
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      residual.local_element(row) =
        -product(x, diagonals[row] + 1, system.rows()[row + 1]);
    x.zero_out_ghost_values();
  }

  void
  PressureMultigrid::smooth_backwards(NodeValues &x, const NodeBlockVector &b) const
  {
    x.update_ghost_values();
    for (unsigned int row = system.n_rows(); row-- > 0;)
      x.local_element(row) +=
        inverse_diagonal[row] * (b.local_element(4 * row + 3) -
                                 product(x, system.rows()[row], system.rows()[row + 1]));
    x.zero_out_ghost_values();
  }

  void
  PressureMultigrid::correct(NodeValues &x) const
  {
    ML_Operator *const restriction = ml->SingleLevel[ml->ML_finest_level].Rmat;
    ML_1Level *const   coarser     = restriction->to;
    const int n_fine = residual.locally_owned_size(), n_coarse = coarse_residual.size();
    ML_Operator_Apply(
      restriction, n_fine, residual.begin(), n_coarse, coarse_residual.data());
    std::fill(coarse_correction.begin(), coarse_correction.end(), 0.);
    ML_Cycle_MG(coarser,
                coarse_correction.data(),
                coarse_residual.data(),
                ML_ZERO,
                ml->comm,
                ML_NO_RES_NORM,
                ml);
    ML_Operator_Apply(
      coarser->Pmat, n_coarse, coarse_correction.data(), n_fine, correction.begin());
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      x.local_element(row) += correction.local_element(row);
  }
} // namespace graupel
