#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  double
  FlowSolver::outflow() const
  {
    double flow = 0.;
    for (const auto id : boundaries.outlets())
      for (const auto &point : space.boundary(id))
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            flow += point.weight * point.value[a] * point.normal[i] *
                    flux_now[i].local_element(space.cell_nodes[point.cell][a]);
    return dealii::Utilities::MPI::sum(flow, nodes.mesh.communicator());
  }

  double
  FlowSolver::mass_error() const
  {
    // The solution is the carrier now, and the inlets have their flux exactly.
    double     surplus = 0.;
    const auto through = [&](const std::vector<dealii::types::boundary_id> &ids,
                             const NodalVectorField                        &flux) {
      for (const auto id : ids)
        for (const auto &point : space.boundary(id))
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            for (unsigned int i = 0; i < 3; ++i)
              surplus -= point.weight * point.value[a] * point.normal[i] *
                         flux[i].local_element(space.cell_nodes[point.cell][a]);
    };
    through(boundaries.inlets(), boundaries.flux());
    for (const auto id : boundaries.outlets())
      for (const auto &point : space.boundary(id))
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            surplus -= point.weight * point.value[a] * point.normal[i] *
                       solution.block(0)(
                         space.cell_unknowns[point.cell][unknowns_per_node * a + i]);
    for (unsigned int k = 0; k < alpha_rate.locally_owned_size(); ++k)
      surplus -= nodes.measure().local_element(k) * alpha_rate.local_element(k);
    return std::abs(dealii::Utilities::MPI::sum(surplus, nodes.mesh.communicator()));
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
        for (unsigned int q = 0; q < space.points_per_cell; ++q)
          {
            const ShapePoint &point = space.shapes[cell * space.points_per_cell + q];
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              {
                const unsigned int node = space.cell_nodes[cell][a];
                double             rate = point.value[a] * alpha_rate.local_element(node);
                for (unsigned int i = 0; i < 3; ++i)
                  rate += point.gradient[a][i] * volume_flux[i].local_element(node);
                surplus += point.weight * rate;
              }
          }
        if (std::abs(surplus) > worst)
          {
            worst  = std::abs(surplus);
            number = cell;
          }
      }
    const auto over_ranks =
      dealii::Utilities::MPI::min_max_avg(worst, nodes.mesh.communicator());
    report.worst_cell_imbalance = over_ranks.max / throughput;
    dealii::Tensor<1, 3> place;
    if (dealii::Utilities::MPI::this_mpi_process(nodes.mesh.communicator()) ==
          over_ranks.max_index &&
        space.n_cells() > 0)
      place = space.cell_centers[number];
    report.worst_cell =
      dealii::Point<3>(dealii::Utilities::MPI::sum(place, nodes.mesh.communicator()));
  }

  double
  FlowSolver::mean_pressure(const dealii::types::boundary_id boundary) const
  {
    double area = 0., sum = 0.;
    for (const auto &point : space.boundary(boundary))
      {
        area += point.weight;
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          sum += point.weight * point.value[a] *
                 pressure_now.local_element(space.cell_nodes[point.cell][a]);
      }
    return dealii::Utilities::MPI::sum(sum, nodes.mesh.communicator()) /
           dealii::Utilities::MPI::sum(area, nodes.mesh.communicator());
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
        result[i].update_ghost_values();
      }
    return result;
  }
} // namespace graupel
