// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  namespace
  {
    // What the time that the flow takes to cross a cell counts for in the resistance to a
    // gradient of the pressure; by trial, of 0 to 2 [-].
    constexpr double convection_as_resistance = 0.1;
  } // namespace

  FlowCoefficients
  FlowSolver::coefficients() const
  {
    return {
      density, viscosity, scheme.now, subscale_scheme.now, parameters.grad_div, fastest};
  }

  CellState
  FlowSolver::gather(const unsigned int cell, const Medium &medium) const
  {
    CellState state;
    state.size          = space.cell_sizes[cell];
    state.drag_on_nodes = space.has_hanging_node[cell];
    state.whole_stress  = whole_stress;
    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      {
        const unsigned int node     = space.cell_nodes[cell][a];
        const double       alpha    = medium.void_fraction.local_element(node);
        state.void_fraction[a]      = alpha;
        state.pressure_share[a]     = medium.shares_pressure ? alpha : 1.;
        state.resistance[a]         = medium.drag.local_element(node) / alpha;
        state.void_fraction_rate[a] = alpha_rate.local_element(node);
        if (medium.solids)
          {
            const MovingSolids &solids  = *medium.solids;
            state.pressure_share[a]     = 1. - solids.pressure_share.local_element(node);
            state.solids_by_flux[a]     = solids.by_velocity.local_element(node) / alpha;
            state.solids_by_gradient[a] = solids.by_gradient.local_element(node);
            for (unsigned int i = 0; i < 3; ++i)
              state.solid_flux[i][a] = solids.flux[i].local_element(node);
          }
        for (unsigned int i = 0; i < 3; ++i)
          {
            state.flux[i][a]        = carrier[i].local_element(node);
            state.history[i][a]     = flux_history[i].local_element(node);
            state.drag_source[i][a] = medium.drag_source[i].local_element(node);
            state.force[i][a]       = medium.force[i].local_element(node);
          }
      }
    return state;
  }

  EightVectors
  FlowSolver::subscale_history(const unsigned int cell) const
  {
    EightVectors result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int q = 0; q < points_per_cell; ++q)
        result[i][q] = subscale_scheme.old * unresolved_now[cell][i][q] +
                       subscale_scheme.older * unresolved_old[cell][i][q];
    return result;
  }

  void
  FlowSolver::update_unresolved(const Medium &medium)
  {
    const FlowCoefficients coefficients = this->coefficients();
    Eight                  pressure;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        const CellState state = gather(cell, medium);
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          pressure[a] = relative_pressure.local_element(space.cell_nodes[cell][a]);
        const EightVectors known = subscale_history(cell);
        unresolved_old[cell]     = unresolved_now[cell];
        unresolved_now[cell] =
          unresolved_flux(coefficients, state, space.shapes[cell], known, pressure);
      }
    ++known_unresolved;
  }

  void
  FlowSolver::assemble(const Medium &medium)
  {
    fastest                 = fastest_speed(medium.void_fraction);
    assembled.rate          = scheme.now;
    assembled.subscale_rate = subscale_scheme.now;
    assembled.speed         = fastest;
    assembled.void_fraction = medium.void_fraction;
    assembled.drag          = medium.drag;
    assembled.carrier       = carrier;
    assembled.has_solids    = medium.solids.has_value();
    if (medium.solids)
      assembled.solids = {medium.solids->by_velocity,
                          medium.solids->by_gradient,
                          medium.solids->pressure_share};
    assemble_system(medium);
  }

  void
  FlowSolver::assemble_system(const Medium &medium)
  {
    matrix.clear();
    rhs                                 = 0.;
    const FlowCoefficients coefficients = this->coefficients();
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        const CellState state = gather(cell, medium);
        assemble_flow(
          coefficients, state, space.shapes[cell], subscale_history(cell), cell_system);
        scatter.add(cell, cell_system, rhs);
      }

    assemble_inlets();
    assemble_outlets(medium);
    add_nodal_drag(medium);
    matrix.compress();
    node_matrix.take();
    minimizer.forget();
    rhs.compress(dealii::VectorOperation::add);
  }

  void
  FlowSolver::assemble_inlets()
  {
    for (const auto &inlet : boundaries.inlets())
      for (const auto &point : space.boundary(inlet.id))
        {
          const double normal_flux = space.normal_component(point, inlet.flux);
          cell_system              = CellSystem();
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            cell_system.rhs[3][a] -= point.weight * point.value[a] * normal_flux;
          scatter.add(point.cell, cell_system, rhs);
        }
  }

  void
  FlowSolver::assemble_outlets(const Medium &medium)
  {
    for (const auto &outlet : boundaries.outlets())
      {
        const double returning = returning_share(outlet.id);
        for (const auto &point : space.boundary(outlet.id))
          assemble_outlet_point(outlet, point, returning, medium);
      }
  }

  double
  FlowSolver::returning_share(const dealii::types::boundary_id outlet) const
  {
    double in = 0., out = 0.;
    for (const auto &point : space.boundary(outlet))
      {
        const double flow = point.weight * space.normal_component(point, carrier);
        (flow < 0. ? in : out) += std::abs(flow);
      }
    in  = dealii::Utilities::MPI::sum(in, nodes.mesh.communicator());
    out = dealii::Utilities::MPI::sum(out, nodes.mesh.communicator());
    return in > 0. ? std::min(1., out / in) : 0.;
  }

  void
  FlowSolver::assemble_outlet_point(const FlowBoundaries::Outlet &outlet,
                                    const FlowSpace::FacePoint   &point,
                                    const double                  returning,
                                    const Medium                 &medium)
  {
    const CellState state    = gather(point.cell, medium);
    const double    pressure = space.value(point, outlet.pressure);
    // Momentum that must not enter: rho |q n| (u - (1 - returning) n n u).
    const double inflow = density * std::max(0., -space.normal_component(point, carrier));
    dealii::Tensor<1, 3> traction;
    for (unsigned int i = 0; i < 3; ++i)
      traction[i] = space.value(point, outlet_traction[i]);
    cell_system = CellSystem();
    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      {
        const unsigned int row   = unknowns_per_node * a;
        const double       share = point.weight * point.value[a];
        for (unsigned int i = 0; i < 3; ++i)
          cell_system.rhs[i][a] +=
            share * (traction[i] - state.pressure_share[a] * pressure * point.normal[i]);
        for (unsigned int b = 0; b < nodes_per_cell; ++b)
          {
            const double       mass   = share * point.value[b];
            const unsigned int column = unknowns_per_node * b;
            for (unsigned int i = 0; i < 3; ++i)
              {
                cell_system(row + i, column + 3) -=
                  state.pressure_share[a] * mass * point.normal[i];
                cell_system(row + 3, column + i) += mass * point.normal[i];
                const double entering = inflow * mass / state.void_fraction[b];
                cell_system(row + i, column + i) += entering;
                for (unsigned int j = 0; j < 3; ++j)
                  cell_system(row + i, column + j) -=
                    (1. - returning) * entering * point.normal[i] * point.normal[j];
              }
          }
      }
    scatter.add(point.cell, cell_system, rhs);
  }

  void
  FlowSolver::add_nodal_drag(const Medium &medium)
  {
    // A product of nodal values at a hanging node is not the mean of the products at
    // its parents: only node by node is the drag what the coupling's particles feel.
    for (unsigned int k = 0; k < medium.drag.locally_owned_size(); ++k)
      {
        const double measure = space.hanging_measure.local_element(k);
        if (measure == 0.)
          continue;
        dealii::Tensor<1, 3> source;
        for (unsigned int i = 0; i < 3; ++i)
          source[i] = measure * medium.drag_source[i].local_element(k);
        scatter.add(k,
                    measure * medium.drag.local_element(k) /
                      medium.void_fraction.local_element(k),
                    source,
                    rhs);
      }
  }

  void
  FlowSolver::assemble_schur(const Medium &medium)
  {
    schur.clear();
    of_grad_div.reinit(nodes.measure());
    dealii::Vector<double>                       local_grad_div(nodes_per_cell);
    std::vector<dealii::types::global_dof_index> indices(nodes_per_cell);
    std::vector<double>                          conductivity(space.n_cells());

    // Without a prescribed pressure its level is of no consequence, but must be one.
    const double level = is_closed() ? 1. / std::pow(volume, 2. / 3.) : 0.;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        const CellState state = gather(cell, medium);
        double alpha = 0., share = 0., resistance = 0., speed = 0., of_solids = 0.;
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          {
            alpha += state.void_fraction[a] / nodes_per_cell;
            share +=
              state.pressure_share[a] * (1. + state.solids_by_flux[a]) / nodes_per_cell;
            of_solids += state.solids_by_gradient[a] / nodes_per_cell;
            resistance += state.resistance[a] / nodes_per_cell;
            speed += std::hypot(state.flux[0][a], state.flux[1][a], state.flux[2][a]) /
                     state.void_fraction[a] / nodes_per_cell;
          }
        const double reaction =
          density * (scheme.now + convection_as_resistance * speed / state.size) +
          resistance + viscosity / (state.size * state.size);
        conductivity[cell] = share / reaction + of_solids;
        const double grad_div =
          parameters.grad_div * (density * speed * state.size + viscosity) / alpha;
        local_grad_div = 0.;
        PressureMatrix::CellMatrix local{};
        for (const ShapePoint &point : space.shapes[cell])
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            {
              local_grad_div[a] += grad_div * point.weight * point.value[a];
              for (unsigned int b = 0; b < nodes_per_cell; ++b)
                local[a][b] += point.weight * conductivity[cell] *
                               (point.gradient[0][a] * point.gradient[0][b] +
                                point.gradient[1][a] * point.gradient[1][b] +
                                point.gradient[2][a] * point.gradient[2][b] +
                                level * point.value[a] * point.value[b]);
            }
        schur.add(cell, local);
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          indices[a] =
            nodes.measure().get_partitioner()->local_to_global(space.cell_nodes[cell][a]);
        nodes.hanging_nodes.distribute_local_to_global(
          local_grad_div, indices, of_grad_div);
      }
    for (const auto &outlet : boundaries.outlets())
      for (const auto &point : space.boundary(outlet.id))
        {
          const double weight = conductivity[point.cell] / space.cell_sizes[point.cell];
          PressureMatrix::CellMatrix local;
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            for (unsigned int b = 0; b < nodes_per_cell; ++b)
              local[a][b] = weight * point.weight * point.value[a] * point.value[b];
          schur.add(point.cell, local);
        }
    schur.compress();
    of_grad_div.compress(dealii::VectorOperation::add);
    for (unsigned int k = 0; k < of_grad_div.locally_owned_size(); ++k)
      if (const double measure = nodes.measure().local_element(k); measure > 0.)
        of_grad_div.local_element(k) /= measure * measure;
  }
} // namespace graupel
