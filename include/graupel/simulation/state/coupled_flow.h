// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_state_coupled_flow_h
#define graupel_simulation_state_coupled_flow_h

#include <graupel/coupling/exchange.h>
#include <graupel/dem/dem.h>
#include <graupel/simulation/parameters/run_parameters.h>

#include <functional>
#include <optional>

namespace graupel
{
  /**
   * The fluid in the bed: everything that lives on the nodes of the mesh, which
   * is flow solver and exchange, and the order of their work.
   */
  class CoupledFlow
  {
  public:
    /** Still fluid around the particles; all references must outlive this object.
     * @p original_diameter: of the drag law of a mixture [m]; @p solid_ratio:
     * LawVoidFraction::solid_ratio. */
    CoupledFlow(const RunParameters &parameters,
                const double         original_diameter,
                const double         solid_ratio,
                VesselMesh          &mesh,
                Dem                 &dem,
                CostSheet           &costs);

    /** The plug flow that enters at the bottom from now on [m/s]. */
    void set_superficial_velocity(const double velocity);

    /** Deposits the void fraction from where the particles are, without a step. */
    void look_at_bed();

    /**
     * Takes the fluid @p step [s] further past the particles where they are, and
     * sets the force of the fluid on them. The particles do not move.
     */
    FlowSolver::Report step(const double step);

    /**
     * Moves the particles through @p step [s] under the forces of step(). Throws
     * DemError, on all ranks; one that the length of the fluid's step explains names
     * Flow/time step.
     */
    void move_particles(const double step);

    /**
     * Finds the steady flow past the particles where they are, drag and convection
     * converged to "Flow solver/nonlinear tolerance", and sets its force on them.
     * @p tell is given the relative change after each linear system. Throws
     * SolverFailure after "Flow/maximum solves" of them.
     */
    FlowSolver::Report find_steady_state(const std::function<void(const double)> &tell);

    /**
     * Refines and coarsens the mesh where the fields ask for it ("Mesh adaption") and
     * carries everything over: fields are interpolated, the void fraction is deposited
     * anew from the same particles, springs and forces stay with their particles. To be
     * called after step(), before the particles move on. @p cell_share: cost of a cell
     * in particles. False if nothing has changed. Collective.
     */
    bool adapt(const double cell_share);

    /**
     * Goes on from the FlowSolver::cell_bytes() and the FlowSolver::history() of the
     * fluid() and the @p stable_step [s] then, past the particles where they are:
     * as if nothing had been in between. Collective.
     */
    void load(const FlowHistory           &history,
              const VesselMesh::CellBytes &bytes,
              const double                 stable_step);

    /**
     * The longest step [s] that follows the answer of the particles to the fluid, as of
     * the last step() or, before it, the bed at the beginning; infinite without particles
     * (Exchange::stable_step()).
     */
    double
    stable_step() const
    {
      return longest_step;
    }

    /** Pressure at the bottom minus pressure at the top [Pa]. */
    double pressure_drop() const;

    /** Area of the fluid's section at the height @p z [m^2]. Collective. */
    double cross_section(const double z) const;

    /** Force of the fluid on all particles against gravity, without buoyancy [N]. */
    double flow_force_against_gravity() const;
    /** Buoyancy of all particles [N]. */
    double buoyancy() const;

    const NodalSpace &
    nodes() const
    {
      return *node_space;
    }

    const FlowSolver &
    fluid() const
    {
      return *solver;
    }

    const Exchange &
    exchange() const
    {
      return *particles_and_fluid;
    }

  private:
    void build();
    void find_stable_step();
    // step() through the bed as it was last looked at.
    FlowSolver::Report flow_past_bed(const double step);
    FlowSolver::Report steady_flow_past_bed(const double rough);
    void               take_forces(const double step);
    // Flux and pressure (4 fields) on the nodes as they are now.
    void take_over(std::array<NodalVector, 4> &fields, const double time);

    const RunParameters &parameters;
    const double         original_diameter;
    const double         solid_ratio;
    VesselMesh          &mesh;
    Dem                 &dem;
    CostSheet           &costs;
    double               superficial_velocity = 0.;                              // [m/s]
    double               longest_step = std::numeric_limits<double>::infinity(); // [s]

    // Built anew with every new mesh or partition.
    std::optional<NodalSpace> node_space;
    std::optional<FlowSolver> solver;
    std::optional<Exchange>   particles_and_fluid;
  };
} // namespace graupel

#endif
