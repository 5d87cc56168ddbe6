// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_kernel_h
#define graupel_fluid_flow_kernel_h

#include <deal.II/base/tensor.h>

#include <array>
#include <experimental/simd>

/**
 * The volume-averaged Navier-Stokes equations in a cell. Unknowns: the
 * volumetric flux q = alpha u and the pressure p, without its hydrostatic part,
 *
 *   rho dq/dt + rho div(q q / alpha) = -w grad p + div(alpha tau(u)) - (B u - C) + f
 *   div (q + q_s) = -d(alpha)/dt + s,
 *
 * with u = q / alpha node by node, w = alpha where both phases share the pressure
 * gradient (model A) and 1 where the fluid has all of it (model B), B [kg/m^3/s] the drag
 * coefficient and C [N/m^3] the drag that the particles' own velocity takes back, with
 * further sources of momentum, and s a source of volume [1/s]. The nodal drag itself is
 * diagonal and added by the solver; here it enters the residual of the stabilisation.
 */
namespace graupel
{
  constexpr unsigned int nodes_per_cell    = 8;
  constexpr unsigned int points_per_cell   = 8;
  constexpr unsigned int unknowns_per_node = 4;

  /** A number for each node of a cell, or for each of its quadrature points, as one
   * operand of the processor's vector instructions. */
  using EightLanes =
    std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 8>>;

  /** The same in memory. */
  using Eight = std::array<double, 8>;

  /** Eight vectors, by component. */
  using EightVectors = std::array<Eight, 3>;

  /** Constants of one assembly. */
  struct FlowCoefficients
  {
    /** Density [kg/m^3]. */
    double density;
    /** Dynamic viscosity [Pa s]. */
    double viscosity;
    /** Weight of the new flux in dq/dt [1/s]. */
    double rate;
    /** The same of the unresolved flux [1/s]. */
    double subscale_rate;
    /** Factor of the grad-div term [-]. */
    double grad_div;
    /** The fastest interstitial speed in the vessel [m/s]. */
    double speed;
  };

  /** What the nodes of one cell know, old flux (lagged) included. */
  struct CellState
  {
    /** Cube root of the cell's volume [m]. */
    double size;
    /** Whether the solver adds the drag node by node. */
    bool drag_on_nodes = false;
    /** Whether the equation has div tau instead of div(alpha tau). */
    bool  whole_stress = false;
    Eight void_fraction;
    /** B / alpha, the resistance to the flux [kg/m^3/s]. */
    Eight resistance;
    /** w, the share of the pressure gradient that acts on the fluid [-]. */
    Eight pressure_share;
    /** d(alpha)/dt - s [1/s]. */
    Eight void_fraction_rate;
    /** q_s, the flux of solids that answer to the fluid: a part that does not [m/s], */
    EightVectors solid_flux{};
    /** the factor of q [-], */
    Eight solids_by_flux{};
    /** and the one of -grad p [m^3 s/kg]. */
    Eight solids_by_gradient{};
    /** The flux that carries momentum: known from earlier [m/s]. */
    EightVectors flux;
    /** The known part of dq/dt [m/s^2]. */
    EightVectors history;
    /** C [N/m^3]. */
    EightVectors drag_source;
    /** f [N/m^3]. */
    EightVectors force;
  };

  /** Basis functions at one quadrature point. */
  struct ShapePoint
  {
    /** Weight, with the Jacobian [m^3]. */
    double weight;
    /** By node. */
    Eight value;
    /** By component and node [1/m]. */
    EightVectors gradient;

    /** Of the basis function of a node. */
    dealii::Tensor<1, 3>
    gradient_of(const unsigned int node) const
    {
      return dealii::Tensor<1, 3>(
        {gradient[0][node], gradient[1][node], gradient[2][node]});
    }
  };

  /** The quadrature points of a cell. */
  using ShapePoints = std::array<ShapePoint, points_per_cell>;

  /** The linear system of a cell. Unknown number 4 a + c is component c (three of q, then
   * p) at node a. */
  struct CellSystem
  {
    /** By node and component of the row, then by component and node of the column. */
    std::array<std::array<std::array<Eight, unknowns_per_node>, unknowns_per_node>,
               nodes_per_cell>
      matrix{};
    /** By component and node. */
    std::array<Eight, unknowns_per_node> rhs{};

    double &
    operator()(const unsigned int row, const unsigned int column)
    {
      return matrix[row / unknowns_per_node][row % unknowns_per_node]
                   [column % unknowns_per_node][column / unknowns_per_node];
    }

    double &
    right(const unsigned int row)
    {
      return rhs[row % unknowns_per_node][row / unknowns_per_node];
    }
  };

  /**
   * The linear system of a cell with these @p points.
   *
   * The stabilisation has the time scale of the subscales over density [m^3 s/kg],
   *
   *   1/tau = rho rate + [R^2 + (2 rho U / h)^2 + (12 mu / h^2)^2]^(1/2),
   *
   * with R = B / alpha and U the fastest speed in the vessel. U instead of the local
   * speed keeps tau from exceeding any useful time step where the fluid is slow, which
   * would spoil the linear system.
   * Source: Tezduyar & Osawa (2000), doi:10.1016/S0045-7825(00)00211-5, with the drag
   * as reaction.
   *
   * It follows the flux q' that the mesh does not resolve in time,
   *
   *   rho dq'/dt + q'/tau_0 = -residual of the momentum equation,
   *
   * with tau_0 the time scale at rate 0, and @p subscale_history the known part of dq'/dt
   * by component and point [m/s^2]: the steady state has no time step in it, and small
   * steps stay stable.
   * Source: Codina, Principe, Guasch & Badia (2007), doi:10.1016/j.cma.2006.07.015.
   */
  void assemble_flow(const FlowCoefficients &coefficients,
                     const CellState        &state,
                     const ShapePoints      &points,
                     const EightVectors     &subscale_history,
                     CellSystem             &system);

  /** q' by component and point at the end of a step, whose flux @p state has and whose
   * nodal pressures are @p pressure [Pa] [m/s]. */
  EightVectors unresolved_flux(const FlowCoefficients &coefficients,
                               const CellState        &state,
                               const ShapePoints      &points,
                               const EightVectors     &subscale_history,
                               const Eight            &pressure);
} // namespace graupel

#endif
