#ifndef graupel_fluid_node_blocks_h
#define graupel_fluid_node_blocks_h

#include <deal.II/lac/la_parallel_block_vector.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_block_sparse_matrix.h>

#include <experimental/simd>

namespace graupel
{
  using BlockVector = dealii::LinearAlgebra::distributed::BlockVector<double>;

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
   * The flow's linear system [A G; D C] as blocks of 4 x 4 by pairs of nodes, in single
   * precision: a third of the bytes of the original in double precision by single
   * unknowns, and bytes are what a product costs.
   */
  class NodeBlockMatrix
  {
  public:
    /** Blocks and nodes of @p original, all 0. Collective. */
    explicit NodeBlockMatrix(const dealii::TrilinosWrappers::BlockSparseMatrix &original);

    /** Takes the values of @p original, which has the pattern of the first one. */
    void take(const dealii::TrilinosWrappers::BlockSparseMatrix &original);

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

    unsigned int
    n_rows() const
    {
      return row_starts.size() - 1;
    }

    /** Where the blocks of a row begin; those of the last row end at n_rows(). */
    const std::vector<unsigned int> &
    rows() const
    {
      return row_starts;
    }

    /** The local node of each block's columns; from n_rows() on they are ghosts. Own ones
     * are ascending in a row. */
    const std::vector<unsigned int> &
    columns() const
    {
      return column_nodes;
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
    // Which unknown of which local node a column of one of the four matrices is.
    struct Column
    {
      unsigned int node, unknown;
    };

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    std::array<std::array<std::vector<Column>, 2>, 2>          of_column;
    std::vector<unsigned int>                                  row_starts, column_nodes;
    // By block, each column of it by itself: three of the flux, and the pressure's.
    std::vector<float> flux_columns, pressure_columns;
  };
} // namespace graupel

#endif
