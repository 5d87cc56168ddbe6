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

    /** Takes the values that the original has now. */
    void take();

    /** Makes @p vector a zero vector, with room for ghosts. */
    void initialize(NodeBlockVector &vector) const;

    /** dst = [A G; D C] src. Collective. */
    void vmult(NodeBlockVector &dst, const NodeBlockVector &src) const;

    /** The flux of @p dst becomes that of @p src minus G p, with p the pressure of dst.
     * Collective. */
    void subtract_gradient(NodeBlockVector &dst, const NodeBlockVector &src) const;

    /** @p dst = @p src / @p size of the own unknowns, and dst += size * src. */
    void to_nodes(NodeBlockVector &dst, const BlockVector &src, const double size) const;
    void add_to(BlockVector &dst, const NodeBlockVector &src, const double size) const;

    /** FlowMatrix::n_rows(), FlowMatrix::rows() and FlowMatrix::columns(). */
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
    std::vector<float> flux_columns, pressure_columns;
  };
} // namespace graupel

#endif
