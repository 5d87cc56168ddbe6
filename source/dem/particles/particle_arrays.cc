// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/particle_arrays.h>

#include <deal.II/base/numbers.h>

namespace graupel
{
  void
  ParticleArrays::resize(const unsigned int n_rows)
  {
    id.resize(n_rows);
    type.resize(n_rows);
    body.resize(n_rows);
    mass.resize(n_rows);
    load.resize(n_rows);
    external_force.resize(n_rows);
    external_torque.resize(n_rows);
    solid_fraction.resize(n_rows);
  }

  double
  sphere_volume(const double radius)
  {
    return 4. / 3. * dealii::numbers::PI * radius * radius * radius;
  }
} // namespace graupel
