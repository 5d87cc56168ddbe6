#ifndef graupel_coupling_filter_h
#define graupel_coupling_filter_h

#include <graupel/mesh/nodal_space.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace graupel
{
  /**
   * The filter that spreads what particles carry over a physical length l:
   *
   *   A = M + l^2 K,   S = A^-1 M,
   *
   * with M the diagonal matrix of the nodes' volumes and K the stiffness matrix
   * of their basis functions with natural boundary conditions, so that walls
   * need no special case. S keeps constants and is self-adjoint in M. With
   * l = 0 it is the identity. Its kernel has the standard deviation
   * sqrt(2) l in each direction once the mesh resolves it.
   */
  class Filter
  {
  public:
    /** @p length l >= 0 [m]; @p nodes must outlive the filter. */
    Filter(const NodalSpace &nodes, const double length);

    /**
     * x = A^-1 b for sums b over particles (W^T of something). What @p x holds
     * on entry is where the iteration starts. The sum of M x equals the sum of b
     * to round-off. Ghosts of @p x are up to date afterwards. Throws
     * std::runtime_error if the iteration fails.
     */
    void spread(NodalVector &x, const NodalVector &b) const;

    /** x = S f, with the same remarks. */
    void smooth(NodalVector &x, const NodalVector &f) const;

  private:
    const NodalSpace                      &nodes;
    const double                           length;
    dealii::TrilinosWrappers::SparseMatrix  matrix;
    dealii::TrilinosWrappers::PreconditionILU preconditioner;
    double                                 total_volume;
  };
} // namespace graupel

#endif
