// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/fluid/manufactured_solution.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_values.h>

namespace graupel
{
  namespace
  {
    const std::string section = "Manufactured solution/";

    // Linear systems after which a steady state has not been reached.
    constexpr unsigned int maximum_solves = 60;
    constexpr double       steady_change  = 1e-9;

    VectorExpression
    three(const std::string &text, const std::string &name)
    {
      const auto parts = dealii::Utilities::split_string_list(text, ';');
      require(parts.size() == 3,
              section + name,
              "needs three expressions, separated by semicolons");
      return {parts[0], parts[1], parts[2]};
    }
  } // namespace

  void
  ManufacturedParameters::declare(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Anything anything;
    prm.enter_subsection("Manufactured solution");
    prm.add_parameter(
      "void fraction",
      void_fraction,
      "Void fraction of a flow that is given, to measure the error of the "
      "solver: an expression of x, y, z in m and t in s.",
      anything);
    prm.add_parameter(
      "velocity",
      velocity,
      "Its interstitial velocity in m/s: three expressions, separated by "
      "semicolons, upwards at the top. Not empty: the run computes this flow "
      "instead of a packed bed, and its errors.",
      anything);
    prm.add_parameter(
      "pressure", pressure, "Its pressure in Pa: an expression.", anything);
    prm.add_parameter("drag coefficient",
                      drag,
                      "Drag coefficient a volume in kg/m^3/s: an expression.",
                      anything);
    prm.add_parameter(
      "particle velocity",
      particle_velocity,
      "Velocity of the solids that the drag is relative to, in m/s: three "
      "expressions.",
      anything);
    prm.add_parameter(
      "force",
      force,
      "Force a volume in N/m^3 under which the flow above solves the momentum "
      "equation: three expressions; empty: derived symbolically.",
      anything);
    prm.add_parameter(
      "volume source",
      volume_source,
      "Volume that appears per volume and time in 1/s, d(alpha)/dt + div q; "
      "empty: derived symbolically.",
      anything);
    prm.add_parameter(
      "duration",
      duration,
      "Simulated time after which the errors are taken, in steps of Flow/time "
      "step; 0: those of the steady state [s].");
    prm.leave_subsection();
  }

  void
  ManufacturedParameters::check() const
  {
    require(duration >= 0., section + "duration", "must not be negative");
    if (is_given())
      ManufacturedSolution(*this, 1., 1.);
  }

  ManufacturedSolution::ManufacturedSolution(const ManufacturedParameters &parameters,
                                             const double                  density,
                                             const double                  viscosity)
    : duration(parameters.duration)
    , function(n_fields)
  {
    NeededSources sources;
    try
      {
        sources =
          derive_sources({parameters.void_fraction,
                          three(parameters.velocity, "velocity"),
                          parameters.pressure,
                          parameters.drag,
                          three(parameters.particle_velocity, "particle velocity")},
                         density,
                         viscosity);
      }
    catch (const InputError &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        throw InputError(section + "velocity", error.what());
      }
    if (!parameters.force.empty())
      sources.force = three(parameters.force, "force");
    if (!parameters.volume_source.empty())
      sources.volume_source = parameters.volume_source;

    const auto add = [&](const VectorExpression &vector) {
      expressions.insert(expressions.end(), vector.begin(), vector.end());
    };
    expressions.push_back(parameters.void_fraction);
    add(sources.flux);
    expressions.push_back(parameters.pressure);
    expressions.push_back(parameters.drag);
    add(sources.drag_source);
    add(sources.force);
    expressions.push_back(sources.volume_source);
    add(sources.top_traction);
    try
      {
        function.initialize("x,y,z,t", expressions, {{"pi", dealii::numbers::PI}}, true);
        function.value(dealii::Point<3>(), 0);
      }
    catch (const std::exception &)
      {
        throw InputError(
          section + "void fraction",
          "one of the expressions of this section cannot be evaluated; they "
          "may hold x, y, z, t and pi");
      }
  }

  FlowParameters
  ManufacturedSolution::with_boundaries(FlowParameters parameters) const
  {
    const std::string flux = "velocity " + expressions[q] + "; " + expressions[q + 1] +
                             "; " + expressions[q + 2];
    parameters.boundaries        = BoundaryParameters();
    parameters.boundaries.bottom = flux;
    parameters.boundaries.wall   = flux;
    parameters.boundaries.top    = "pressure " + expressions[p];
    return parameters;
  }

