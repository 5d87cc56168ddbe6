// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_boundary_parameters_h
#define graupel_fluid_boundary_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/types.h>

#include <map>
#include <string>
#include <vector>

namespace graupel
{
  /** What holds on one boundary of the fluid. */
  struct BoundaryCondition
  {
    enum Kind
    {
      /** The superficial velocity of the flow case, evenly over the boundary. */
      plug,
      /** The same as a mean over a circular boundary, in Poiseuille's profile. */
      parabolic,
      /** Flux q by three expressions [m/s]. */
      velocity,
      /** Plug flow from an expression of the mass flow [kg/s]. */
      mass_flow_rate,
      /** Pressure by an expression [Pa]; the fluid may leave and come back. */
      pressure,
      slip,
      no_slip
    };

    Kind kind = slip;
    /** Expressions of x, y, z [m], t [s] and V, the superficial velocity [m/s]. */
    std::vector<std::string> expressions;

    /** Whether the flux is prescribed, and not zero. */
    bool
    is_inlet() const
    {
      return kind <= mass_flow_rate;
    }

    /**
     * Reads "plug", "parabolic", "velocity A; B; C", "mass flow rate A",
     * "pressure A", "slip" or "no-slip". Throws InputError(@p parameter, ...).
     */
    static BoundaryCondition read(const std::string &text, const std::string &parameter);
  };

  /** The boundary conditions of the fluid, by the boundary's name. */
  struct BoundaryParameters
  {
    std::string bottom = "plug";
    std::string top    = "pressure 0";
    std::string wall   = "slip";
    /** Further boundaries of a mesh from a file: "name = condition", by bars. */
    std::string others;
    /** Whether inlets let the fluid in where the voids are. */
    bool weigh_inlets = false;

    /** Declares the section "Boundary conditions". */
    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError where a condition cannot be read, or fluid enters and no
     * boundary can let it out. A vessel without inlets may be closed. */
    void check() const;

    /** By name. */
    std::map<std::string, BoundaryCondition> conditions() const;

    /**
     * By id, for the boundaries of a mesh by name: what has no condition of its own is as
     * the wall. Throws InputError for the condition of a boundary that the mesh does not
     * have, and as check() for those that it has.
     */
    std::map<dealii::types::boundary_id, BoundaryCondition> by_id(
      const std::map<std::string, dealii::types::boundary_id> &boundaries) const;
  };
} // namespace graupel

#endif
