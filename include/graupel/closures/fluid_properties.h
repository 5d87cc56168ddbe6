// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_closures_fluid_properties_h
#define graupel_closures_fluid_properties_h

#include <deal.II/base/parameter_handler.h>

namespace graupel
{
  /** The gas or liquid: constant density and viscosity. The defaults are air. */
  struct FluidProperties
  {
    /** Density [kg/m^3]. */
    double density = 1.18415;
    /** Dynamic viscosity [Pa s]. */
    double viscosity = 1.85508e-5;

    /** Declares the section "Fluid". */
    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError unless both are positive. */
    void check() const;
  };
} // namespace graupel

#endif
