#include <graupel/fluid/flow_solver.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/block_sparsity_pattern.h>

namespace graupel
{
  namespace
  {
    void
    update_ghosts(NodalVectorField &field)
    {
      for (NodalVector &component : field)
        component.update_ghost_values();
    }

    std::vector<dealii::types::boundary_id>
    outlets(const BoundaryParameters &parameters, const VesselMesh &mesh)
    {
      std::vector<dealii::types::boundary_id> result;
      for (const auto &[id, condition] : parameters.by_id(mesh.boundaries()))
        if (condition.kind == BoundaryCondition::pressure)
          result.push_back(id);
      return result;
    }
  } // namespace

  MovingSolids::MovingSolids(const NodalSpace &nodes)
  {
    for (NodalVector *vector : {&by_velocity, &by_gradient, &pressure_share})
      {
        nodes.initialize(*vector);
        vector->update_ghost_values();
      }
    for (NodalVector &component : flux)
      nodes.initialize(component);
    update_ghosts(flux);
  }

  Medium::Medium(const NodalSpace &nodes)
  {
    for (NodalVector *vector : {&void_fraction, &drag, &volume_source})
      nodes.initialize(*vector);
    void_fraction = 1.;
    for (NodalVector *vector : {&void_fraction, &drag, &volume_source})
      vector->update_ghost_values();
    for (NodalVectorField *field : {&drag_source, &force})
      {
        for (NodalVector &component : *field)
          nodes.initialize(component);
        update_ghosts(*field);
      }
  }

  FlowSolver::FlowSolver(const FlowParameters &parameters,
                         const double          density,
                         const double          viscosity,
                         const NodalSpace     &nodes,
                         CostSheet            &costs)
    : parameters(parameters)
    , density(density)
    , viscosity(viscosity)
    , nodes(nodes)
    , costs(costs)
    , space(nodes, outlets(parameters.boundaries, nodes.mesh))
    , boundaries(parameters.boundaries.by_id(nodes.mesh.boundaries()),
                 parameters.boundaries.weigh_inlets,
                 space)
    , cell_matrix(unknowns_per_node * nodes_per_cell, unknowns_per_node * nodes_per_cell)
    , cell_rhs(unknowns_per_node * nodes_per_cell)
  {
    for (NodalVectorField *field :
         {&flux_now, &flux_old, &history, &carrier, &outlet_traction})
      {
        for (NodalVector &component : *field)
          nodes.initialize(component);
        update_ghosts(*field);
      }
    for (NodalVector *vector : {&pressure_now, &alpha_old, &alpha_older, &alpha_rate})
      {
        nodes.initialize(*vector);
        vector->update_ghost_values();
      }
    unresolved_now.resize(space.shapes.size());
    unresolved_old.resize(space.shapes.size());
    prepare_matrices();
  }

  void
  FlowSolver::prepare_matrices()
  {
    dealii::TrilinosWrappers::BlockSparsityPattern pattern(
      space.owned, space.owned, space.relevant, nodes.mesh.communicator());
    dealii::DoFTools::make_sparsity_pattern(
      space.dof_handler, pattern, boundaries.constraints(), false);
    pattern.compress();
    matrix.reinit(pattern);
    scatter = std::make_unique<CellScatter>(space, boundaries.constraints(), matrix);
    schur.reinit(nodes.coupling_pattern);
    solution.reinit(BlockVector(space.owned, space.relevant, nodes.mesh.communicator()));
    rhs.reinit(solution);
    residual.reinit(solution);
  }

  void
  FlowSolver::set_superficial_velocity(const double velocity)
  {
    superficial_velocity = velocity;
    known_media          = std::min(known_media, 1u);
  }

  void
  FlowSolver::set_time(const double time)
  {
    now = time;
  }

  void
  FlowSolver::set_outlet_traction(const NodalVectorField &traction)
  {
    outlet_traction = traction;
  }

