#ifndef graupel_fluid_compressed_rows_h
#define graupel_fluid_compressed_rows_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace graupel
{
  /** The entries of this rank's rows of a matrix, where Trilinos stores them: those of
   * row r from starts[r] to starts[r + 1]; columns are local numbers of its column map.
   */
  struct CompressedRows
  {
    const int *starts, *columns;
    double    *values;
  };

  /** Throws dealii::ExcMessage where @p matrix is not stored by rows. */
  CompressedRows compressed_rows(const dealii::TrilinosWrappers::SparseMatrix &matrix);
} // namespace graupel

#endif
