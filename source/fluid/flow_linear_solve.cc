#include <graupel/fluid/flow_solver.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

namespace graupel
{
  namespace
  {
    // Rounds of a solve with a tighter tolerance until the mass balance holds.
    constexpr unsigned int mass_rounds = 8;
  } // namespace

  unsigned int
  FlowSolver::solve()
  {
    const bool stale = last_iterations > 1.5 * fresh_iterations + 5. ||
                       std::abs(scheme.now - preconditioned_rate) > 0.2 * scheme.now;
    if (stale)
      refresh_preconditioner();
    double tolerance = std::max(parameters.linear_tolerance * rhs.l2_norm(),
                                std::numeric_limits<double>::min());
    if (!std::isfinite(tolerance))
      throw SolverFailure("The flow's equations have values that are not finite: is the "
                          "flux or the pressure of a boundary condition?");
    last_iterations = solve_to(tolerance);
    for (unsigned int round = 1;
         round < mass_rounds && mass_error() > parameters.mass_tolerance * throughput;
         ++round)
      {
        tolerance *= 0.03;
        last_iterations += solve_to(tolerance);
      }
    if (stale)
      fresh_iterations = last_iterations;
    return last_iterations;
  }

  double
  FlowSolver::node_error()
  {
    // Of the unconstrained unknowns only, as the linear system has them.
    matrix.block(1, 0).vmult(residual.block(1), solution.block(0));
    matrix.block(1, 1).vmult_add(residual.block(1), solution.block(1));
    residual.block(1) -= rhs.block(1);
    return residual.block(1).linfty_norm();
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
    boundaries.constraints().set_zero(solution);
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
          throw SolverFailure(
            "The linear solver of the flow did not reach its tolerance within " +
            std::to_string(parameters.maximum_iterations) +
            " iterations. Try a smaller Flow/time step, or more \"Flow solver/maximum "
            "iterations\".");
        iterations += patience;
      }
    worst_node = node_error();
    boundaries.constraints().distribute(solution);
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
} // namespace graupel
