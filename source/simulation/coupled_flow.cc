#include <graupel/simulation/coupled_flow.h>

namespace graupel
{
  CoupledFlow::CoupledFlow(const RunParameters &parameters,
                           const VesselMesh    &mesh,
                           Dem                 &dem,
                           CostSheet           &costs)
    : parameters(parameters)
    , mesh(mesh)
    , dem(dem)
    , costs(costs)
  {
    build();
  }

  void
  CoupledFlow::build()
  {
    node_space.emplace(mesh);
    solver.emplace(parameters.flow,
                   parameters.fluid.density,
                   parameters.fluid.viscosity,
                   *node_space,
                   costs);
    std::vector<DragOfType> drags;
    for (const auto &type : parameters.dem.types())
      drags.push_back({Drag(parameters.drag, parameters.fluid, type.diameter, type.scale),
                       0.5 * type.scale * type.diameter});
    particles_and_fluid.emplace(parameters.filter_length(),
                                parameters.coupling.model == "A",
                                drags,
                                *node_space,
                                costs);
  }

  void
  CoupledFlow::set_superficial_velocity(const double velocity)
  {
    solver->set_superficial_velocity(velocity);
  }

  FlowSolver::Report
  CoupledFlow::step(const double step)
  {
    dem.synchronise();
    particles_and_fluid->update(dem.store(), dem.particles());
    const auto report = solver->step(particles_and_fluid->medium(), step);
    dem.particles().external_force =
      particles_and_fluid->forces(dem.particles(),
                                  *solver,
                                  parameters.fluid.density,
                                  parameters.dem.particles.gravity);
    return report;
  }

  FlowSolver::Report
  CoupledFlow::find_steady_state(const std::function<void(const double)> &tell)
  {
    unsigned int iterations = 0;
    for (unsigned int n = 1; n <= parameters.sweep.maximum_solves; ++n)
      {
        auto report = step(FlowSolver::steady);
        iterations += report.iterations;
        tell(report.change);
        if (report.change <= parameters.flow.nonlinear_tolerance)
          {
            report.iterations           = iterations;
            report.nonlinear_iterations = n;
            return report;
          }
      }
    throw SolverFailure("The flow through the resting bed found no steady state within " +
                        std::to_string(parameters.sweep.maximum_solves) +
                        " linear systems. It may have none: try Flow/mode = transient.");
  }

  double
  CoupledFlow::pressure_drop() const
  {
    return solver->mean_pressure(VesselMesh::bottom) -
           solver->mean_pressure(VesselMesh::top);
  }
} // namespace graupel
