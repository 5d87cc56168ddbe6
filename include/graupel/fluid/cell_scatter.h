#ifndef graupel_fluid_cell_scatter_h
#define graupel_fluid_cell_scatter_h

#include <graupel/fluid/block_preconditioner.h>
#include <graupel/fluid/compressed_rows.h>
#include <graupel/fluid/flow_space.h>

#include <deal.II/lac/affine_constraints.h>

namespace graupel
{
  /**
   * Adds the linear systems of cells to the flow's. Where all nodes of a cell are
   * this rank's and none hangs, the places of its entries in the sparse matrix
   * are looked up once and for all, and its constraints condensed here; other
   * cells go through dealii::AffineConstraints.
   */
  class CellScatter
  {
  public:
    /**
     * @p space, @p constraints and @p matrix must outlive this object; which
     * unknowns are constrained, and by which others, must not change, nor must the
     * matrix's sparsity. Inhomogeneities may.
     */
    CellScatter(const FlowSpace                             &space,
                const dealii::AffineConstraints<double>     &constraints,
                dealii::TrilinosWrappers::BlockSparseMatrix &matrix);

    /** Adds the @p system of the owned cell @p cell, and leaves 0 in it. */
    void add(const unsigned int cell, CellSystem &system, BlockVector &rhs) const;

  private:
    static constexpr unsigned int n_unknowns = nodes_per_cell * unknowns_per_node;

    // An unknown of the cell that others of the cell determine.
    struct Constrained
    {
      unsigned int                                 unknown;
      std::vector<std::pair<unsigned int, double>> weights;
    };

    // Of an entry in its row: (row, column) of the cell's matrix.
    using Places = std::array<std::array<std::uint16_t, n_unknowns>, n_unknowns>;

    bool find_constrained(const unsigned int cell, std::vector<Constrained> &found) const;
    void find_places(const unsigned int cell, Places &places) const;
    void condense(const unsigned int cell, CellSystem &system) const;
    void add_by_constraints(const unsigned int cell,
                            CellSystem        &system,
                            BlockVector       &rhs) const;

    const FlowSpace                             &space;
    const dealii::AffineConstraints<double>     &constraints;
    dealii::TrilinosWrappers::BlockSparseMatrix &matrix;
    std::array<std::array<CompressedRows, 2>, 2> blocks;
    // By cell: its number among the places, or invalid_unsigned_int.
    std::vector<unsigned int>             direct;
    std::vector<Places>                   places;
    std::vector<std::vector<Constrained>> constrained; // as places
  };
} // namespace graupel

#endif
