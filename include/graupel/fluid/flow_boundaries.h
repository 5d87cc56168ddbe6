// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_boundaries_h
#define graupel_fluid_flow_boundaries_h

#include <graupel/fluid/boundary_parameters.h>
#include <graupel/fluid/flow_space.h>

#include <deal.II/base/function_parser.h>

#include <memory>

namespace graupel
{
  /**
   * The boundary conditions on the nodes: which flux and which pressure they
   * prescribe now, and the linear constraints that follow for the flow's
   * unknowns (hanging nodes included).
   *
   * Each inlet keeps the flux that it prescribes itself, which the continuity equation
   * takes: what enters through it is what it says, also where it meets a wall or another
   * inlet. A node that several inlets share has the normal component of each, so far as
   * their normals differ, and the mean of their vectors else.
   */
  class FlowBoundaries
  {
  public:
    /**
     * @p conditions by boundary id; an id without one is slip. @p space must
     * outlive this object.
     */
    FlowBoundaries(
      const std::map<dealii::types::boundary_id, BoundaryCondition> &conditions,
      const bool                                                     weigh_inlets,
      const FlowSpace                                               &space);

    /**
     * Evaluates all conditions at the time @p time [s] for the superficial
     * velocity @p velocity [m/s] of a fluid of @p density [kg/m^3] where
     * @p void_fraction holds (ghosts up to date). Collective.
     */
    void update(const double       time,
                const double       velocity,
                const double       density,
                const NodalVector &void_fraction);

    const dealii::AffineConstraints<double> &
    constraints() const
    {
      return closed;
    }

    /** A boundary whose flux is prescribed. */
    struct Inlet
    {
      dealii::types::boundary_id id;
      /** The flux that this boundary prescribes, at its nodes [m/s]; ghosts up to date.
       */
      NodalVectorField flux;
    };

    const std::vector<Inlet> &
    inlets() const
    {
      return inlet_fluxes;
    }

    /** Flux at the nodes of all inlets, elsewhere 0 [m/s]; ghosts up to date. */
    const NodalVectorField &
    flux() const
    {
      return prescribed_flux;
    }

    /** A boundary whose pressure is prescribed. */
    struct Outlet
    {
      dealii::types::boundary_id id;
      /** The pressure that this boundary prescribes, at its nodes, minus
       * reference_pressure() [Pa]; ghosts up to date. */
      NodalVector pressure;
    };

    const std::vector<Outlet> &
    outlets() const
    {
      return outlet_pressures;
    }

    /** The middle of the prescribed pressures, 0 without: the flow depends on differences
     * to it only [Pa]. */
    double
    reference_pressure() const
    {
      return reference;
    }

    /** What holds on the boundary @p id. */
    BoundaryCondition::Kind kind(const dealii::types::boundary_id id) const;

  private:
    struct Node
    {
      unsigned int                    local;
      dealii::types::global_dof_index global;
      dealii::Point<3>                position;
    };

    struct Boundary
    {
      dealii::types::boundary_id id;
      BoundaryCondition          condition;
      // Without the hanging ones on inlets; on walls, those that no inlet has.
      std::vector<Node>    nodes;
      double               area = 0.;
      dealii::Point<3>     center;
      dealii::Tensor<1, 3> inward; // mean unit normal
      // Poiseuille's profile, and its mean as the mesh has it [-].
      double parabola(const dealii::Point<3> &x) const;
      double parabola_mean = 1.;
    };

    // A node of several inlets: the numbers of these, and their normals there.
    struct SharedNode
    {
      Node                                                       node;
      std::vector<std::pair<unsigned int, dealii::Tensor<1, 3>>> inlets;
    };

    void   find_nodes();
    void   find_shared_nodes();
    void   measure(Boundary &boundary) const;
    void   make_template();
    void   measure_parabola(Boundary &boundary) const;
    double mean(const Boundary &boundary, const NodalVector &field) const;
    void   prescribe_flux(const Boundary                        &boundary,
                          const dealii::FunctionParser<3> *const function,
                          const double                           velocity,
                          const double                           density,
                          const NodalVector                     &void_fraction,
                          NodalVectorField                      &flux) const;
    void   join_inlets();
    void   prescribe_pressure(const double time, const double velocity);

    const FlowSpace        &space;
    const bool              weigh_inlets;
    std::vector<Boundary>   boundaries;   // inlets, then no-slip walls, then the others
    std::vector<Inlet>      inlet_fluxes; // as the first of them
    std::vector<SharedNode> shared_nodes;
    std::vector<Outlet>     outlet_pressures;

    dealii::AffineConstraints<double> open, closed;
    NodalVectorField                  prescribed_flux;
    double                            reference = 0.;
  };
} // namespace graupel

#endif
