// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_pressure_matrix_h
#define graupel_fluid_pressure_matrix_h

#include <graupel/fluid/flow_space.h>

#include <deal.II/lac/full_matrix.h>

namespace graupel
{
  /**
   * A matrix of one unknown a node that is assembled cell by cell, again and again, and
   * that Trilinos' multigrid takes. Where the entries of a cell lie is looked up once, as
   * Trilinos would for each of them each time; cells with nodes that hang or that belong
   * to other ranks leave it to deal.II.
   */
  class PressureMatrix
  {
  public:
    /** Of a cell, by node of the row and of the column. */
    using CellMatrix = std::array<std::array<double, nodes_per_cell>, nodes_per_cell>;

    /** All 0. @p space must outlive this object. Collective. */
    explicit PressureMatrix(const FlowSpace &space);

    /** Makes all entries 0. Collective. */
    void clear();

    /** Adds what the owned cell @p cell has. */
    void add(const unsigned int cell, const CellMatrix &entries);

    /** Sends home what was added to rows of other ranks. Collective. */
    void compress();

    const dealii::TrilinosWrappers::SparseMatrix &
    trilinos() const
    {
      return matrix;
    }

  private:
    // Among the values of the own rows, by node of the row, then of the column.
    using Places = std::array<unsigned int, nodes_per_cell * nodes_per_cell>;

    void find_places(const unsigned int cell);

    const FlowSpace                       &space;
    dealii::TrilinosWrappers::SparseMatrix matrix;
    double                                *values = nullptr; // of the own rows
    // By cell: its number among those whose places are known, or invalid_unsigned_int.
    std::vector<unsigned int> number;
    std::vector<Places>       places;
  };
} // namespace graupel

#endif
