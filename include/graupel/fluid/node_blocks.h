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

  /** One of the unknowns, or one equation, of each node, in single precision. */
  using NodeValues = dealii::LinearAlgebra::distributed::Vector<float>;

  /** The four unknowns of a node: three components of the flux, the pressure. */
  using NodeUnknowns =
    std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 4>>;

  /** The unknowns of the local node @p node. */
  inline NodeUnknowns
  unknowns_of(const float *const values, const unsigned int node)
  {
    return NodeUnknowns(values + std::size_t{4} * node,
                        std::experimental::element_aligned);
  }

  /** Sum of the products of @p length entries with the values of their columns. */
  inline float
  row_product(const float *const        entries,
              const unsigned int *const columns,
              const float *const        values,
              const unsigned int        length)
  {
    // In four parts side by side, as the processor can begin the next before the last
    // ends.
    float        part[4]{};
    unsigned int k = 0;
    for (; k + 4 <= length; k += 4)
      for (unsigned int i = 0; i < 4; ++i)
        part[i] += entries[k + i] * values[columns[k + i]];
    for (; k < length; ++k)
      part[0] += entries[k] * values[columns[k]];
    return (part[0] + part[1]) + (part[2] + part[3]);
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

    /** Makes @p vector a zero vector of all unknowns. */
    void initialize(NodeBlockVector &vector) const;

    /** Makes @p values a zero vector with room for ghosts. */
    void initialize_values(NodeValues &values) const;

    /** The product with a vector, unknown by unknown: @p product becomes what @p unknown
     * (0 to 2 a component of the flux, 3 the pressure) with the values @p x makes, or
     * gains it. Between them the preconditioner finds the next. Collective. */
    void multiply(NodeBlockVector   &product,
                  const NodeValues  &x,
                  const unsigned int unknown) const;
    void add_product(NodeBlockVector   &product,
                     const NodeValues  &x,
                     const unsigned int unknown) const;

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
      return NodeUnknowns([&](const auto i) {
        return i < 3 ? blocks[i % 3][4 * static_cast<std::size_t>(block) + i] : 0.f;
      });
    }

  private:
    // Adds to what begin(row) is.
    template <typename Begin>
    void add_column(NodeBlockVector   &product,
                    const NodeValues  &x,
                    const unsigned int unknown,
                    const Begin       &begin) const;

    const FlowMatrix                                          &original;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    // By unknown: its column of each block.
    std::array<std::vector<float>, 4> blocks;
    std::array<double, 2>             continuity_norms{};
  };
} // namespace graupel

#endif
