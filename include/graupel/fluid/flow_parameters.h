#ifndef graupel_fluid_flow_parameters_h
#define graupel_fluid_flow_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace graupel
{
  /** How the flow equations are discretised and solved. */
  struct FlowParameters
  {
    /** "slip" or "no-slip" at the lateral wall. */
    std::string wall = "slip";
    /** "bdf1" or "bdf2". */
    std::string time_scheme = "bdf1";
    /** Factor of the grad-div term [-]. */
    double grad_div = 1.;
    /** Residual of the linear system relative to its right-hand side [-]. */
    double linear_tolerance = 1e-8;
    /** Mass imbalance of a step relative to the inflow [-]. */
    double mass_tolerance = 1e-9;
    /** Iterations after which a solve has failed [-]. */
    unsigned int maximum_iterations = 500;

    /** Declares the section "Flow solver". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };
} // namespace graupel

#endif
