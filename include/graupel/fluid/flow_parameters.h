// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_parameters_h
#define graupel_fluid_flow_parameters_h

#include <graupel/fluid/boundary_parameters.h>

namespace graupel
{
  /** How the flow equations are discretised and solved. */
  struct FlowParameters
  {
    BoundaryParameters boundaries;
    /** "bdf1" or "bdf2". */
    std::string time_scheme = "bdf1";
    /** Factor of the grad-div term [-]. */
    double grad_div = 1.;
    /** Residual of the linear system relative to its right-hand side [-]. */
    double linear_tolerance = 1e-8;
    /** Mass imbalance of a step relative to FlowSolver::Report::flow_scale [-]. */
    double mass_tolerance = 1e-9;
    /** Iterations after which a solve has failed [-]. */
    unsigned int maximum_iterations = 500;

    /** Linear systems a step until convection is converged, at most [-]. */
    unsigned int nonlinear_iterations = 1;
    /** Change of the flux at which it is [-]. */
    double nonlinear_tolerance = 1e-6;

    /** Declares the sections "Boundary conditions" and "Flow solver". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };
} // namespace graupel

#endif
