// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  namespace
  {
    using dealii::Tensor;
    using CellVectors = std::array<Tensor<1, 3>, nodes_per_cell>;

    // A sum over the cells of vectors at their nodes.
    class NodalSum
    {
    public:
      NodalSum(const NodalSpace &nodes, NodalVectorField &field)
        : nodes(nodes)
        , field(field)
        , indices(nodes_per_cell)
        , local(nodes_per_cell)
      {
        for (NodalVector &component : field)
          component = 0.;
      }

      void
      add(const FlowSpace::LocalNodes &cell, const CellVectors &values)
      {
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          indices[a] = nodes.measure().get_partitioner()->local_to_global(cell[a]);
        for (unsigned int i = 0; i < 3; ++i)
          {
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              local[a] = values[a][i];
            nodes.hanging_nodes.distribute_local_to_global(local, indices, field[i]);
          }
      }

      // Divides the sum by the nodes' volumes.
      void
      finish()
      {
        for (NodalVector &component : field)
          {
            component.compress(dealii::VectorOperation::add);
            for (unsigned int k = 0; k < component.locally_owned_size(); ++k)
              if (nodes.measure().local_element(k) > 0.)
                component.local_element(k) /= nodes.measure().local_element(k);
            nodes.distribute(component);
          }
      }

    private:
      const NodalSpace                            &nodes;
      NodalVectorField                            &field;
      std::vector<dealii::types::global_dof_index> indices;
      dealii::Vector<double>                       local;
    };

    // grad u, [i][j] = du_i / dx_j.
    Tensor<2, 3>
    gradient(const ShapePoint &point, const CellVectors &u)
    {
      Tensor<2, 3> result;
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        result += dealii::outer_product(u[a], point.gradient_of(a));
      return result;
    }

    Tensor<1, 3>
    rotation(const Tensor<2, 3> &g)
    {
      return Tensor<1, 3>({g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]});
    }
  } // namespace

  FlowDerivatives::FlowDerivatives(const NodalSpace &nodes)
  {
    for (NodalVectorField *field : {&acceleration, &vorticity, &viscous_force})
      for (NodalVector &component : *field)
        {
          nodes.initialize(component);
          component.update_ghost_values();
        }
  }

  FlowDerivatives
  FlowSolver::derivatives() const
  {
    FlowDerivatives result(nodes);
    NodalSum        acceleration(nodes, result.acceleration);
    NodalSum        vorticity(nodes, result.vorticity);
    NodalSum        viscous_force(nodes, result.viscous_force);
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        CellVectors u, carried{}, spin{}, friction{};
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            {
              const unsigned int node = space.cell_nodes[cell][a];
              u[a][i] = flux_now[i].local_element(node) / alpha_old.local_element(node);
            }
        for (const ShapePoint &point : space.shapes[cell])
          {
            const Tensor<2, 3> g = gradient(point, u), stress = viscous_stress(g);
            Tensor<1, 3>       here;
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              here += point.value[a] * u[a];
            for (unsigned int a = 0; a < nodes_per_cell; ++a)
              {
                const double weight = point.weight * point.value[a];
                carried[a] += weight * (g * here);
                spin[a] += weight * rotation(g);
                friction[a] -= point.weight * (stress * point.gradient_of(a));
              }
          }
        acceleration.add(space.cell_nodes[cell], carried);
        vorticity.add(space.cell_nodes[cell], spin);
        viscous_force.add(space.cell_nodes[cell], friction);
      }
    for (NodalSum *sum : {&acceleration, &vorticity, &viscous_force})
      sum->finish();
    continue_to_prescribed(result.viscous_force);
    return result;
  }

  bool
  FlowSolver::is_prescribed(const unsigned int node) const
  {
    const auto unknown = 3 * nodes.measure().get_partitioner()->local_to_global(node);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const auto *const entries =
          boundaries.constraints().get_constraint_entries(unknown + i);
        if (!entries || !entries->empty())
          return false;
      }
    return true;
  }

  void
  FlowSolver::continue_to_prescribed(NodalVectorField &field) const
  {
    NodalVectorField sum = field, weight = field;
    NodalSum         sums(nodes, sum), weights(nodes, weight);
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      {
        const FlowSpace::LocalNodes &local = space.cell_nodes[cell];
        Tensor<1, 3>                 free;
        unsigned int                 n_free = 0;
        CellVectors                  values{}, ones{};
        for (const unsigned int node : local)
          if (!is_prescribed(node))
            {
              for (unsigned int i = 0; i < 3; ++i)
                free[i] += field[i].local_element(node);
              ++n_free;
            }
        for (unsigned int a = 0; a < nodes_per_cell && n_free > 0; ++a)
          if (is_prescribed(local[a]))
            {
              values[a]  = free;
              ones[a][0] = n_free;
            }
        sums.add(local, values);
        weights.add(local, ones);
      }
    sums.finish();
    weights.finish();
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int k = 0; k < field[i].locally_owned_size(); ++k)
          if (is_prescribed(k))
            {
              const double n            = weight[0].local_element(k);
              field[i].local_element(k) = n > 0. ? sum[i].local_element(k) / n : 0.;
            }
        nodes.distribute(field[i]);
      }
  }
} // namespace graupel
