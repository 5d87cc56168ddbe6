// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_particle_transfer_h
#define graupel_coupling_particle_transfer_h

#include <graupel/dem/particles/particle_store.h>
#include <graupel/mesh/nodal_space.h>

namespace graupel
{
  /**
   * The weights w_pk = psi_k(x_p) of this rank's particles on the nodes, used
   * both ways: deposit() is W^T, sample() is W.
   */
  class ParticleTransfer
  {
  public:
    /** @p nodes must outlive this object. */
    explicit ParticleTransfer(const NodalSpace &nodes);

    /** Takes over where the particles are, as of the store's last migration. */
    void update(const ParticleStore &store);

    /** W^T v: @p values has a number for each own particle; @p sums is overwritten. */
    void deposit(NodalVector &sums, const std::vector<double> &values) const;

    /** W f at each own particle; the ghosts of @p field must be up to date. */
    std::vector<double>               sample(const NodalVector &field) const;
    std::vector<dealii::Tensor<1, 3>> sample(const NodalVectorField &field) const;

    /** grad f in the cell of each own particle [1/m]. */
    std::vector<dealii::Tensor<1, 3>> sample_gradient(const NodalVector &field) const;

    /** Where a particle is in its cell. */
    struct Place
    {
      /** Which one of edges() is that of the cell. */
      unsigned int cell;
      /** In the unit cell, x [-]. */
      dealii::Point<3> x;
      /** From derivatives by x to the gradient, the inverse transposed Jacobian [1/m]. */
      dealii::Tensor<2, 3> by_x;
    };

    /** By row. */
    const std::vector<Place> &
    places() const
    {
      return place;
    }

    /** Mean lengths of the edges in each direction, by cell with own particles [m]. */
    const std::vector<std::array<double, 3>> &
    edges() const
    {
      return edge;
    }

    /** How far the weights of @p row lie from the particle, sum of w_pk |x_k - x_p|^2
     * [m^2]. */
    double variance(const unsigned int row) const;

  private:
    static constexpr unsigned int n_nodes = dealii::GeometryInfo<3>::vertices_per_cell;

    struct Cell
    {
      unsigned int                                 first_row, end_row;
      std::vector<dealii::types::global_dof_index> nodes;
      std::array<unsigned int, n_nodes>            local_nodes;
    };

    const NodalSpace                        &nodes;
    std::vector<Cell>                        cells;
    std::vector<std::array<double, 3>>       edge;    // by cell
    std::vector<std::array<double, n_nodes>> weights; // by row
    std::vector<Place>                       place;
  };
} // namespace graupel

#endif
