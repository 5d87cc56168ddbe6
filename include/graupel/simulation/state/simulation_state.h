// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_state_simulation_state_h
#define graupel_simulation_state_simulation_state_h

#include <graupel/base/ledger.h>
#include <graupel/base/progress.h>
#include <graupel/dem/bed/bed_observables.h>
#include <graupel/simulation/state/bed_result.h>
#include <graupel/simulation/state/field_averages.h>

namespace graupel
{
  /**
   * What a run moves and what all its phases share: mesh, particles, fluid, clock, and
   * the account of what was conserved and what it cost.
   */
  class SimulationState
  {
  public:
    /** @p parameters are checked; all references must outlive this object. @p name
     * precedes what is told of it. */
    SimulationState(const RunParameters &parameters,
                    CostSheet           &costs,
                    Progress            &progress,
                    MPI_Comm             communicator,
                    const std::string   &name = "");

    /** Brings the fluid in: at rest, around the particles where they are. Collective. */
    void start_fluid();

    /** Makes the fluid as it is to be loaded from a checkpoint. Collective. */
    void make_fluid();

    /** Refines and coarsens the mesh where it is time to, and tells. Collective. */
    void adapt_if_due();

    /** The bed as it is now; none where gravity does not point down along the axis.
     * Collective. */
    BedObservables::Bed bed() const;

    /** Processor time of this rank; on the first with that of the run that this one
     * resumes [s]. */
    double cpu_seconds() const;

    const RunParameters parameters;
    CostSheet          &costs;
    Progress           &progress;
    const MPI_Comm      communicator;
    const std::string   name;

    VesselMesh     mesh;
    Dem            dem;
    BedObservables observables;

    /** From the first flow case on, in a run with a fluid. */
    std::optional<CoupledFlow> fluid;
    /** Of the fluid's last step. */
    FlowSolver::Report last_step;
    /** Of the fluid, over the window of the flow case. */
    FieldAverages averages;

    /** Simulated since the run began [s]. */
    double time = 0.;
    /** The bed before the flow. */
    BedResult rest;
    Ledger    ledger;
    /** Of the run that this one resumes, all ranks [s]. */
    double cpu_before = 0.;
    /** When the mesh is adapted next [s]. */
    double next_adaption = 0.;

  private:
    void adapt_mesh();

    double cell_share = 0.; // cost of a cell, in particles
  };
} // namespace graupel

#endif
