// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef tests_fluid_column_h
#define tests_fluid_column_h

#include "../say.h"

#include <graupel/fluid/flow_solver.h>

#include <functional>

using namespace graupel;

constexpr double air_density   = 1.18415;
constexpr double air_viscosity = 1.85508e-5;

// A column with a few hundred cells, the flow in it, and its medium.
struct Column
{
  using Field = std::function<double(const dealii::Point<3> &)>;

  // @p refined: which cells are halved once.
  Column(const Cylinder                                      &cylinder,
         const FlowParameters                                &parameters,
         const double                                         cell_size,
         const double                                         density,
         const double                                         viscosity,
         const std::function<bool(const dealii::Point<3> &)> &refined = nullptr)
    : mesh(cylinder, {cell_size, 0.}, MPI_COMM_WORLD)
    , nodes(refine(mesh, refined))
    , flow(parameters, density, viscosity, nodes, costs)
    , medium(nodes)
  {
  }

  static const VesselMesh &
  refine(VesselMesh &mesh, const std::function<bool(const dealii::Point<3> &)> &refined)
  {
    if (!refined)
      return mesh;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && refined(cell->center()))
        cell->set_refine_flag();
    mesh.prepare_adaption();
    mesh.adapt([](const auto &, const auto) { return 1000u; });
    return mesh;
  }

  void
  set(NodalVector &vector, const Field &value) const
  {
    vector.zero_out_ghost_values();
    const auto &partitioner = *nodes.measure().get_partitioner();
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int v : cell->vertex_indices())
          if (const auto dof = cell->vertex_dof_index(v, 0);
              partitioner.in_local_range(dof))
            vector(dof) = value(cell->vertex(v));
    nodes.hanging_nodes.distribute(vector);
    vector.update_ghost_values();
  }

  void
  set(const Field &void_fraction, const Field &drag)
  {
    set(medium.void_fraction, void_fraction);
    set(medium.drag, drag);
  }

  // At most 60 linear systems, to a change of 1e-8.
  void
  find_steady_state()
  {
    for (unsigned int n = 0; n < 60; ++n)
      if (flow.step(medium, FlowSolver::steady).change < 1e-8)
        return;
    throw SolverFailure("no steady state");
  }

  double
  pressure_drop() const
  {
    return flow.mean_pressure(VesselMesh::bottom) - flow.mean_pressure(VesselMesh::top);
  }

  // Values at the nodes on the axis, by height, on every rank.
  std::map<double, double>
  axis(const NodalVector &field) const
  {
    std::map<double, double> result;
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          if (const auto x = cell->vertex(v); std::hypot(x[0], x[1]) < 1e-9)
            result[std::round(x[2] * 1e9) * 1e-9] = field(cell->vertex_dof_index(v, 0));
    for (const auto &other : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, result))
      result.insert(other.begin(), other.end());
    return result;
  }

  // Linear between the nodes.
  double
  on_axis(const NodalVector &field, const double z) const
  {
    const auto values = axis(field);
    const auto above  = values.lower_bound(z - 1e-9);
    if (above == values.begin() || std::abs(above->first - z) < 1e-9)
      return above->second;
    const auto   below = std::prev(above);
    const double part  = (z - below->first) / (above->first - below->first);
    return (1. - part) * below->second + part * above->second;
  }

  double
  axis_pressure_gradient(const double from, const double to) const
  {
    return (on_axis(flow.pressure(), from) - on_axis(flow.pressure(), to)) / (to - from);
  }

  // Total variation of the pressure along the axis.
  double
  axis_variation() const
  {
    const auto values = axis(flow.pressure());
    double     result = 0.;
    for (auto point = values.begin(); std::next(point) != values.end(); ++point)
      result += std::abs(std::next(point)->second - point->second);
    return result;
  }

  CostSheet  costs;
  VesselMesh mesh;
  NodalSpace nodes;
  FlowSolver flow;
  Medium     medium;
};

#endif
