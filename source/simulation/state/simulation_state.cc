// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/state/simulation_state.h>

#include <ctime>
#include <sstream>

namespace graupel
{
  namespace
  {
    // With fluid: cost of a cell in one step of the fluid, in substeps of one
    // particle (50 microseconds over 30 nanoseconds).
    constexpr double particle_substeps_of_cell = 1700.;
  } // namespace

  SimulationState::SimulationState(const RunParameters &parameters,
                                   CostSheet           &costs,
                                   Progress            &progress,
                                   MPI_Comm             communicator,
                                   const std::string   &name)
    : parameters(parameters)
    , costs(costs)
    , progress(progress)
    , communicator(communicator)
    , name(name)
    , mesh(parameters.cylinder, parameters.mesh, communicator)
    , dem(parameters.dem, mesh, costs)
    , observables(dem.particles(), dem.vessel_shape(), communicator)
  {
    // What the mesh's own boundaries cannot have is said before the bed is made.
    if (parameters.sweep.has_fluid())
      parameters.flow.boundaries.by_id(mesh.boundaries());
    const double substeps = parameters.sweep.longest_step() / dem.substep();
    cell_share            = particle_substeps_of_cell / std::max(1., substeps);
  }

  void
  SimulationState::make_fluid()
  {
    fluid.emplace(
      parameters, rest.original_diameter, rest.original_solid_ratio, mesh, dem, costs);
  }

  void
  SimulationState::start_fluid()
  {
    dem.balance(cell_share);
    make_fluid();
    for (unsigned int pass = 0; pass < parameters.adaption.initial_passes; ++pass)
      {
        fluid->look_at_bed();
        adapt_mesh();
      }
    next_adaption = time + parameters.adaption.interval;
  }

  void
  SimulationState::adapt_if_due()
  {
    if (parameters.adaption.interval <= 0. || time < next_adaption)
      return;
    adapt_mesh();
    next_adaption = time + parameters.adaption.interval;
  }

  void
  SimulationState::adapt_mesh()
  {
    const unsigned int before = mesh.triangulation().n_global_active_cells();
    if (!fluid->adapt(cell_share))
      return;
    std::ostringstream text;
    text << "mesh: " << before << " cells adapted to "
         << mesh.triangulation().n_global_active_cells();
    progress.say(text.str());
  }

  BedObservables::Bed
  SimulationState::bed() const
  {
    return parameters.dem.particles.gravity_is_axial() ? observables.bed()
                                                       : BedObservables::Bed();
  }

  double
  SimulationState::cpu_seconds() const
  {
    return cpu_before + static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
} // namespace graupel
