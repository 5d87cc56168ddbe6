// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flux_factors_h
#define graupel_fluid_flux_factors_h

#include <graupel/fluid/node_blocks.h>

namespace graupel
{
  /**
   * Incomplete factors LU of the flux's block A without fill-in, of each component by
   * itself: what couples the components is left out, and so are other ranks' nodes.
   * Source: Saad, Iterative Methods for Sparse Linear Systems (2003), ch. 10.
   */
  class FluxFactors
  {
  public:
    void refresh(const NodeBlockMatrix &system);

    /** @p x becomes (LU)^-1 (@p b - @p known) for the component @p component. */
    void solve(NodeValues            &x,
               const NodeBlockVector &b,
               const NodeBlockVector &known,
               const unsigned int     component) const;

  private:
    // A row's blocks: of L, whose diagonal is 1, and of U beyond its diagonal.
    struct Row
    {
      unsigned int begin, diagonal, end;
    };

    // Of all components at once: four numbers an entry.
    void eliminate(const Row                 &row,
                   std::vector<unsigned int> &place,
                   std::vector<float>        &entries) const;

    std::vector<Row>                  rows;
    std::vector<unsigned int>         columns;
    std::array<std::vector<float>, 3> values; // those on the diagonal are inverted
  };
} // namespace graupel

#endif
