#include <graupel/fluid/compressed_rows.h>

#include <Epetra_CrsMatrix.h>

namespace graupel
{
  CompressedRows
  compressed_rows(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    int    *starts, *columns;
    double *values;
    AssertThrow(const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix())
                    .ExtractCrsDataPointers(starts, columns, values) == 0,
                dealii::ExcMessage("The flow's matrix is not stored by rows."));
    return {starts, columns, values};
  }
} // namespace graupel
