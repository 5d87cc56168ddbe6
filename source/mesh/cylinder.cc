// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/base/numbers.h>

namespace graupel
{
  double
  Cylinder::cross_section() const
  {
    return dealii::numbers::PI * diameter * diameter / 4.;
  }

  void
  Cylinder::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Geometry");
    prm.add_parameter("diameter", diameter, "Inner diameter of the cylinder [m].");
    prm.add_parameter(
      "height", height, "Height of the cylinder, from its bottom to its top [m].");
    prm.leave_subsection();
  }

  void
  Cylinder::check() const
  {
    require(diameter > 0.,
            "Geometry/diameter",
            "a vessel needs a positive diameter, in metres");
    require(
      height > 0., "Geometry/height", "a vessel needs a positive height, in metres");
  }
} // namespace graupel
