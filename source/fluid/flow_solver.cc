// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_solver.h>

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
    , matrix(nodes)
    , scatter(space, boundaries.constraints(), matrix)
    , node_matrix(matrix)
    , schur(space)
    , preconditioner(node_matrix)
    , minimizer(matrix, node_matrix, preconditioner)
  {
    for (NodalVectorField *field :
         {&flux_now, &flux_old, &flux_history, &carrier, &latest, &outlet_traction})
      {
        for (NodalVector &component : *field)
          nodes.initialize(component);
        update_ghosts(*field);
      }
    for (NodalVector *vector :
         {&pressure_now, &relative_pressure, &alpha_old, &alpha_older, &alpha_rate})
      {
        nodes.initialize(*vector);
        vector->update_ghost_values();
      }
    unresolved_now.resize(space.shapes.size());
    unresolved_old.resize(space.shapes.size());
    for (unsigned int k = 0; k < nodes.measure().locally_owned_size(); ++k)
      volume += nodes.measure().local_element(k);
    volume    = dealii::Utilities::MPI::sum(volume, nodes.mesh.communicator());
    alpha_old = 1.;
    alpha_old.update_ghost_values();
    assembled.carrier = assembled.solids = flux_now;
    assembled.void_fraction = assembled.drag = alpha_old;
    matrix.initialize(solution);
    rhs.reinit(BlockVector(space.owned, space.relevant, nodes.mesh.communicator()));
  }

  void
  FlowSolver::set_superficial_velocity(const double velocity)
  {
    superficial_velocity = velocity;
  }

  void
  FlowSolver::set_time(const double time)
  {
    now = time;
  }

  void
  FlowSolver::share_viscous_stress(const bool shared)
  {
    whole_stress = shared;
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
    subscale_scheme = known_unresolved >= 2 ? scheme : bdf1(step);
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
        flux_history[i].equ(scheme.old, flux_now[i]);
        flux_history[i].add(scheme.older, flux_old[i]);
        carrier[i].equ(1. + ratio, flux_now[i]);
        carrier[i].add(-ratio, flux_old[i]);
      }
    update_ghosts(flux_history);
    update_ghosts(carrier);
  }

  FlowSolver::Report
  FlowSolver::step(const Medium                &medium,
                   const double                 step,
                   const double                 rough,
                   const std::function<bool()> &look_again)
  {
    std::optional<CostSheet::Scope> timing(std::in_place, costs, CostSheet::fluid);
    const FlowHistory               before      = history();
    const NodalVectorField          flux_before = flux_now;
    const NodalVector pressure_before = pressure_now, relative_before = relative_pressure;
    const auto        recipe_before = recipe;
    const double      next_time     = std::isfinite(step) ? now + step : now;
    Report            report;
    const auto        is_to_repeat = [&] {
      timing.reset();
      const bool repeat = look_again && look_again();
      timing.emplace(costs, CostSheet::fluid);
      return repeat;
    };
    try
      {
        prepare_rates(medium, step);
        if (built != recipe && !is_stale())
          {
            rebuild_preconditioner(medium.shares_pressure);
            prepare_rates(medium, step);
          }
        boundaries.update(next_time, superficial_velocity, density, medium.void_fraction);
        do
          solve_nonlinear(medium, rough, report);
        while (is_to_repeat());
      }
    catch (...)
      {
        flux_now          = flux_before;
        pressure_now      = pressure_before;
        relative_pressure = relative_before;
        restore_solution();
        recipe           = recipe_before;
        fresh_iterations = before.fresh_iterations;
        last_iterations  = before.last_iterations;
        iteration_growth = before.iteration_growth;
        if (known_media > 0)
          boundaries.update(now, last_velocity, density, alpha_old);
        throw;
      }
    report.flow_scale           = scale;
    report.mass_imbalance       = relative_to_flow(mass_error());
    report.worst_node_imbalance = relative_to_flow(worst_node);
    now                         = next_time;
    keep_history(medium, step, flux_before);
    find_worst_cell(medium, report);
    return report;
  }

  void
  FlowSolver::solve_nonlinear(const Medium &medium, const double rough, Report &report)
  {
    unsigned int repetitions = 0;
    do
      {
        assemble(medium);
        report.iterations += solve(medium, rough);
        report.change = take_carrier();
        ++repetitions;
      }
    while (report.change > parameters.nonlinear_tolerance &&
           repetitions < parameters.nonlinear_iterations);
    report.nonlinear_iterations += repetitions;
    if (parameters.nonlinear_iterations > 1 &&
        !(report.change <= parameters.nonlinear_tolerance))
      throw SolverFailure("The flow did not reach its nonlinear tolerance within " +
                          std::to_string(parameters.nonlinear_iterations) +
                          " nonlinear iterations.");
    publish();
  }

  void
  FlowSolver::keep_history(const Medium           &medium,
                           const double            step,
                           const NodalVectorField &flux_before)
  {
    flux_old = flux_before;
    update_unresolved(medium);
    alpha_older   = alpha_old;
    alpha_old     = medium.void_fraction;
    last_step     = step;
    last_velocity = superficial_velocity;
    ++known_media;
    ++costs.fluid_steps;
  }

  double
  FlowSolver::take_carrier()
  {
    double change = 0., size = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int k = 0; k < latest[i].locally_owned_size(); ++k)
          {
            const double q = latest[i].local_element(k);
            const double c = carrier[i].local_element(k);
            change += (q - c) * (q - c);
            size += q * q;
          }
        carrier[i] = latest[i];
      }
    update_ghosts(carrier);
    change = dealii::Utilities::MPI::sum(change, nodes.mesh.communicator());
    size   = dealii::Utilities::MPI::sum(size, nodes.mesh.communicator());
    return size > 0. ? std::sqrt(change / size) : 0.;
  }

  void
  FlowSolver::restore_solution()
  {
    latest = flux_now;
    for (unsigned int k = 0; k < pressure_now.locally_owned_size(); ++k)
      {
        for (unsigned int i = 0; i < 3; ++i)
          solution.block(0).local_element(3 * k + i) = flux_now[i].local_element(k);
        solution.block(1).local_element(k) = relative_pressure.local_element(k);
      }
  }

  void
  FlowSolver::continue_from(const NodalVectorField &flux,
                            const NodalVector      &pressure,
                            const NodalVector      &void_fraction)
  {
    flux_now = flux;
    update_ghosts(flux_now);
    alpha_old     = void_fraction;
    last_velocity = superficial_velocity;
    boundaries.update(now, last_velocity, density, alpha_old);
    for (unsigned int k = 0; k < pressure.locally_owned_size(); ++k)
      relative_pressure.local_element(k) =
        pressure.local_element(k) - boundaries.reference_pressure();
    relative_pressure.update_ghost_values();
    level_published_pressure();
    restore_solution();
    known_media      = 1;
    known_unresolved = 0;
    std::fill(unresolved_now.begin(), unresolved_now.end(), EightVectors());
  }

  void
  FlowSolver::level_published_pressure()
  {
    for (unsigned int k = 0; k < pressure_now.locally_owned_size(); ++k)
      pressure_now.local_element(k) =
        boundaries.reference_pressure() + relative_pressure.local_element(k);
    pressure_now.update_ghost_values();
  }

  void
  FlowSolver::publish()
  {
    flux_now = latest;
    for (unsigned int k = 0; k < pressure_now.locally_owned_size(); ++k)
      relative_pressure.local_element(k) = solution.block(1).local_element(k);
    relative_pressure.update_ghost_values();
    level_published_pressure();
  }
} // namespace graupel
