// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_manufactured_solution_h
#define graupel_fluid_manufactured_solution_h

#include <graupel/fluid/flow_solver.h>
#include <graupel/fluid/symbolic_flow.h>

namespace graupel
{
  /** A flow that is given by expressions, to measure the solver's error with. */
  struct ManufacturedParameters
  {
    /** Expressions of x, y, z [m] and t [s]; a vector is three, by semicolons. */
    std::string void_fraction     = "1";
    std::string velocity          = {}; // empty: no manufactured solution
    std::string pressure          = "0";
    std::string drag              = "0";
    std::string particle_velocity = "0; 0; 0";
    /** f and s; empty: derived. */
    std::string force         = {};
    std::string volume_source = {};
    /** Simulated time; 0: the steady state [s]. */
    double duration = 0.;

    bool
    is_given() const
    {
      return !velocity.empty();
    }

    /** Declares the section "Manufactured solution". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };

  /** Errors of a computed flow against the given one: L2 norms over the vessel,
   * relative to the given field's. */
  struct FlowErrors
  {
    /** Of q and p [-]. */
    double flux = 0., pressure = 0.;
    /** Linear systems that were solved [-]. */
    unsigned int solves = 0;
  };

  /**
   * A manufactured flow in a vessel: flux prescribed on bottom and wall, pressure
   * (with the viscous traction) at the top, sources derived or given.
   */
  class ManufacturedSolution
  {
  public:
    /** Throws InputError where an expression cannot be read or differentiated. */
    ManufacturedSolution(const ManufacturedParameters &parameters,
                         const double                  density,
                         const double                  viscosity);

    /** The solver's parameters with the boundary conditions of this flow. */
    FlowParameters with_boundaries(FlowParameters parameters) const;

    /** Sets flux, pressure and void fraction of @p flow to those at the time 0. */
    void start(FlowSolver &flow, const NodalSpace &nodes) const;

    /** Void fraction, drag and sources at @p time [s] into @p medium, and the
     * traction at the top into @p flow. */
    void set(Medium           &medium,
             FlowSolver       &flow,
             const NodalSpace &nodes,
             const double      time) const;

    /** Errors of @p flow at @p time [s], by a quadrature finer than the solver's.
     * Collective. */
    FlowErrors errors(const FlowSolver &flow,
                      const NodalSpace &nodes,
                      const double      time) const;

    /**
     * Computes the flow in @p flow, whose parameters are of with_boundaries(), from the
     * time 0 on through the duration in steps of @p step [s], or where the duration is
     * 0 the steady state. Collective.
     */
    FlowErrors run(FlowSolver &flow, const NodalSpace &nodes, const double step) const;

  private:
    // Numbers of the expressions in the function.
    enum Field : unsigned int
    {
      alpha,
      q,
      p             = q + 3,
      drag          = p + 1,
      drag_source   = drag + 1,
      force         = drag_source + 3,
      volume_source = force + 3,
      traction      = volume_source + 1,
      n_fields      = traction + 3
    };

    void evaluate(NodalVector       &vector,
                  const NodalSpace  &nodes,
                  const unsigned int field,
                  const double       time) const;

    const double                      duration;
    std::vector<std::string>          expressions;
    mutable dealii::FunctionParser<3> function; // its time is set at each use
  };
} // namespace graupel

#endif