  void
  ManufacturedSolution::evaluate(NodalVector       &vector,
                                 const NodalSpace  &nodes,
                                 const unsigned int field,
                                 const double       time) const
  {
    function.set_time(time);
    vector.zero_out_ghost_values();
    const auto       &partitioner = *nodes.measure().get_partitioner();
    std::vector<bool> done(partitioner.locally_owned_size());
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int v : cell->vertex_indices())
          {
            const auto index = cell->vertex_dof_index(v, 0);
            if (!partitioner.in_local_range(index))
              continue;
            const unsigned int local = partitioner.global_to_local(index);
            if (!done[local])
              vector.local_element(local) = function.value(cell->vertex(v), field);
            done[local] = true;
          }
    nodes.distribute(vector);
  }

  void
  ManufacturedSolution::start(FlowSolver &flow, const NodalSpace &nodes) const
  {
    NodalVectorField flux;
    NodalVector      pressure, void_fraction;
    for (unsigned int i = 0; i < 3; ++i)
      {
        nodes.initialize(flux[i]);
        evaluate(flux[i], nodes, q + i, 0.);
      }
    nodes.initialize(pressure);
    nodes.initialize(void_fraction);
    evaluate(pressure, nodes, p, 0.);
    evaluate(void_fraction, nodes, alpha, 0.);
    flow.continue_from(flux, pressure, void_fraction);
    flow.set_time(0.);
  }

  void
  ManufacturedSolution::set(Medium           &medium,
                            FlowSolver       &flow,
                            const NodalSpace &nodes,
                            const double      time) const
  {
    evaluate(medium.void_fraction, nodes, alpha, time);
    evaluate(medium.drag, nodes, drag, time);
    evaluate(medium.volume_source, nodes, volume_source, time);
    NodalVectorField at_top;
    for (unsigned int i = 0; i < 3; ++i)
      {
        evaluate(medium.drag_source[i], nodes, drag_source + i, time);
        evaluate(medium.force[i], nodes, force + i, time);
        nodes.initialize(at_top[i]);
        evaluate(at_top[i], nodes, traction + i, time);
      }
    flow.set_outlet_traction(at_top);
  }

  FlowErrors
  ManufacturedSolution::errors(const FlowSolver &flow,
                               const NodalSpace &nodes,
                               const double      time) const
  {
    function.set_time(time);
    dealii::FEValues<3>                values(nodes.mesh.mapping(),
                               nodes.fe,
                               dealii::QGauss<3>(3),
                               dealii::update_values | dealii::update_quadrature_points |
                                 dealii::update_JxW_values);
    std::array<const NodalVector *, 4> computed{
      &flow.flux()[0], &flow.flux()[1], &flow.flux()[2], &flow.pressure()};
    std::array<double, 4> sums{}; // error and size of q, error and size of p
    std::vector<double>   at_points(values.n_quadrature_points);
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (unsigned int i = 0; i < 4; ++i)
            {
              values.get_function_values(*computed[i], at_points);
              for (const unsigned int k : values.quadrature_point_indices())
                {
                  const double  exact = function.value(values.quadrature_point(k), q + i);
                  const double  error = at_points[k] - exact;
                  double *const error_sum = &sums[i < 3 ? 0 : 2];
                  error_sum[0] += values.JxW(k) * error * error;
                  error_sum[1] += values.JxW(k) * exact * exact;
                }
            }
        }
    for (double &sum : sums)
      sum = dealii::Utilities::MPI::sum(sum, nodes.mesh.communicator());
    const auto relative = [](const double error, const double size) {
      return std::sqrt(size > 0. ? error / size : error);
    };
    return {relative(sums[0], sums[1]), relative(sums[2], sums[3]), 0};
  }

  FlowErrors
  ManufacturedSolution::run(FlowSolver       &flow,
                            const NodalSpace &nodes,
                            const double      step) const
  {
    Medium medium(nodes);
    start(flow, nodes);
    unsigned int solves = 0;
    if (duration == 0.)
      {
        set(medium, flow, nodes, 0.);
        double change = 1.;
        while (change > steady_change)
          {
            if (solves >= maximum_solves)
              throw SolverFailure("The manufactured flow found no steady state within " +
                                  std::to_string(maximum_solves) + " linear systems.");
            const auto report = flow.step(medium, FlowSolver::steady);
            solves += report.nonlinear_iterations;
            change = report.change;
          }
        FlowErrors result = errors(flow, nodes, 0.);
        result.solves     = solves;
        return result;
      }
    const auto n_steps =
      static_cast<unsigned int>(std::ceil(duration / step * (1. - 1e-12)));
    for (unsigned int n = 1; n <= n_steps; ++n)
      {
        set(medium, flow, nodes, duration * n / n_steps);
        solves += flow.step(medium, duration / n_steps).nonlinear_iterations;
      }
    FlowErrors result = errors(flow, nodes, duration);
    result.solves     = solves;
    return result;
  }
} // namespace graupel
