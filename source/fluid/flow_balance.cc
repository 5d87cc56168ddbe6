// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  double
  FlowSolver::flow_through(const dealii::types::boundary_id boundary) const
  {
    double flow = 0.;
    for (const auto &inlet : boundaries.inlets())
      if (inlet.id == boundary)
        for (const auto &point : space.boundary(boundary))
          flow += point.weight * space.normal_component(point, inlet.flux);
    for (const auto &outlet : boundaries.outlets())
      if (outlet.id == boundary)
        for (const auto &point : space.boundary(boundary))
          flow += point.weight * space.normal_component(point, flux_now);
    return dealii::Utilities::MPI::sum(flow, nodes.mesh.communicator());
  }

  double
  FlowSolver::flow_below(const double z) const
  {
    double     flow  = 0.;
    const auto enter = [&](const dealii::types::boundary_id id,
                           const NodalVectorField          &flux) {
      for (const auto &point : space.boundary(id))
        if (point.position[2] < z)
          flow -= point.weight * space.normal_component(point, flux);
    };
    for (const auto &inlet : boundaries.inlets())
      enter(inlet.id, inlet.flux);
    for (const auto &outlet : boundaries.outlets())
      enter(outlet.id, flux_now);
    return dealii::Utilities::MPI::sum(flow, nodes.mesh.communicator());
  }

  double
  FlowSolver::outflow() const
  {
    double flow = 0.;
    for (const auto &outlet : boundaries.outlets())
      flow += flow_through(outlet.id);
    return flow;
  }

  double
  FlowSolver::inflow() const
  {
    double flow = 0.;
    for (const auto &inlet : boundaries.inlets())
      flow -= flow_through(inlet.id);
    return flow;
  }

  double
  FlowSolver::surplus() const
  {
    double     surplus = 0.;
    const auto leave   = [&](const dealii::types::boundary_id id,
                           const NodalVectorField          &flux) {
      for (const auto &point : space.boundary(id))
        surplus -= point.weight * space.normal_component(point, flux);
    };
    for (const auto &inlet : boundaries.inlets())
      leave(inlet.id, inlet.flux);
    for (const auto &outlet : boundaries.outlets())
      leave(outlet.id, latest);
    for (unsigned int k = 0; k < alpha_rate.locally_owned_size(); ++k)
      surplus -= nodes.measure().local_element(k) * alpha_rate.local_element(k);
    return dealii::Utilities::MPI::sum(surplus, nodes.mesh.communicator());
  }

  double
  FlowSolver::flow_scale() const
  {
    std::array<double, 3> flows{}; // through inlets, through outlets, stored
    const auto            crossing = [&](const dealii::types::boundary_id id,
                              const NodalVectorField          &flux,
                              double                          &flow) {
      for (const auto &point : space.boundary(id))
        flow += point.weight * std::abs(space.normal_component(point, flux));
    };
    for (const auto &inlet : boundaries.inlets())
      crossing(inlet.id, inlet.flux, flows[0]);
    for (const auto &outlet : boundaries.outlets())
      crossing(outlet.id, latest, flows[1]);
    double fastest_flux = 0.;
    for (unsigned int k = 0; k < alpha_rate.locally_owned_size(); ++k)
      {
        flows[2] +=
          nodes.measure().local_element(k) * std::abs(alpha_rate.local_element(k));
        double squared = 0.;
        for (const NodalVector &component : latest)
          squared += component.local_element(k) * component.local_element(k);
        fastest_flux = std::max(fastest_flux, std::sqrt(squared));
      }
    const MPI_Comm communicator = nodes.mesh.communicator();
    double result = dealii::Utilities::MPI::max(fastest_flux, communicator) * volume /
                    nodes.mesh.cylinder().height;
    for (const double flow : flows)
      result = std::max(result, dealii::Utilities::MPI::sum(flow, communicator));
    return std::max(result, round_off() / parameters.mass_tolerance);
  }

  double
  FlowSolver::round_off() const
  {
    // Of the sum over all rows of the continuity equation.
    const double rows = node_matrix.divergence_norm() * solution.block(0).l1_norm() +
                        node_matrix.pressure_norm() * solution.block(1).l1_norm() +
                        rhs.block(1).l1_norm();
    return std::numeric_limits<double>::epsilon() * rows;
  }

  void
  FlowSolver::find_worst_cell(const Medium &medium, Report &report) const
  {
    NodalVectorField volume_flux = flux_now;
    if (medium.solids)
      {
        const NodalVectorField gradient = pressure_gradient();
        const MovingSolids    &solids   = *medium.solids;
        for (unsigned int i = 0; i < 3; ++i)
          {
            for (unsigned int k = 0; k < volume_flux[i].locally_owned_size(); ++k)
              volume_flux[i].local_element(k) +=
                solids.flux[i].local_element(k) +
                solids.by_velocity.local_element(k) * flux_now[i].local_element(k) /
                  medium.void_fraction.local_element(k) -
                solids.by_gradient.local_element(k) * gradient[i].local_element(k);
            volume_flux[i].update_ghost_values();
          }
      }
    double       worst  = 0.;
    unsigned int number = 0;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        double surplus = 0.;
        for (const ShapePoint &point : space.shapes[cell])
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            {
              const unsigned int node = space.cell_nodes[cell][a];
              double             rate = point.value[a] * alpha_rate.local_element(node);
              for (unsigned int i = 0; i < 3; ++i)
                rate += point.gradient[i][a] * volume_flux[i].local_element(node);
              surplus += point.weight * rate;
            }
        if (std::abs(surplus) > worst)
          {
            worst  = std::abs(surplus);
            number = cell;
          }
      }
    const auto over_ranks =
      dealii::Utilities::MPI::min_max_avg(worst, nodes.mesh.communicator());
    report.worst_cell_imbalance = relative_to_flow(over_ranks.max);
    dealii::Tensor<1, 3> place;
    if (dealii::Utilities::MPI::this_mpi_process(nodes.mesh.communicator()) ==
          over_ranks.max_index &&
        space.n_cells() > 0)
      place = space.cell_centers[number];
    report.worst_cell =
      dealii::Point<3>(dealii::Utilities::MPI::sum(place, nodes.mesh.communicator()));
  }

  double
  FlowSolver::fastest_speed(const NodalVector &void_fraction) const
  {
    double squared = 0.;
    for (unsigned int k = 0; k < void_fraction.locally_owned_size(); ++k)
      {
        const double         alpha = void_fraction.local_element(k);
        dealii::Tensor<1, 3> q, inlet;
        for (unsigned int i = 0; i < 3; ++i)
          {
            q[i]     = carrier[i].local_element(k);
            inlet[i] = boundaries.flux()[i].local_element(k);
          }
        squared = std::max(
          squared, std::max(q.norm_square(), inlet.norm_square()) / alpha / alpha);
      }
    return std::sqrt(dealii::Utilities::MPI::max(squared, nodes.mesh.communicator()));
  }

  double
  FlowSolver::courant_rate() const
  {
    double rate = 0.;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      for (const unsigned int node : space.cell_nodes[cell])
        {
          double squared = 0.;
          for (const NodalVector &component : flux_now)
            squared += component.local_element(node) * component.local_element(node);
          rate = std::max(rate,
                          std::sqrt(squared) / alpha_old.local_element(node) /
                            space.cell_sizes[cell]);
        }
    return dealii::Utilities::MPI::max(rate, nodes.mesh.communicator());
  }
} // namespace graupel
