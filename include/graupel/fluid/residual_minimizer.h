// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_residual_minimizer_h
#define graupel_fluid_residual_minimizer_h

#include <graupel/fluid/block_preconditioner.h>

namespace graupel
{
  /**
   * Solves the flow's linear system A x = b by minimal residuals over a growing space of
   * preconditioned directions z_k, as GMRES does, in single precision; the solution and
   * now and then its residual are in double precision. The images A z_k are kept as an
   * orthonormal basis Q with A Z = Q R. As Q is a basis whatever the residual is, the
   * search goes on from each exact residual without a restart. The next direction comes
   * from the residual, or from the last basis vector where the residual hardly falls, of
   * which equal directions would come. Where that costs little, the minimum is taken
   * among the solutions of which the residual of the continuity equation has the sum 0:
   * the mass balance of the whole vessel holds long before the equations of all nodes do.
   * Source: Jiranek & Rozloznik, Numer. Algorithms 53 (2010) 93,
   * doi:10.1007/s11075-009-9292-2 (bases); van der Vorst & Ye, SIAM J. Sci. Comput. 22
   * (2000) 835, doi:10.1137/S1064827599353865 (exact residuals).
   */
  class ResidualMinimizer
  {
  public:
    /** Of @p exact and its copy @p system; all must outlive this object. */
    ResidualMinimizer(const FlowMatrix          &exact,
                      const NodeBlockMatrix     &system,
                      const BlockPreconditioner &preconditioner);

    /** The system is another from now on. */
    void forget();

    /** Iterations until |b - A x| is at most @p tolerance, or @p part of what it was at
     * first, or invalid_unsigned_int where that needs more than @p maximum or cannot be
     * reached. Collective. */
    unsigned int solve(BlockVector       &x,
                       const BlockVector &b,
                       const double       tolerance,
                       const double       part,
                       const unsigned int maximum);

    /** b - A x of the last solve(). */
    const BlockVector &
    last_residual() const
    {
      return exact_residual;
    }

  private:
    // The residual of x becomes the one that is to be minimised; its size.
    double take_residual(const BlockVector &x, const BlockVector &b);
    // Minimises the residual to the part wanted of it, or to what single precision is
    // worth; false where that takes more directions than there is room for, or there are
    // none.
    bool minimize(const double       wanted,
                  const unsigned int maximum,
                  unsigned int      &iterations);
    // A new direction and its image, if there is one; the residual loses what it has of
    // the image.
    bool extend(const NodeBlockVector &source);
    // Takes out the sum of the residual over the continuity equation, if it costs little.
    void balance();
    void add_directions(BlockVector &x);
    // Sums over all ranks of the products of a vector with the basis and with itself.
    std::vector<double> products(const NodeBlockVector &vector) const;
    // The vector loses @p part of the basis, chunk by chunk; each is then given to @p use
    // by its begin and length.
    template <typename Use>
    void subtract_basis(NodeBlockVector           &vector,
                        const std::vector<double> &part,
                        const Use                 &use) const;

    const FlowMatrix                &exact;
    const NodeBlockMatrix           &system;
    const BlockPreconditioner       &preconditioner;
    std::vector<NodeBlockVector>     basis, directions; // Q, Z
    std::vector<std::vector<double>> triangle;          // R by column
    unsigned int                     n_basis = 0;
    std::vector<double>              share; // of each basis vector that x lacks
    std::vector<double>              sums;  // of these over the continuity equation
    NodeBlockVector                  residual, sum;
    double                           left  = 0.; // size of the residual
    double                           scale = 0.; // what the exact one is divided by
    BlockVector                      exact_residual;
  };
} // namespace graupel

#endif
