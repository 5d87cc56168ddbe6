// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_filter_h
#define graupel_coupling_filter_h

#include <graupel/mesh/nodal_space.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <map>

namespace graupel
{
  /**
   * The filter that spreads what particles carry over a physical length l: the
   * solution of the diffusion equation at the time l^2,
   *
   *   S = exp(-l^2 L),   L = M^-1 K,
   *
   * with M the diagonal matrix of the nodes' volumes and K the stiffness matrix
   * of their basis functions with natural boundary conditions, so that walls
   * need no special case. Its kernel is the Gaussian of standard deviation
   * sqrt(2) l. S keeps constants and is self-adjoint in M; with l = 0 it is the
   * identity.
   *
   * The exponential is a polynomial in L (a Chebyshev series cut at 1e-6), which
   * has these properties exactly. One implicit step, (M + l^2 K)^-1 M, would have
   * them too, but its kernel exp(-r/l) / (4 pi l^2 r) is singular: the void
   * fraction at the center of a particle would fall without limit as the mesh is
   * refined.
   * Source: diffusion as filter: Capecelatro & Desjardins (2013),
   * doi:10.1016/j.jcp.2012.12.015.
   */
  class Filter
  {
  public:
    /** @p length l >= 0 [m]; @p nodes must outlive the filter. */
    Filter(const NodalSpace &nodes, const double length);

    /**
     * x = S M^-1 b for sums b over particles (W^T of something): their density.
     * The sum of M x equals the sum of b to round-off. Ghosts of @p x are up to
     * date afterwards. Collective.
     */
    void spread(NodalVector &x, const NodalVector &b) const;

    /** x = S f, with the same remarks. */
    void smooth(NodalVector &x, const NodalVector &f) const;

    /** The same for several fields, in place: together they cost hardly more than one,
     * as K goes through the memory once. */
    void spread(const std::vector<NodalVector *> &fields) const;
    void smooth(const std::vector<NodalVector *> &fields) const;

    /** Products with K that one application costs. */
    unsigned int
    degree() const
    {
      return repetitions * (coefficients.size() - 1);
    }

  private:
    // Several fields node by node.
    using Fields = dealii::LinearAlgebra::distributed::Vector<double>;
    static constexpr unsigned int most_at_once = 4;

    void assemble();
    void take_rows(const dealii::TrilinosWrappers::SparseMatrix &stiffness);
    void find_polynomial();
    template <unsigned int width>
    void apply(const std::vector<NodalVector *> &fields) const;
    // before = factor (2 / lambda_max M^-1 K - 1) now - (factor - 1) before, a further
    // term of the series, which is added to the sum.
    template <unsigned int width>
    void add_term(Fields       &before,
                  const Fields &now,
                  Fields       &sum,
                  const double  factor,
                  const double  coefficient) const;

    const NodalSpace &nodes;
    const double      length; // [m]

    // K by its own rows, and who has the values of its columns, by how many there are of
    // a node: one or most_at_once.
    std::vector<unsigned int> starts, columns;
    std::vector<double>       values;
    std::map<unsigned int, std::shared_ptr<const dealii::Utilities::MPI::Partitioner>>
      partitioners;

    NodalVector         inverse_measure;
    double              largest_eigenvalue = 0.; // an upper bound [1/m^2]
    std::vector<double> coefficients;            // of the Chebyshev series
    unsigned int        repetitions = 1;
  };
} // namespace graupel

#endif
