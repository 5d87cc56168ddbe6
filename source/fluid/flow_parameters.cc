// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/fluid/flow_parameters.h>

namespace graupel
{
  void
  FlowParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Selection;
    boundaries.declare(prm);
    prm.enter_subsection("Flow solver");
    prm.add_parameter(
      "time scheme",
      time_scheme,
      "Backward differentiation of first order (bdf1) or second order (bdf2), "
      "with variable steps.",
      Selection("bdf1|bdf2"));
    prm.add_parameter(
      "grad-div factor",
      grad_div,
      "Weight of the penalty on the error of the continuity equation, in units "
      "of density times speed times cell size; without it large time steps are "
      "unstable [-].");
    prm.add_parameter(
      "linear tolerance",
      linear_tolerance,
      "Residual at which a linear solve ends, relative to the right-hand side [-].");
    prm.add_parameter(
      "mass tolerance",
      mass_tolerance,
      "Largest mass imbalance of a step (in minus out minus stored) relative to the "
      "flow, "
      "which is the largest of what crosses inlets and outlets, what is stored, and the "
      "fastest flux times the section; the linear solve goes on until it holds [-].");
    prm.add_parameter("maximum iterations",
                      maximum_iterations,
                      "Iterations after which a linear solve is given up [-].");
    prm.add_parameter(
      "nonlinear iterations",
      nonlinear_iterations,
      "How often a step may repeat its linear system until the convection in it no "
      "longer "
      "changes; a step that does not get there has failed. 1: convection is linearised "
      "about the flux known from the steps before, without a check [-].");
    prm.add_parameter("nonlinear tolerance",
                      nonlinear_tolerance,
                      "Relative change of the flux at which these end [-].");
    prm.leave_subsection();
  }

  void
  FlowParameters::check() const
  {
    boundaries.check();
    require(grad_div >= 0.,
            "Flow solver/grad-div factor",
            "a negative penalty amplifies errors; choose 0.5 to 3");
    require(linear_tolerance > 0. && linear_tolerance < 1e-2,
            "Flow solver/linear tolerance",
            "the tolerance must lie between 0 and 0.01; 1e-8 is usual");
    require(mass_tolerance > 0. && mass_tolerance < 1e-2,
            "Flow solver/mass tolerance",
            "the tolerance must lie between 0 and 0.01; 1e-9 is usual");
    require(nonlinear_iterations >= 1,
            "Flow solver/nonlinear iterations",
            "must be at least 1");
    require(nonlinear_tolerance > 0.,
            "Flow solver/nonlinear tolerance",
            "must be positive; 1e-6 is usual");
    require(
      maximum_iterations >= 1, "Flow solver/maximum iterations", "must be at least 1");
  }
} // namespace graupel
