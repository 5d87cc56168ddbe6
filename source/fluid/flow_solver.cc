#include <graupel/fluid/flow_solver.h>

#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/numerics/vector_tools_boundary.h>
#include <deal.II/numerics/vector_tools_constraints.h>

namespace graupel
{
  namespace
  {
    // Rounds of a solve with a tighter tolerance until the mass balance holds.
    constexpr unsigned int mass_rounds = 4;

    void
    update_ghosts(NodalVectorField &field)
    {
      for (NodalVector &component : field)
        component.update_ghost_values();
    }
  } // namespace

  Medium::Medium(const NodalSpace &nodes)
  {
    nodes.initialize(void_fraction);
    void_fraction = 1.;
    void_fraction.update_ghost_values();
    nodes.initialize(drag);
    for (NodalVector &component : drag_source)
      nodes.initialize(component);
    update_ghosts(drag_source);
    drag.update_ghost_values();
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
    , space(nodes)
  {
    for (NodalVectorField *field : {&flux_now, &flux_old, &history})
      for (NodalVector &component : *field)
        nodes.initialize(component);
    for (NodalVector *vector : {&pressure_now, &alpha_old, &alpha_older, &alpha_rate})
      nodes.initialize(*vector);
    for (NodalVectorField *field : {&flux_now, &flux_old, &history})
      update_ghosts(*field);
    pressure_now.update_ghost_values();
    make_constraints();
    prepare_matrices();
  }

  void
  FlowSolver::make_constraints()
  {
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(space.dof_handler, relevant);
    constraints.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(space.dof_handler, constraints);

    const std::vector<bool>                flux_mask{true, true, true, false};
    dealii::Functions::ConstantFunction<3> inflow(
      std::vector<double>{0., 0., superficial_velocity, 0.});
    dealii::VectorTools::interpolate_boundary_values(nodes.mesh.mapping(),
                                                     space.dof_handler,
                                                     VesselMesh::bottom,
                                                     inflow,
                                                     constraints,
                                                     dealii::ComponentMask(flux_mask));
    if (parameters.wall == "slip")
      dealii::VectorTools::compute_no_normal_flux_constraints(
        space.dof_handler, 0, {VesselMesh::wall}, constraints, nodes.mesh.mapping());
    else
      dealii::VectorTools::interpolate_boundary_values(
        nodes.mesh.mapping(),
        space.dof_handler,
        VesselMesh::wall,
        dealii::Functions::ZeroFunction<3>(unknowns_per_node),
        constraints,
        dealii::ComponentMask(flux_mask));
    constraints.close();
  }

  void
  FlowSolver::prepare_matrices()
  {
    dealii::TrilinosWrappers::BlockSparsityPattern pattern(
      space.owned, space.owned, space.relevant, nodes.mesh.communicator());
    dealii::DoFTools::make_sparsity_pattern(
      space.dof_handler, pattern, constraints, false);
    pattern.compress();
    matrix.reinit(pattern);
    schur.reinit(nodes.coupling_pattern);
    solution.reinit(BlockVector(space.owned, space.relevant, nodes.mesh.communicator()));
    rhs.reinit(solution);
  }

  void
  FlowSolver::set_superficial_velocity(const double velocity)
  {
    superficial_velocity = velocity;
    known_media          = std::min(known_media, 1u);
    make_constraints();
  }

  FlowSolver::Report
  FlowSolver::step(const Medium &medium, const double step)
  {
    const CostSheet::Scope timing(costs, CostSheet::fluid);
    const bool             first = known_media == 0;
    scheme                       = (parameters.time_scheme == "bdf2" && known_media >= 2)
                                     ? bdf2(step, last_step)
                                     : bdf1(step);
    if (first)
      alpha_old = medium.void_fraction;
    alpha_rate.equ(scheme.now, medium.void_fraction);
    alpha_rate.add(scheme.old, alpha_old, scheme.older, alpha_older);
    alpha_rate.update_ghost_values();
    for (unsigned int i = 0; i < 3; ++i)
      {
        history[i].equ(scheme.old, flux_now[i]);
        history[i].add(scheme.older, flux_old[i]);
      }
    update_ghosts(history);

    assemble(medium);
    const double inflow =
      std::max(superficial_velocity * nodes.mesh.cylinder().cross_section(),
               std::numeric_limits<double>::min());
    Report report;
    report.iterations     = solve(inflow);
    report.mass_imbalance = mass_error() / inflow;

    flux_old = flux_now;
    publish();
    alpha_older = alpha_old;
    alpha_old   = medium.void_fraction;
    last_step   = step;
    ++known_media;
    ++costs.fluid_steps;
    return report;
  }

  void
  FlowSolver::continue_from(const NodalVectorField &flux,
                            const NodalVector      &pressure,
                            const NodalVector      &void_fraction)
  {
    for (unsigned int k = 0; k < pressure.locally_owned_size(); ++k)
      {
        for (unsigned int i = 0; i < 3; ++i)
          solution.block(0).local_element(3 * k + i) = flux[i].local_element(k);
        solution.block(1).local_element(k) = pressure.local_element(k);
      }
    publish();
    alpha_old   = void_fraction;
    known_media = 1;
  }

  void
  FlowSolver::publish()
  {
    const unsigned int n = pressure_now.locally_owned_size();
    for (unsigned int k = 0; k < n; ++k)
      {
        for (unsigned int i = 0; i < 3; ++i)
          flux_now[i].local_element(k) = solution.block(0).local_element(3 * k + i);
        pressure_now.local_element(k) = solution.block(1).local_element(k);
      }
    update_ghosts(flux_now);
    pressure_now.update_ghost_values();
  }

  unsigned int
  FlowSolver::solve(const double inflow)
  {
    const bool stale = last_iterations > 1.5 * fresh_iterations + 5. ||
                       std::abs(scheme.now - preconditioned_rate) > 0.2 * scheme.now;
    if (stale)
      refresh_preconditioner();
    double tolerance = std::max(parameters.linear_tolerance * rhs.l2_norm(),
                                std::numeric_limits<double>::min());
    last_iterations  = solve_to(tolerance);
    for (unsigned int round = 1;
         round < mass_rounds && mass_error() > parameters.mass_tolerance * inflow;
         ++round)
      {
        tolerance *= 0.03;
        last_iterations += solve_to(tolerance);
      }
    if (stale)
      fresh_iterations = last_iterations;
    return last_iterations;
  }

  void
  FlowSolver::refresh_preconditioner()
  {
    preconditioner.refresh(matrix, schur);
    preconditioned_rate = scheme.now;
  }

  unsigned int
  FlowSolver::solve_to(const double tolerance)
  {
    constraints.set_zero(solution);
    solution.zero_out_ghost_values();
    // A preconditioner of an earlier step may not serve any more: give up early
    // with it, and only then with a fresh one.
    const unsigned int patience =
      std::min(parameters.maximum_iterations, std::max(50u, 3 * fresh_iterations));
    unsigned int iterations = iterate(tolerance, patience);
    if (iterations == dealii::numbers::invalid_unsigned_int)
      {
        refresh_preconditioner();
        iterations = iterate(tolerance, parameters.maximum_iterations);
        if (iterations == dealii::numbers::invalid_unsigned_int)
          throw std::runtime_error(
            "The linear solver of the flow did not reach its tolerance within " +
            std::to_string(parameters.maximum_iterations) +
            " iterations. Try a smaller Flow/time step, or more \"Flow solver/maximum "
            "iterations\".");
        iterations += patience;
      }
    constraints.distribute(solution);
    solution.update_ghost_values();
    return iterations;
  }

  unsigned int
  FlowSolver::iterate(const double tolerance, const unsigned int maximum)
  {
    dealii::SolverControl             control(maximum, tolerance, false, false);
    dealii::SolverFGMRES<BlockVector> solver(
      control, dealii::SolverFGMRES<BlockVector>::AdditionalData(100));
    try
      {
        solver.solve(matrix, solution, rhs, preconditioner);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        return dealii::numbers::invalid_unsigned_int;
      }
    return control.last_step();
  }

  double
  FlowSolver::outflow() const
  {
    double flow = 0.;
    for (const auto &point : space.top)
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        flow += point.weight * point.value[a] *
                flux_now[2].local_element(space.cell_nodes[point.cell][a]);
    return dealii::Utilities::MPI::sum(flow, nodes.mesh.communicator());
  }

  double
  FlowSolver::mass_error() const
  {
    double surplus = 0.;
    for (const auto &point : space.bottom)
      surplus += point.weight * superficial_velocity;
    for (const auto &point : space.top)
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        surplus -=
          point.weight * point.value[a] *
          solution.block(0)(space.cell_unknowns[point.cell][unknowns_per_node * a + 2]);
    for (unsigned int k = 0; k < alpha_rate.locally_owned_size(); ++k)
      surplus -= nodes.measure().local_element(k) * alpha_rate.local_element(k);
    return std::abs(dealii::Utilities::MPI::sum(surplus, nodes.mesh.communicator()));
  }

  double
  FlowSolver::mean_pressure(const VesselMesh::Boundary boundary) const
  {
    double area = 0., sum = 0.;
    for (const auto &point : boundary == VesselMesh::top ? space.top : space.bottom)
      {
        area += point.weight;
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          sum += point.weight * point.value[a] *
                 pressure_now.local_element(space.cell_nodes[point.cell][a]);
      }
    return dealii::Utilities::MPI::sum(sum, nodes.mesh.communicator()) /
           dealii::Utilities::MPI::sum(area, nodes.mesh.communicator());
  }

  NodalVectorField
  FlowSolver::pressure_gradient() const
  {
    NodalVectorField result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        nodes.initialize(result[i]);
        space.gradient[i].vmult(result[i], pressure_now);
        for (unsigned int k = 0; k < result[i].locally_owned_size(); ++k)
          result[i].local_element(k) /= nodes.measure().local_element(k);
        nodes.hanging_nodes.distribute(result[i]);
      }
    update_ghosts(result);
    return result;
  }
} // namespace graupel
