// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/dem_error.h>
#include <graupel/simulation/state/coupled_flow.h>

#include <deal.II/distributed/solution_transfer.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // Particles faster than this times the sum of the fluid's superficial velocity and
    // that of a fall through the vessel are not what a flow does [-].
    constexpr double implausible = 10.;
    // Of its residual, what a linear system of a steady flow may leave while the flow
    // still changes from one to the next [-].
    constexpr double while_it_changes = 0.02;
    // Solutions of a step in which particles come loose, at most, and the part of all
    // particles for which another one is not worth its cost [-].
    constexpr unsigned int most_solutions = 4;
    constexpr double       few_released   = 0.01;
  } // namespace

  CoupledFlow::CoupledFlow(const RunParameters &parameters,
                           const double         original_diameter,
                           const double         solid_ratio,
                           VesselMesh          &mesh,
                           Dem                 &dem,
                           CostSheet           &costs)
    : parameters(parameters)
    , original_diameter(original_diameter)
    , solid_ratio(solid_ratio)
    , mesh(mesh)
    , dem(dem)
    , costs(costs)
  {
    build();
    look_at_bed();
    find_stable_step();
  }

  void
  CoupledFlow::find_stable_step()
  {
    particles_and_fluid->update_drag(dem.particles());
    longest_step = particles_and_fluid->stable_step(dem.particles());
  }

  void
  CoupledFlow::build()
  {
    // What refers to the nodes goes before them.
    particles_and_fluid.reset();
    solver.reset();
    node_space.emplace(mesh);
    solver.emplace(parameters.flow,
                   parameters.fluid.density,
                   parameters.fluid.viscosity,
                   *node_space,
                   costs);
    solver->share_viscous_stress(parameters.forces.viscous_stress);
    AddedForceLaws added{parameters.forces, parameters.fluid, {}};
    for (const auto &type : parameters.dem.types())
      added.scales.push_back(type.scale);
    particles_and_fluid.emplace(
      parameters.filter_length(),
      parameters.coupling.model == "A",
      LawVoidFraction{parameters.coupling.bed_surface == "sharp",
                      solid_ratio,
                      parameters.coupling.upstream(parameters.fluid.density /
                                                   parameters.dem.particles.density)},
      parameters.drags(original_diameter),
      *node_space,
      costs,
      added);
  }

  void
  CoupledFlow::set_superficial_velocity(const double velocity)
  {
    superficial_velocity = velocity;
    solver->set_superficial_velocity(velocity);
  }

  void
  CoupledFlow::look_at_bed()
  {
    dem.synchronise();
    particles_and_fluid->update_bed(dem.store(), dem.particles());
  }

  bool
  CoupledFlow::adapt(const double cell_share)
  {
    if (!mark_cells(
          parameters.adaption,
          *node_space,
          {exchange().medium().void_fraction, fluid().flux()[2], fluid().pressure()},
          mesh))
      return false;

    NodalVectorField flux     = fluid().flux();
    NodalVector      pressure = fluid().pressure();
    const double     time     = fluid().time();
    using Transfer = dealii::parallel::distributed::SolutionTransfer<3, NodalVector>;
    auto transfer  = std::make_unique<Transfer>(node_space->dof_handler);
    transfer->prepare_for_coarsening_and_refinement(
      {&flux[0], &flux[1], &flux[2], &pressure});
    // The solver refers to the old mesh; the transfer, to the old nodes.
    particles_and_fluid.reset();
    solver.reset();
    dem.adapt_mesh(cell_share);
    node_space->number_nodes();

    const NodalSpace           fresh(mesh);
    std::array<NodalVector, 4> fields;
    std::vector<NodalVector *> pointers;
    for (NodalVector &field : fields)
      {
        fresh.initialize(field);
        pointers.push_back(&field);
      }
    transfer->interpolate(pointers);
    transfer.reset();
    build();
    take_over(fields, time);
    return true;
  }

  void
  CoupledFlow::take_over(std::array<NodalVector, 4> &fields, const double time)
  {
    for (NodalVector &field : fields)
      {
        node_space->distribute(field);
      }
    const NodalVectorField flux{fields[0], fields[1], fields[2]};
    particles_and_fluid->update_bed(dem.store(), dem.particles());
    solver->set_superficial_velocity(superficial_velocity);
    solver->set_time(time);
    solver->continue_from(flux, fields[3], exchange().medium().void_fraction);
    particles_and_fluid->follow(fluid(), exchange().medium().void_fraction);
    find_stable_step();
  }

  void
  CoupledFlow::load(const FlowHistory           &history,
                    const VesselMesh::CellBytes &bytes,
                    const double                 stable_step)
  {
    solver->restore(history, bytes);
    superficial_velocity = history.last_velocity;
    look_at_bed();
    // The slip of the next drag is that of the last step, through the bed as it was then.
    particles_and_fluid->follow(fluid(), fluid().void_fraction());
    longest_step = stable_step;
  }

  FlowSolver::Report
  CoupledFlow::step(const double step)
  {
    look_at_bed();
    return flow_past_bed(step);
  }

  FlowSolver::Report
  CoupledFlow::flow_past_bed(const double step)
  {
    const double               density       = parameters.fluid.density;
    const dealii::Tensor<1, 3> gravity       = parameters.dem.gravity();
    ParticleArrays            &bed           = dem.particles();
    const auto                 contact_force = [&](const unsigned int row) {
      return dem.contact_force(row);
    };
    auto response        = particle_response(bed, contact_force, gravity, density, step);
    response.step_before = solver->history().last_step;
    particles_and_fluid->update_drag(bed, response);
    unsigned int solutions   = 0;
    const auto   comes_loose = [&] {
      if (step <= longest_step || ++solutions == most_solutions)
        return false;
      const auto force = particles_and_fluid->forces(bed, *solver, density, gravity);
      const auto freed = release(
        response, bed, contact_force, force, gravity, density, mesh.communicator());
      if (freed <= few_released * dem.n_global())
        return false;
      particles_and_fluid->update_drag(bed, response);
      return true;
    };
    const auto report =
      solver->step(particles_and_fluid->medium(), step, 0., comes_loose);
    take_forces(step);
    return report;
  }

  FlowSolver::Report
  CoupledFlow::steady_flow_past_bed(const double rough)
  {
    particles_and_fluid->update_drag(dem.particles());
    const auto report =
      solver->step(particles_and_fluid->medium(), FlowSolver::steady, rough);
    take_forces(FlowSolver::steady);
    return report;
  }

  void
  CoupledFlow::take_forces(const double step)
  {
    dem.particles().external_force = particles_and_fluid->forces(
      dem.particles(), *solver, parameters.fluid.density, parameters.dem.gravity());
    dem.particles().external_torque = particles_and_fluid->torques(dem.particles(), step);
    dem.particles().solid_fraction  = particles_and_fluid->solid_fractions();
    longest_step                    = particles_and_fluid->stable_step(dem.particles());
  }

  void
  CoupledFlow::move_particles(const double step)
  {
    try
      {
        dem.advance(step);
      }
    catch (const DemError &error)
      {
        const double fastest = dem.maximum_speed();
        const double fall =
          std::sqrt(2. * parameters.dem.particles.gravity * parameters.cylinder.height);
        if (!(fastest > implausible * (superficial_velocity + fall)) &&
            !(step > longest_step))
          throw;
        const std::string  what = error.what();
        std::ostringstream text;
        text << "The particles move with up to " << fastest
             << " m/s: steps of the fluid of " << step
             << " s are too long for their answer to it, which " << longest_step
             << " s would follow. Try a smaller Flow/time step. What it came to: "
             << what.substr(0, what.find(" Try "));
        throw DemError(text.str());
      }
  }

  FlowSolver::Report
  CoupledFlow::find_steady_state(const std::function<void(const double)> &tell)
  {
    look_at_bed();
    unsigned int iterations = 0;
    double       rough      = while_it_changes;
    for (unsigned int n = 1; n <= parameters.sweep.maximum_solves; ++n)
      {
        auto report = steady_flow_past_bed(rough);
        iterations += report.iterations;
        tell(report.change);
        if (report.change > parameters.flow.nonlinear_tolerance)
          continue;
        if (rough == 0.)
          {
            report.iterations           = iterations;
            report.nonlinear_iterations = n;
            return report;
          }
        rough = 0.;
      }
    throw SolverFailure("The flow through the resting bed found no steady state within " +
                        std::to_string(parameters.sweep.maximum_solves) +
                        " linear systems. It may have none: try Flow/mode = transient.");
  }

  double
  CoupledFlow::cross_section(const double z) const
  {
    // That of the discrete cylinder, so that what enters through it has its velocity.
    return parameters.mesh.file.empty() ? solver->boundary_area(VesselMesh::bottom)
                                        : dem.vessel_shape().fluid_cross_section(z);
  }

  double
  CoupledFlow::flow_force_against_gravity() const
  {
    return -(exchange().total_force() * parameters.dem.particles.gravity_direction);
  }

  double
  CoupledFlow::buoyancy() const
  {
    return parameters.fluid.density * parameters.dem.particles.gravity *
           dem.solid_volume();
  }

  double
  CoupledFlow::pressure_drop() const
  {
    return solver->mean_pressure(VesselMesh::bottom) -
           solver->mean_pressure(VesselMesh::top);
  }
} // namespace graupel
