// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/exchange.h>

namespace graupel
{
  void
  Exchange::find_added_forces(const ParticleArrays &particles)
  {
    if (added)
      added->evaluate(particles, transfer, felt_velocity, law_alpha, response.step);
  }

  double
  Exchange::inertia(const unsigned int row) const
  {
    return added ? added->inertia()[row] : 0.;
  }

  dealii::Tensor<1, 3>
  Exchange::added_force(const unsigned int          row,
                        const dealii::Tensor<1, 3> &velocity) const
  {
    return inertia(row) * (velocity - added->carried()[row] - response.velocity[row]) +
           added->known()[row];
  }

  void
  Exchange::add_forces()
  {
    if (!added)
      return;
    add_known_forces();
    if (result.solids)
      add_virtual_mass();
  }

  void
  Exchange::add_known_forces()
  {
    NodalVector part;
    nodes.initialize(part);
    for (unsigned int i = 0; i < 3; ++i)
      {
        spread(part, [&](const unsigned int row) {
          return answer[row] *
                 (added->known()[row][i] - inertia(row) * response.velocity[row][i]);
        });
        result.drag_source[i] -= part;
        nodes.distribute(result.drag_source[i]);
        if (!result.solids)
          continue;
        spread(part, [&](const unsigned int row) {
          return volume[row] * response.mobility[row] * answer[row] *
                 added->known()[row][i];
        });
        result.solids->flux[i] += part;
        nodes.distribute(result.solids->flux[i]);
      }
  }

  void
  Exchange::add_virtual_mass()
  {
    NodalVector drag, flux;
    for (NodalVector *field : {&drag, &flux})
      nodes.initialize(*field);
    spread(drag, [&](const unsigned int row) { return answer[row] * inertia(row); });
    spread(flux, [&](const unsigned int row) {
      return volume[row] * response.mobility[row] * answer[row] * inertia(row);
    });
    result.drag += drag;
    nodes.distribute(result.drag);
    result.solids->by_velocity += flux;
    nodes.distribute(result.solids->by_velocity);
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int k = 0; k < drag.locally_owned_size(); ++k)
          {
            const double e = added->carried(interstitial[i].local_element(k), i, k);
            result.drag_source[i].local_element(k) += drag.local_element(k) * e;
            result.solids->flux[i].local_element(k) -= flux.local_element(k) * e;
          }
        nodes.distribute(result.drag_source[i]);
        nodes.distribute(result.solids->flux[i]);
      }
  }

  std::vector<dealii::Tensor<1, 3>>
  Exchange::torques(const ParticleArrays &particles, const double step) const
  {
    return added ? added->torques(particles, transfer, step)
                 : std::vector<dealii::Tensor<1, 3>>(particles.n_owned);
  }
} // namespace graupel
