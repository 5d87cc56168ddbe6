// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_boundaries.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools_constraints.h>

#include <algorithm>
#include <set>

namespace graupel
{
  namespace
  {
    std::unique_ptr<dealii::FunctionParser<3>>
    parse(const BoundaryCondition &condition, const double velocity, const double time)
    {
      if (condition.expressions.empty())
        return nullptr;
      auto function =
        std::make_unique<dealii::FunctionParser<3>>(condition.expressions.size());
      function->initialize("x,y,z,t",
                           condition.expressions,
                           {{"V", velocity}, {"pi", dealii::numbers::PI}},
                           true);
      function->set_time(time);
      return function;
    }

    // Normals of two inlets at a node are different if the sine of their angle is above.
    constexpr double different_normals = 0.3;

    // The vector next to the mean of @p vectors that has the normal component of each.
    dealii::Tensor<1, 3>
    join(const std::vector<dealii::Tensor<1, 3>> &vectors,
         const std::vector<dealii::Tensor<1, 3>> &normals)
    {
      dealii::Tensor<1, 3> result;
      for (const auto &vector : vectors)
        result += vector / static_cast<double>(vectors.size());
      std::vector<dealii::Tensor<1, 3>> directions; // orthonormal
      for (unsigned int i = 0; i < vectors.size(); ++i)
        {
          dealii::Tensor<1, 3> rest = normals[i];
          for (const auto &direction : directions)
            rest -= (rest * direction) * direction;
          const double size = rest.norm();
          if (size < different_normals)
            continue;
          directions.push_back(rest / size);
          result += ((vectors[i] - result) * normals[i] / size) * directions.back();
        }
      return result;
    }

    // Inlets first: where an inlet meets a wall, its flux holds.
    unsigned int
    rank(const BoundaryCondition &condition)
    {
      return condition.is_inlet()                           ? 0
             : condition.kind == BoundaryCondition::no_slip ? 1
                                                            : 2;
    }
  } // namespace

  FlowBoundaries::FlowBoundaries(
    const std::map<dealii::types::boundary_id, BoundaryCondition> &conditions,
    const bool                                                     weigh_inlets,
    const FlowSpace                                               &space)
    : space(space)
    , weigh_inlets(weigh_inlets)
  {
    for (const auto &[id, condition] : conditions)
      {
        Boundary boundary;
        boundary.id        = id;
        boundary.condition = condition;
        boundaries.push_back(boundary);
      }
    std::stable_sort(
      boundaries.begin(), boundaries.end(), [](const Boundary &a, const Boundary &b) {
        return rank(a.condition) < rank(b.condition);
      });
    for (NodalVector &component : prescribed_flux)
      {
        space.nodes.initialize(component);
        component.update_ghost_values();
      }
    for (Boundary &boundary : boundaries)
      {
        measure(boundary);
        if (boundary.condition.is_inlet())
          inlet_fluxes.push_back({boundary.id, prescribed_flux});
        if (boundary.condition.kind == BoundaryCondition::pressure)
          {
            outlet_pressures.push_back({boundary.id, {}});
            space.nodes.initialize(outlet_pressures.back().pressure);
          }
      }
    find_nodes();
    find_shared_nodes();
    for (Boundary &boundary : boundaries)
      if (boundary.condition.kind == BoundaryCondition::parabolic)
        measure_parabola(boundary);
    make_template();
  }

