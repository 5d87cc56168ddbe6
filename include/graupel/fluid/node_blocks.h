// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_node_blocks_h
#define graupel_fluid_node_blocks_h

#include <graupel/fluid/flow_matrix.h>

#include <experimental/simd>

namespace graupel
{
  /** Flux and pressure with the four unknowns of a node side by side, in single
   * precision. */
  using NodeBlockVector = dealii::LinearAlgebra::distributed::Vector<float>;

  /** The four unknowns of a node: three components of the flux, the pressure. */
  using NodeUnknowns =
    std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 4>>;

  /** The unknowns of the local node @p node. */
  inline NodeUnknowns
  unknowns_of(const float *const values, const unsigned int node)
  {
    return NodeUnknowns(values + 4 * node, std::experimental::element_aligned);
  }

  /**
   * The flow's linear system [A G; D C] in single precision: half of the bytes, and bytes
   * are what a product costs.
   */
  class NodeBlockMatrix
  {
  public:
    /** Of @p original, which must outlive this object; all 0. */
    explicit NodeBlockMatrix(const FlowMatrix &original);

    /** Takes the values that the original has now. Collective. */
    void take();

    /** Makes @p vector a zero vector, with room for ghosts. */
    void initialize(NodeBlockVector &vector) const;

    /** The product with @p x in two parts: @p product = [G; C] p, and product += [A; D]
     * q. Between them the preconditioner finds q. Collective. */
    void multiply_pressure(NodeBlockVector &product, const NodeBlockVector &x) const;
    void add_flux_product(NodeBlockVector &product, const NodeBlockVector &x) const;

    /** @p dst = @p src / @p size of the own unknowns, and dst += size * src. */
    void to_nodes(NodeBlockVector &dst, const BlockVector &src, const double size) const;
    void add_to(BlockVector &dst, const NodeBlockVector &src, const double size) const;

    /** |D| and |C| in the norm of the largest sum over a row, of the last take(). */
    double
    divergence_norm() const
    {
      return continuity_norms[0];
    }
    double
    pressure_norm() const
    {
      return continuity_norms[1];
    }

    /** FlowMatrix::n_rows(), FlowMatrix::rows(), FlowMatrix::columns() and
     * FlowMatrix::partitioner(). */
    unsigned int
    n_rows() const
    {
      return original.n_rows();
    }
    const std::vector<unsigned int> &
    rows() const
    {
      return original.rows();
    }
    const std::vector<unsigned int> &
    columns() const
    {
      return original.columns();
    }
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    nodes() const
    {
      return original.partitioner();
    }

    /** Diagonal entries of a block of A; the last is 0. */
    NodeUnknowns
    flux_diagonal(const unsigned int block) const
    {
      const float *const values = &flux_columns[12 * block];
      return NodeUnknowns(
        [&](const auto i) { return i < 3 ? values[5 * (i % 3)] : 0.f; });
    }

  private:
    const FlowMatrix                                          &original;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    // By block, each column of it by itself: three of the flux, and the pressure's.
    std::vector<float>    flux_columns, pressure_columns;
    std::array<double, 2> continuity_norms{};
  };
} // namespace graupel

#endif
