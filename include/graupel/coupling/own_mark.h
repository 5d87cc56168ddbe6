// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_own_mark_h
#define graupel_coupling_own_mark_h

#include <deal.II/base/point.h>

#include <array>

namespace graupel
{
  /**
   * What a particle that is deposited on the nodes, filtered so many times (Filter) and
   * sampled again finds of itself, a unit of it. Exact on a lattice, where the filter is
   * a product of exponentials of the second difference: the density
   *
   *   product over i of (K_0 - 2 x (1 - x) (K_0 - K_1)) / h,  K_n = exp(-2 t) I_n(2 t),
   *
   * with the edges h of its cell, its place x along them, t = times l^2 / h^2 and
   * Bessel's functions I_n. These belong to the cell: one mark serves all particles in
   * it.
   */
  class OwnMark
  {
  public:
    /** Of a filter of @p length l [m] that is applied so many @p times, in a cell with
     * edges of the lengths @p edges [m]. */
    OwnMark(const double                 length,
            const unsigned int           times,
            const std::array<double, 3> &edges);

    /** At the place @p x in the unit cell [1/m^3]. */
    double density(const dealii::Point<3> &x) const;

    /** The derivatives by x of the field there [1/m^3]: in that direction the factor is
     * (2 x - 1) (K_0 - K_1) / h. */
    dealii::Tensor<1, 3> slopes(const dealii::Point<3> &x) const;

  private:
    std::array<double, 3> factors(const dealii::Point<3> &x) const;

    std::array<double, 3> here, difference; // K_0 / h, (K_0 - K_1) / h [1/m]
  };
} // namespace graupel

#endif
