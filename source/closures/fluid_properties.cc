// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/closures/fluid_properties.h>

namespace graupel
{
  void
  FluidProperties::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Fluid");
    prm.add_parameter("density", density, "Density of the fluid [kg/m^3].");
    prm.add_parameter("viscosity", viscosity, "Dynamic viscosity of the fluid [Pa s].");
    prm.leave_subsection();
  }

  void
  FluidProperties::check() const
  {
    require(density > 0. && std::isfinite(density),
            "Fluid/density",
            "a fluid has a positive density, in kg/m^3 (air: 1.18)");
    require(viscosity > 0. && std::isfinite(viscosity),
            "Fluid/viscosity",
            "drag laws need a positive viscosity, in Pa s (air: 1.86e-5)");
  }
} // namespace graupel
