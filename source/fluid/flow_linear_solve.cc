// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/fluid/flow_solver.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // Rounds of a solve with a tighter tolerance until the mass balance holds.
    constexpr unsigned int mass_rounds = 8;
    // A residual of the linear system below this part of it is round-off [-].
    constexpr double linear_round_off = 1e-14;
    // Of the volume that the voids have: what the void fraction is exact to [-].
    constexpr double void_round_off = 1e-13;

    // What a new preconditioner costs, in iterations.
    constexpr unsigned int renewal = 8;

    constexpr unsigned int failed = dealii::numbers::invalid_unsigned_int;
  } // namespace

  unsigned int
  FlowSolver::solve(const Medium &medium, const double rough)
  {
    if (is_closed())
      balance_closed_vessel();
    const bool stale = is_stale();
    if (stale)
      refresh_preconditioner(medium);
    double tolerance = std::max(parameters.linear_tolerance * rhs.l2_norm(),
                                std::numeric_limits<double>::min());
    if (!std::isfinite(tolerance))
      throw SolverFailure("The flow's equations have values that are not finite: is the "
                          "flux or the pressure of a boundary condition?");
    const unsigned int iterations_before = last_iterations;
    last_iterations                      = 0;
    for (unsigned int round = 0;; ++round)
      {
        const unsigned int iterations = solve_to(tolerance, rough, medium);
        if (iterations == failed && round == 0)
          throw SolverFailure(
            "The linear solver of the flow did not reach its tolerance within " +
            std::to_string(parameters.maximum_iterations) +
            " iterations. Try a smaller Flow/time step, or more \"Flow solver/maximum "
            "iterations\".");
        scale = flow_scale();
        if (iterations != failed)
          last_iterations += iterations;
        if (rough > 0.)
          break;
        const double allowed = parameters.mass_tolerance * scale, error = mass_error();
        if (error <= allowed)
          break;
        if (iterations == failed || round + 1 == mass_rounds)
          fail_mass_balance();
        tolerance *= std::clamp(0.3 * allowed / error, 1e-3, 0.03);
      }
    if (stale)
      {
        fresh_iterations = last_iterations;
        // Each time a little is forgotten, so that an older one is tried again.
        iteration_growth = 9 * iteration_growth / 10;
      }
    else
      iteration_growth = std::max(last_iterations, iterations_before) - iterations_before;
    return last_iterations;
  }

  void
  FlowSolver::fail_mass_balance()
  {
    const bool at_round_off =
      minimizer.last_residual().l2_norm() <= linear_round_off * rhs.l2_norm();
    std::ostringstream text;
    text << "The mass balance of the flow is off by " << relative_to_flow(mass_error())
         << " of the flow, above \"Flow solver/mass tolerance\" = "
         << parameters.mass_tolerance << ", ";
    if (at_round_off)
      text << "with the linear solver at round-off. Only a larger tolerance can be met.";
    else
      text << "and the linear solver gets no further. Try a smaller Flow/time step, or "
              "more \"Flow solver/maximum iterations\".";
    throw SolverFailure(text.str());
  }

  void
  FlowSolver::balance_closed_vessel()
  {
    const double gained = surplus();
    if (std::abs(gained) > std::max(parameters.mass_tolerance * flow_scale(),
                                    void_round_off * scheme.now * volume))
      {
        std::ostringstream text;
        text << "no boundary has a pressure, so that as much must leave as enters, but "
             << std::abs(gained) << " m^3/s too " << (gained > 0. ? "much" : "little")
             << " enters, with the rate at which the solids take up room; give one "
                "boundary a pressure (\"pressure 0\" at the top is usual)";
        throw InputError("Boundary conditions", text.str());
      }
    // Pressures that differ by a constant solve alike, if the sum of all rows is 0 = 0.
    double sum = 0.;
    for (unsigned int k = 0; k < rhs.block(1).locally_owned_size(); ++k)
      sum += rhs.block(1).local_element(k);
    sum = dealii::Utilities::MPI::sum(sum, nodes.mesh.communicator());
    for (unsigned int k = 0; k < rhs.block(1).locally_owned_size(); ++k)
      rhs.block(1).local_element(k) -= sum * nodes.measure().local_element(k) / volume;
  }

  void
  FlowSolver::level_pressure()
  {
    double sum = 0.;
    for (unsigned int k = 0; k < solution.block(1).locally_owned_size(); ++k)
      sum += nodes.measure().local_element(k) * solution.block(1).local_element(k);
    solution.block(1).add(-dealii::Utilities::MPI::sum(sum, nodes.mesh.communicator()) /
                          volume);
  }

  bool
  FlowSolver::is_stale() const
  {
    // Where the next solve would take more iterations than a new one costs.
    return !recipe || last_iterations + iteration_growth > fresh_iterations + renewal ||
           std::abs(scheme.now - recipe->rate) > 0.2 * scheme.now;
  }

  void
  FlowSolver::refresh_preconditioner(const Medium &medium)
  {
    assemble_schur(medium);
    preconditioner.refresh(schur.trilinos(), of_grad_div);
    built = recipe = share(assembled);
  }

  unsigned int
  FlowSolver::solve_to(const double tolerance, const double part, const Medium &medium)
  {
    boundaries.constraints().set_zero(solution);
    solution.zero_out_ghost_values();
    // A preconditioner of an earlier step may not serve any more: go on with a fresh one.
    const unsigned int patience = std::min(parameters.maximum_iterations,
                                           std::max(20u, fresh_iterations + 2 * renewal));
    unsigned int iterations = minimizer.solve(solution, rhs, tolerance, part, patience);
    if (iterations == failed)
      {
        refresh_preconditioner(medium);
        iterations =
          minimizer.solve(solution, rhs, tolerance, part, parameters.maximum_iterations);
        if (iterations != failed)
          iterations += patience;
      }
    worst_node = minimizer.last_residual().block(1).linfty_norm();
    if (is_closed())
      level_pressure();
    boundaries.constraints().distribute(solution);
    solution.update_ghost_values();
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int k = 0; k < latest[i].locally_owned_size(); ++k)
          latest[i].local_element(k) = solution.block(0).local_element(3 * k + i);
        latest[i].update_ghost_values();
      }
    return iterations;
  }
} // namespace graupel
