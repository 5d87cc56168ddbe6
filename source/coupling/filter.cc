#include <graupel/coupling/filter.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace graupel
{
  namespace
  {
    // The exchange of momentum is exact to this accuracy; round-off lies two
    // digits below.
    constexpr double tolerance = 1e-14;

    dealii::FullMatrix<double>
    local_matrix(const dealii::FEValues<3> &values, const double length)
    {
      const unsigned int         n = values.dofs_per_cell;
      dealii::FullMatrix<double> local(n, n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int a = 0; a < n; ++a)
          {
            local(a, a) += values.shape_value(a, q) * values.JxW(q);
            for (unsigned int b = 0; b < n; ++b)
              local(a, b) += length * length * values.shape_grad(a, q) *
                             values.shape_grad(b, q) * values.JxW(q);
          }
      return local;
    }
  } // namespace

  Filter::Filter(const NodalSpace &nodes, const double length)
    : nodes(nodes)
    , length(length)
    , total_volume(0.)
  {
    for (unsigned int k = 0; k < nodes.measure().locally_owned_size(); ++k)
      total_volume += nodes.measure().local_element(k);
    total_volume = dealii::Utilities::MPI::sum(total_volume, nodes.mesh.communicator());
    if (length == 0.)
      return;

    dealii::TrilinosWrappers::SparsityPattern pattern(nodes.owned,
                                                      nodes.owned,
                                                      nodes.relevant,
                                                      nodes.mesh.communicator());
    dealii::DoFTools::make_sparsity_pattern(nodes.dof_handler,
                                            pattern,
                                            nodes.hanging_nodes,
                                            false);
    pattern.compress();
    matrix.reinit(pattern);

    dealii::FEValues<3> values(nodes.mesh.mapping(),
                               nodes.fe,
                               nodes.quadrature,
                               dealii::update_values | dealii::update_gradients |
                                 dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> indices(nodes.fe.n_dofs_per_cell());
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(indices);
          nodes.hanging_nodes.distribute_local_to_global(local_matrix(values, length),
                                                         indices,
                                                         matrix);
        }
    matrix.compress(dealii::VectorOperation::add);
    preconditioner.initialize(matrix);
  }

  void
  Filter::spread(NodalVector &x, const NodalVector &b) const
  {
    x.zero_out_ghost_values();
    const double size = b.l2_norm();
    if (size == 0.)
      x = 0.;
    else if (length == 0.)
      for (unsigned int k = 0; k < x.locally_owned_size(); ++k)
        x.local_element(k) = b.local_element(k) / nodes.measure().local_element(k);
    else
      {
        dealii::SolverControl         control(1000, tolerance * size);
        dealii::SolverCG<NodalVector> solver(control);
        try
          {
            solver.solve(matrix, x, b, preconditioner);
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
            throw std::runtime_error(
              "The filter of the coupling did not converge. Is \"Coupling/filter length\" "
              "far larger than the vessel?");
          }
        // What the iteration left of the total: a constant, which A maps to the
        // same constant times M, makes it good.
        NodalVector rest(b);
        matrix.vmult(rest, x);
        rest.sadd(-1., 1., b);
        x.add(rest.mean_value() * rest.size() / total_volume);
      }
    nodes.hanging_nodes.distribute(x);
    x.update_ghost_values();
  }

  void
  Filter::smooth(NodalVector &x, const NodalVector &f) const
  {
    NodalVector b;
    nodes.initialize(b);
    for (unsigned int k = 0; k < b.locally_owned_size(); ++k)
      b.local_element(k) = nodes.measure().local_element(k) * f.local_element(k);
    spread(x, b);
  }
} // namespace graupel