  void
  FlowBoundaries::find_nodes()
  {
    const auto &partitioner = *space.nodes.measure().get_partitioner();
    std::set<dealii::types::global_dof_index> taken;
    for (Boundary &boundary : boundaries)
      {
        if (boundary.condition.kind == BoundaryCondition::slip)
          continue;
        std::map<dealii::types::global_dof_index, dealii::Point<3>> found;
        for (const auto &cell : space.nodes.dof_handler.active_cell_iterators())
          if (!cell->is_artificial())
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary() &&
                  cell->face(f)->boundary_id() == boundary.id)
                for (const unsigned int v : cell->face(f)->vertex_indices())
                  found.emplace(cell->face(f)->vertex_dof_index(v, 0),
                                cell->face(f)->vertex(v));
        const bool is_outlet = boundary.condition.kind == BoundaryCondition::pressure;
        for (const auto &[index, position] : found)
          if (is_outlet ||
              (!space.nodes.hanging_nodes.is_constrained(index) &&
               (taken.insert(index).second || boundary.condition.is_inlet())))
            boundary.nodes.push_back(
              {partitioner.global_to_local(index), index, position});
      }
  }

  void
  FlowBoundaries::find_shared_nodes()
  {
    std::map<dealii::types::global_dof_index, SharedNode> found;
    for (unsigned int n = 0; n < inlet_fluxes.size(); ++n)
      {
        NodalVectorField normals;
        for (NodalVector &component : normals)
          space.nodes.initialize(component);
        for (const auto &point : space.boundary(inlet_fluxes[n].id))
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            for (unsigned int i = 0; i < 3; ++i)
              normals[i].local_element(space.cell_nodes[point.cell][a]) +=
                point.weight * point.value[a] * point.normal[i];
        for (NodalVector &component : normals)
          {
            component.compress(dealii::VectorOperation::add);
            component.update_ghost_values();
          }
        for (const Node &node : boundaries[n].nodes)
          {
            dealii::Tensor<1, 3> normal;
            for (unsigned int i = 0; i < 3; ++i)
              normal[i] = normals[i].local_element(node.local);
            SharedNode &entry = found[node.global];
            entry.node        = node;
            entry.inlets.push_back(
              {n, normal / std::max(normal.norm(), std::numeric_limits<double>::min())});
          }
      }
    for (const auto &entry : found)
      if (entry.second.inlets.size() > 1)
        shared_nodes.push_back(entry.second);
  }

  void
  FlowBoundaries::measure(Boundary &boundary) const
  {
    dealii::Tensor<1, 3> moment, normal;
    double               area = 0.;
    for (const auto &point : space.boundary(boundary.id))
      {
        area += point.weight;
        moment += point.weight * dealii::Tensor<1, 3>(point.position);
        normal += point.weight * point.normal;
      }
    const MPI_Comm communicator = space.nodes.mesh.communicator();
    boundary.area               = dealii::Utilities::MPI::sum(area, communicator);
    moment                      = dealii::Utilities::MPI::sum(moment, communicator);
    normal                      = dealii::Utilities::MPI::sum(normal, communicator);
    if (boundary.area > 0.)
      boundary.center = dealii::Point<3>(moment / boundary.area);
    if (normal.norm() > 0.)
      boundary.inward = -normal / normal.norm();
  }

  double
  FlowBoundaries::Boundary::parabola(const dealii::Point<3> &x) const
  {
    const double squared_radius = area / dealii::numbers::PI;
    return std::max(0., 1. - (x - center).norm_square() / squared_radius);
  }

  void
  FlowBoundaries::measure_parabola(Boundary &boundary) const
  {
    NodalVector profile;
    space.nodes.initialize(profile);
    for (const Node &node : boundary.nodes)
      profile.local_element(node.local) = boundary.parabola(node.position);
    space.nodes.distribute(profile);
    boundary.parabola_mean = mean(boundary, profile);
  }

  void
  FlowBoundaries::make_template()
  {
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(space.dof_handler, relevant);
    open.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(space.dof_handler, open);
    std::set<dealii::types::boundary_id> slip;
    for (const Boundary &boundary : boundaries)
      {
        if (boundary.condition.kind == BoundaryCondition::slip)
          slip.insert(boundary.id);
        if (boundary.condition.is_inlet() ||
            boundary.condition.kind == BoundaryCondition::no_slip)
          for (const Node &node : boundary.nodes)
            for (unsigned int i = 0; i < 3; ++i)
              open.add_line(3 * node.global + i);
      }
    dealii::VectorTools::compute_no_normal_flux_constraints(
      space.dof_handler, 0, slip, open, space.nodes.mesh.mapping());
    closed.copy_from(open);
    closed.close();
  }

  double
  FlowBoundaries::mean(const Boundary &boundary, const NodalVector &field) const
  {
    double sum = 0.;
    for (const auto &point : space.boundary(boundary.id))
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        sum += point.weight * point.value[a] *
               field.local_element(space.cell_nodes[point.cell][a]);
    return dealii::Utilities::MPI::sum(sum, space.nodes.mesh.communicator()) /
           boundary.area;
  }

  void
  FlowBoundaries::prescribe_flux(const Boundary                        &boundary,
                                 const dealii::FunctionParser<3> *const function,
                                 const double                           velocity,
                                 const double                           density,
                                 const NodalVector                     &void_fraction,
                                 NodalVectorField                      &flux) const
  {
    const auto   kind    = boundary.condition.kind;
    const bool   by_rate = kind == BoundaryCondition::mass_flow_rate;
    const double mean_alpha =
      weigh_inlets || by_rate ? mean(boundary, void_fraction) : 1.;
    for (const Node &node : boundary.nodes)
      {
        dealii::Tensor<1, 3> q = velocity * boundary.inward;
        if (kind == BoundaryCondition::velocity)
          for (unsigned int i = 0; i < 3; ++i)
            q[i] = function->value(node.position, i);
        else if (kind == BoundaryCondition::parabolic)
          q *= boundary.parabola(node.position) / boundary.parabola_mean;
        else if (by_rate)
          q = function->value(node.position) * mean_alpha / (density * boundary.area) *
              boundary.inward;
        if (weigh_inlets)
          q *= void_fraction.local_element(node.local) / mean_alpha;
        for (unsigned int i = 0; i < 3; ++i)
          flux[i].local_element(node.local) = q[i];
      }
  }

  void
  FlowBoundaries::join_inlets()
  {
    const auto set = [&](const Node &node, const dealii::Tensor<1, 3> &q) {
      for (unsigned int i = 0; i < 3; ++i)
        {
          prescribed_flux[i].local_element(node.local) = q[i];
          open.set_inhomogeneity(3 * node.global + i, q[i]);
        }
    };
    const auto own = [&](const unsigned int inlet, const Node &node) {
      dealii::Tensor<1, 3> q;
      for (unsigned int i = 0; i < 3; ++i)
        q[i] = inlet_fluxes[inlet].flux[i].local_element(node.local);
      return q;
    };
    for (unsigned int n = 0; n < inlet_fluxes.size(); ++n)
      for (const Node &node : boundaries[n].nodes)
        set(node, own(n, node));
    for (const SharedNode &shared : shared_nodes)
      {
        std::vector<dealii::Tensor<1, 3>> vectors, normals;
        for (const auto &[inlet, normal] : shared.inlets)
          {
            vectors.push_back(own(inlet, shared.node));
            normals.push_back(normal);
          }
        set(shared.node, join(vectors, normals));
      }
  }

  void
  FlowBoundaries::prescribe_pressure(const double time, const double velocity)
  {
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    for (Outlet &outlet : outlet_pressures)
      {
        const Boundary &boundary = *std::find_if(
          boundaries.begin(), boundaries.end(), [&](const Boundary &candidate) {
            return candidate.id == outlet.id;
          });
        const auto function = parse(boundary.condition, velocity, time);
        for (const Node &node : boundary.nodes)
          {
            const double value                        = function->value(node.position);
            outlet.pressure.local_element(node.local) = value;
            lowest                                    = std::min(lowest, value);
            highest                                   = std::max(highest, value);
          }
      }
    const MPI_Comm communicator = space.nodes.mesh.communicator();
    lowest                      = dealii::Utilities::MPI::min(lowest, communicator);
    highest                     = dealii::Utilities::MPI::max(highest, communicator);
    reference                   = lowest <= highest ? 0.5 * (lowest + highest) : 0.;
    for (Outlet &outlet : outlet_pressures)
      {
        for (unsigned int k = 0; k < outlet.pressure.locally_owned_size(); ++k)
          outlet.pressure.local_element(k) -= reference;
        outlet.pressure.update_ghost_values();
      }
  }

  void
  FlowBoundaries::update(const double       time,
                         const double       velocity,
                         const double       density,
                         const NodalVector &void_fraction)
  {
    const auto share = [&](NodalVectorField &field) {
      for (NodalVector &component : field)
        {
          space.nodes.distribute(component);
        }
    };
    for (unsigned int n = 0; n < inlet_fluxes.size(); ++n)
      {
        const auto function = parse(boundaries[n].condition, velocity, time);
        prescribe_flux(boundaries[n],
                       function.get(),
                       velocity,
                       density,
                       void_fraction,
                       inlet_fluxes[n].flux);
        share(inlet_fluxes[n].flux);
      }
    join_inlets();
    share(prescribed_flux);
    prescribe_pressure(time, velocity);
    closed.copy_from(open);
    closed.close();
  }

  BoundaryCondition::Kind
  FlowBoundaries::kind(const dealii::types::boundary_id id) const
  {
    for (const Boundary &boundary : boundaries)
      if (boundary.id == id)
        return boundary.condition.kind;
    return BoundaryCondition::slip;
  }
} // namespace graupel