  void
  FlowSolver::prepare_rates(const Medium &medium, const double step)
  {
    const bool second = parameters.time_scheme == "bdf2" && known_media >= 2 &&
                        std::isfinite(step) && std::isfinite(last_step);
    scheme          = second ? bdf2(step, last_step) : bdf1(step);
    subscale_scheme = known_unresolved == 0   ? TimeScheme()
                      : known_unresolved == 1 ? bdf1(step)
                                              : scheme;
    if (known_media == 0)
      alpha_old = medium.void_fraction;
    alpha_rate = 0.; // of solids, the flux comes in its place
    if (!medium.solids)
      {
        alpha_rate.equ(scheme.now, medium.void_fraction);
        alpha_rate.add(scheme.old, alpha_old, scheme.older, alpha_older);
      }
    alpha_rate -= medium.volume_source;
    alpha_rate.update_ghost_values();
    const double ratio = second ? step / last_step : 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        history[i].equ(scheme.old, flux_now[i]);
        history[i].add(scheme.older, flux_old[i]);
        carrier[i].equ(1. + ratio, flux_now[i]);
        carrier[i].add(-ratio, flux_old[i]);
      }
    update_ghosts(history);
    update_ghosts(carrier);
  }

  FlowSolver::Report
  FlowSolver::step(const Medium &medium, const double step)
  {
    const CostSheet::Scope timing(costs, CostSheet::fluid);
    const double           next_time = std::isfinite(step) ? now + step : now;
    prepare_rates(medium, step);
    boundaries.update(next_time, superficial_velocity, density, medium.void_fraction);
    throughput = std::max(boundaries.throughput(), std::numeric_limits<double>::min());

    Report report;
    try
      {
        do
          {
            assemble(medium);
            report.iterations += solve();
            report.change = take_carrier();
            ++report.nonlinear_iterations;
          }
        while (report.change > parameters.nonlinear_tolerance &&
               report.nonlinear_iterations < parameters.nonlinear_iterations);
        if (parameters.nonlinear_iterations > 1 &&
            !(report.change <= parameters.nonlinear_tolerance))
          throw SolverFailure("The flow did not reach its nonlinear tolerance within " +
                              std::to_string(parameters.nonlinear_iterations) +
                              " nonlinear iterations.");
      }
    catch (const SolverFailure &)
      {
        restore_solution();
        throw;
      }
    report.mass_imbalance       = mass_error() / throughput;
    report.worst_node_imbalance = worst_node / throughput;
    flux_old                    = flux_now;
    publish();
    find_worst_cell(medium, report);
    update_unresolved(medium);
    alpha_older = alpha_old;
    alpha_old   = medium.void_fraction;
    last_step   = step;
    now         = next_time;
    ++known_media;
    ++costs.fluid_steps;
    return report;
  }

  double
  FlowSolver::take_carrier()
  {
    double change = 0., size = 0.;
    for (unsigned int k = 0; k < pressure_now.locally_owned_size(); ++k)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double q = solution.block(0).local_element(3 * k + i);
          double      &c = carrier[i].local_element(k);
          change += (q - c) * (q - c);
          size += q * q;
          c = q;
        }
    update_ghosts(carrier);
    change = dealii::Utilities::MPI::sum(change, nodes.mesh.communicator());
    size   = dealii::Utilities::MPI::sum(size, nodes.mesh.communicator());
    return size > 0. ? std::sqrt(change / size) : 0.;
  }

  void
  FlowSolver::restore_solution()
  {
    for (unsigned int k = 0; k < pressure_now.locally_owned_size(); ++k)
      {
        for (unsigned int i = 0; i < 3; ++i)
          solution.block(0).local_element(3 * k + i) = flux_now[i].local_element(k);
        solution.block(1).local_element(k) = pressure_now.local_element(k);
      }
    preconditioned_rate = -1.; // never trust that one again
  }

  void
  FlowSolver::continue_from(const NodalVectorField &flux,
                            const NodalVector      &pressure,
                            const NodalVector      &void_fraction)
  {
    for (unsigned int i = 0; i < 3; ++i)
      flux_now[i] = flux[i];
    update_ghosts(flux_now);
    pressure_now = pressure;
    pressure_now.update_ghost_values();
    restore_solution();
    alpha_old        = void_fraction;
    known_media      = 1;
    known_unresolved = 0;
  }

  void
  FlowSolver::publish()
  {
    for (unsigned int k = 0; k < pressure_now.locally_owned_size(); ++k)
      {
        for (unsigned int i = 0; i < 3; ++i)
          flux_now[i].local_element(k) = solution.block(0).local_element(3 * k + i);
        pressure_now.local_element(k) = solution.block(1).local_element(k);
      }
    update_ghosts(flux_now);
    pressure_now.update_ghost_values();
  }
} // namespace graupel
