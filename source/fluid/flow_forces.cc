// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  double
  FlowSolver::boundary_area(const dealii::types::boundary_id boundary) const
  {
    double area = 0.;
    for (const auto &point : space.boundary(boundary))
      area += point.weight;
    return dealii::Utilities::MPI::sum(area, nodes.mesh.communicator());
  }

  const NodalVector &
  FlowSolver::boundary_pressure(const dealii::types::boundary_id boundary) const
  {
    for (const auto &outlet : boundaries.outlets())
      if (outlet.id == boundary)
        return outlet.pressure;
    return relative_pressure;
  }

  double
  FlowSolver::mean_pressure(const dealii::types::boundary_id boundary) const
  {
    const NodalVector &pressure = boundary_pressure(boundary);
    double             sum      = 0.;
    for (const auto &point : space.boundary(boundary))
      sum += point.weight * space.value(point, pressure);
    return boundaries.reference_pressure() +
           dealii::Utilities::MPI::sum(sum, nodes.mesh.communicator()) /
             boundary_area(boundary);
  }

  NodalVectorField
  FlowSolver::outlet_forces() const
  {
    NodalVectorField                             result;
    dealii::Vector<double>                       local(nodes_per_cell);
    std::vector<dealii::types::global_dof_index> indices(nodes_per_cell);
    const auto &partitioner = *nodes.measure().get_partitioner();
    for (unsigned int i = 0; i < 3; ++i)
      {
        nodes.initialize(result[i]);
        for (const auto &outlet : boundaries.outlets())
          for (const auto &point : space.boundary(outlet.id))
            {
              const double force =
                point.weight * point.normal[i] * space.value(point, outlet.pressure);
              for (unsigned int a = 0; a < nodes_per_cell; ++a)
                {
                  local[a] = force * point.value[a];
                  indices[a] =
                    partitioner.local_to_global(space.cell_nodes[point.cell][a]);
                }
              nodes.hanging_nodes.distribute_local_to_global(local, indices, result[i]);
            }
        result[i].compress(dealii::VectorOperation::add);
      }
    return result;
  }

  NodalVectorField
  FlowSolver::pressure_gradient() const
  {
    const NodalVectorField at_outlets = outlet_forces();
    NodalVectorField       result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        nodes.initialize(result[i]);
        space.gradient[i].vmult(result[i], relative_pressure);
        result[i] += at_outlets[i];
        for (unsigned int k = 0; k < result[i].locally_owned_size(); ++k)
          result[i].local_element(k) /= nodes.measure().local_element(k);
        nodes.distribute(result[i]);
      }
    return result;
  }

  dealii::Tensor<1, 3>
  FlowSolver::pressure_force() const
  {
    dealii::Tensor<1, 3> force;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      for (const ShapePoint &point : space.shapes[cell])
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          force += point.weight *
                   relative_pressure.local_element(space.cell_nodes[cell][a]) *
                   point.gradient_of(a);
    // On a boundary with a prescribed pressure it is that one which acts.
    for (const auto &outlet : boundaries.outlets())
      for (const auto &point : space.boundary(outlet.id))
        force +=
          point.weight *
          (space.value(point, outlet.pressure) - space.value(point, relative_pressure)) *
          point.normal;
    return dealii::Utilities::MPI::sum(force, nodes.mesh.communicator());
  }

  dealii::Tensor<2, 3>
  FlowSolver::viscous_stress(const dealii::Tensor<2, 3> &gradient) const
  {
    return viscosity *
           (gradient + dealii::transpose(gradient) -
            2. / 3. * dealii::trace(gradient) * dealii::unit_symmetric_tensor<3>());
  }

  dealii::Tensor<1, 3>
  FlowSolver::viscous_traction(const FlowSpace::FacePoint &point) const
  {
    double               alpha = 0.;
    dealii::Tensor<2, 3> gradient; // du_i / dx_j
    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      {
        const unsigned int node       = space.cell_nodes[point.cell][a];
        const double       node_alpha = alpha_old.local_element(node);
        alpha += point.value[a] * node_alpha;
        for (unsigned int i = 0; i < 3; ++i)
          gradient[i] += flux_now[i].local_element(node) / node_alpha * point.gradient[a];
      }
    return (whole_stress ? 1. : alpha) * (viscous_stress(gradient) * point.normal);
  }

  dealii::Tensor<1, 3>
  FlowSolver::force_on(const dealii::types::boundary_id boundary) const
  {
    const auto           kind     = boundaries.kind(boundary);
    const NodalVector   &pressure = boundary_pressure(boundary);
    dealii::Tensor<1, 3> force;
    for (const auto &point : space.boundary(boundary))
      {
        force += point.weight *
                 (boundaries.reference_pressure() + space.value(point, pressure)) *
                 point.normal;
        if (kind != BoundaryCondition::slip && known_media > 0)
          force -= point.weight * viscous_traction(point);
      }
    return dealii::Utilities::MPI::sum(force, nodes.mesh.communicator());
  }
} // namespace graupel
