// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_cylinder_h
#define graupel_mesh_cylinder_h

#include <deal.II/base/parameter_handler.h>

namespace graupel
{
  /** The vessel: a circular cylinder that stands on z = 0, its axis along z. */
  struct Cylinder
  {
    /** Inner diameter [m]. */
    double diameter = 0.025;
    /** Height from the bottom (z = 0) to the top [m]. */
    double height = 0.169;

    /** Area of the circle [m^2]. */
    double cross_section() const;

    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError unless both lengths are positive. */
    void check() const;
  };
} // namespace graupel

#endif
