// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_cell_scatter_h
#define graupel_fluid_cell_scatter_h

#include <graupel/fluid/flow_matrix.h>
#include <graupel/fluid/flow_space.h>

namespace graupel
{
  /**
   * Adds the linear systems of cells to the flow's, with the constraints condensed as
   * dealii::AffineConstraints::distribute_local_to_global() does. The places of a cell's
   * blocks in the matrix, and what its constrained unknowns depend on, are looked up once
   * and for all.
   */
  class CellScatter
  {
  public:
    /**
     * @p space, @p constraints and @p matrix must outlive this object; which unknowns are
     * constrained, and by which others, must not change. Inhomogeneities may.
     */
    CellScatter(const FlowSpace                         &space,
                const dealii::AffineConstraints<double> &constraints,
                FlowMatrix                              &matrix);

    /** Adds the @p system of the owned cell @p cell, which is void then. @p rhs has the
     * unknowns of FlowSpace::owned and FlowSpace::relevant. */
    void add(const unsigned int cell, CellSystem &system, BlockVector &rhs) const;

    /** Adds @p resistance [N s/m] times the flux to the momentum equation of the own node
     * @p node, and @p source [N] to its right side. */
    void add(const unsigned int          node,
             const double                resistance,
             const dealii::Tensor<1, 3> &source,
             BlockVector                &rhs) const;

  private:
    // An unknown that others determine, and these with their weights, by their numbers in
    // the system of some nodes; and its own one in the flow's.
    struct Line
    {
      unsigned int                                 unknown;
      dealii::types::global_dof_index              global;
      std::vector<std::pair<unsigned int, double>> weights;
    };

    // The constraints of some nodes, with the local numbers and the places of these and
    // of all nodes that they depend on.
    struct Constrained
    {
      std::vector<Line>         lines;
      std::vector<unsigned int> nodes, places;
    };

    // Of a block in the matrix: by node of the row, then of the column.
    using Places = std::array<unsigned int, nodes_per_cell * nodes_per_cell>;

    Constrained find_constrained(const unsigned int *const nodes,
                                 const unsigned int        n_nodes) const;

    template <typename System>
    void condense(const std::vector<Line> &lines,
                  const unsigned int       n_unknowns,
                  System                  &system) const;
    template <typename System>
    void scatter(const unsigned int *const nodes,
                 const unsigned int        n_nodes,
                 const unsigned int *const places,
                 System                   &system,
                 BlockVector              &rhs) const;

    const FlowSpace                         &space;
    const dealii::AffineConstraints<double> &constraints;
    FlowMatrix                              &matrix;
    std::vector<Places>                      places; // by cell
    // By cell: its number among those with constraints, or invalid_unsigned_int.
    std::vector<unsigned int> number;
    std::vector<Constrained>  constrained;
  };
} // namespace graupel

#endif
