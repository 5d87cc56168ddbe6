// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_symbolic_flow_h
#define graupel_fluid_symbolic_flow_h

#include <array>
#include <string>

namespace graupel
{
  /** Expressions of x, y, z, t; functions as muParser and GiNaC both know them. */
  using VectorExpression = std::array<std::string, 3>;

  /** A flow that is given, by expressions. */
  struct GivenFlow
  {
    std::string      void_fraction;     // alpha [-]
    VectorExpression velocity;          // u [m/s]
    std::string      pressure;          // p [Pa]
    std::string      drag;              // B [kg/m^3/s]
    VectorExpression particle_velocity; // v [m/s]
  };

  /** What must act for the given flow to solve the equations. */
  struct NeededSources
  {
    VectorExpression flux;          // q = alpha u [m/s]
    VectorExpression drag_source;   // C = B v [N/m^3]
    VectorExpression force;         // f [N/m^3]
    std::string      volume_source; // s [1/s]
    VectorExpression top_traction;  // alpha tau e_z [Pa]
  };

  /**
   * Derives the sources symbolically (GiNaC) from the equations of flow_kernel.h
   * in model A:
   *
   *   f = rho dq/dt + rho div(q u) + alpha grad p - div(alpha tau) + B (u - v),
   *   s = d(alpha)/dt + div q,
   *
   * with @p density [kg/m^3] and @p viscosity [Pa s]. Throws std::runtime_error with
   * the reason where an expression cannot be read or differentiated.
   */
  NeededSources derive_sources(const GivenFlow &flow,
                               const double     density,
                               const double     viscosity);
} // namespace graupel

#endif
