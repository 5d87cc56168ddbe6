// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/filter.h>
#include <graupel/fluid/flow_matrix.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <Epetra_CrsMatrix.h>
#include <boost/math/special_functions/bessel.hpp>

namespace graupel
{
  namespace
  {
    // Where the Chebyshev series of the exponential is cut.
    constexpr double cut = 1e-6;
    // Below this part of the diagonal an entry of K is round-off [-].
    constexpr double matrix_round_off = 1e-14;
    // Half of l^2 times the largest eigenvalue up to which one polynomial serves;
    // beyond it Bessel functions come near the end of double precision.
    constexpr double largest_exponent = 200.;
  } // namespace

  Filter::Filter(const NodalSpace &nodes, const double length)
    : nodes(nodes)
    , length(length)
    , coefficients(1, 1.)
  {
    nodes.initialize(inverse_measure);
    for (unsigned int k = 0; k < inverse_measure.locally_owned_size(); ++k)
      if (const double measure = nodes.measure().local_element(k); measure > 0.)
        inverse_measure.local_element(k) = 1. / measure;
    if (length > 0.)
      {
        assemble();
        find_polynomial();
      }
  }

  void
  Filter::assemble()
  {
    dealii::TrilinosWrappers::SparseMatrix stiffness;
    stiffness.reinit(nodes.coupling_pattern);

    // Quadrature in the corners, as for the nodes' volumes: it makes K the
    // seven-point Laplacian on a lattice. Gauss points would leave a checkerboard
    // of wave number pi/h an eigenvalue nine times smaller, and with it in the
    // void fraction.
    dealii::FEValues<3>                          shapes(nodes.mesh.mapping(),
                               nodes.fe,
                               dealii::QGaussLobatto<3>(2),
                               dealii::update_gradients | dealii::update_JxW_values);
    const unsigned int                           n = nodes.fe.n_dofs_per_cell();
    dealii::FullMatrix<double>                   local(n, n);
    std::vector<dealii::types::global_dof_index> indices(n);
    for (const auto &cell : nodes.owned_cells())
      {
        shapes.reinit(cell);
        local = 0.;
        for (const unsigned int q : shapes.quadrature_point_indices())
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              local(a, b) +=
                shapes.shape_grad(a, q) * shapes.shape_grad(b, q) * shapes.JxW(q);
        cell->get_dof_indices(indices);
        nodes.hanging_nodes.distribute_local_to_global(local, indices, stiffness);
      }
    stiffness.compress(dealii::VectorOperation::add);

    take_rows(stiffness);
    // Gershgorin's bound on the eigenvalues of M^-1 K.
    for (unsigned int row = 0; row + 1 < starts.size(); ++row)
      {
        double sum = 0.;
        for (unsigned int k = starts[row]; k < starts[row + 1]; ++k)
          sum += std::abs(values[k]);
        largest_eigenvalue =
          std::max(largest_eigenvalue, sum * inverse_measure.local_element(row));
      }
    largest_eigenvalue =
      dealii::Utilities::MPI::max(largest_eigenvalue, nodes.mesh.communicator());
  }

  void
  Filter::take_rows(const dealii::TrilinosWrappers::SparseMatrix &stiffness)
  {
    const Epetra_CrsMatrix &matrix = stiffness.trilinos_matrix();
    const Epetra_Map       &of_all = matrix.ColMap();
    dealii::IndexSet        ghosts(nodes.owned.size());
    for (int column = 0; column < of_all.NumMyElements(); ++column)
      if (!nodes.owned.is_element(of_all.GID(column)))
        ghosts.add_index(of_all.GID(column));
    const dealii::Utilities::MPI::Partitioner of_nodes(
      nodes.owned, ghosts, nodes.mesh.communicator());
    starts.push_back(0);
    for (int row = 0; row < matrix.NumMyRows(); ++row)
      {
        int     n_entries;
        double *entries;
        int    *columns_here;
        matrix.ExtractMyRowView(row, n_entries, entries, columns_here);
        const double smallest =
          matrix_round_off * *std::max_element(entries, entries + n_entries);
        for (int k = 0; k < n_entries; ++k)
          if (std::abs(entries[k]) > smallest)
            {
              values.push_back(entries[k]);
              columns.push_back(of_nodes.global_to_local(of_all.GID(columns_here[k])));
            }
        starts.push_back(values.size());
      }
    for (const unsigned int width : {1u, most_at_once})
      partitioners[width] = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        unknowns_of_nodes(nodes.owned, width),
        unknowns_of_nodes(ghosts, width),
        nodes.mesh.communicator());
  }

  void
  Filter::find_polynomial()
  {
    const double half = 0.5 * length * length * largest_eigenvalue;
    repetitions       = static_cast<unsigned int>(std::ceil(half / largest_exponent));
    // exp(-a (x + 1)) = e^-a (I_0(a) + 2 sum (-1)^k I_k(a) T_k(x)), with x from -1 to 1
    const double a = half / repetitions;
    coefficients.clear();
    for (unsigned int k = 0; k < 2 || std::abs(coefficients.back()) > cut; ++k)
      coefficients.push_back((k == 0 ? 1. : 2.) * (k % 2 == 0 ? 1. : -1.) * std::exp(-a) *
                             boost::math::cyl_bessel_i(k, a));
    // Constants, x = -1, must stay to the last digit in spite of the cut.
    double at_zero = 0.;
    for (unsigned int k = 0; k < coefficients.size(); ++k)
      at_zero += (k % 2 == 0 ? 1. : -1.) * coefficients[k];
    for (double &coefficient : coefficients)
      coefficient /= at_zero;
  }

  template <unsigned int width>
  void
  Filter::add_term(Fields       &before,
                   const Fields &now,
                   Fields       &sum,
                   const double  factor,
                   const double  coefficient) const
  {
    now.update_ghost_values();
    const double *const x = now.begin();
    double *const y = before.begin(), *const total = sum.begin();
    const double scale = 2. / largest_eigenvalue;
    for (unsigned int row = 0; row + 1 < starts.size(); ++row)
      {
        std::array<double, width> product{};
        for (unsigned int k = starts[row]; k < starts[row + 1]; ++k)
          for (unsigned int i = 0; i < width; ++i)
            product[i] += values[k] * x[width * columns[k] + i];
        const double weight = scale * inverse_measure.local_element(row);
        for (unsigned int i = 0, at = width * row; i < width; ++i, ++at)
          {
            y[at] = factor * (weight * product[i] - x[at]) - (factor - 1.) * y[at];
            total[at] += coefficient * y[at];
          }
      }
    now.zero_out_ghost_values();
  }

  template <unsigned int width>
  void
  Filter::apply(const std::vector<NodalVector *> &fields) const
  {
    // T_k of (2 / lambda_max M^-1 K - 1), two of them at a time, and the series so far.
    Fields             before(partitioners.at(width)), now(before), sum(before);
    const unsigned int n = inverse_measure.locally_owned_size();
    for (unsigned int i = 0; i < fields.size(); ++i)
      for (unsigned int k = 0; k < n; ++k)
        sum.local_element(width * k + i) = fields[i]->local_element(k);
    for (unsigned int turn = 0; turn < repetitions; ++turn)
      {
        now.equ(1., sum);
        sum *= coefficients[0];
        before = 0.;
        for (unsigned int k = 1; k < coefficients.size(); ++k)
          {
            add_term<width>(before, now, sum, k == 1 ? 1. : 2., coefficients[k]);
            before.swap(now);
          }
      }
    for (unsigned int i = 0; i < fields.size(); ++i)
      for (unsigned int k = 0; k < n; ++k)
        fields[i]->local_element(k) = sum.local_element(width * k + i);
  }

  void
  Filter::spread(const std::vector<NodalVector *> &fields) const
  {
    for (NodalVector *field : fields)
      {
        field->zero_out_ghost_values();
        field->scale(inverse_measure);
      }
    smooth(fields);
  }

  void
  Filter::smooth(const std::vector<NodalVector *> &fields) const
  {
    for (NodalVector *field : fields)
      field->zero_out_ghost_values();
    for (auto begin = fields.begin(); coefficients.size() > 1 && begin != fields.end();)
      {
        const auto end =
          begin + std::min<std::ptrdiff_t>(most_at_once, fields.end() - begin);
        if (end == begin + 1)
          apply<1>({begin, end});
        else
          apply<most_at_once>({begin, end});
        begin = end;
      }
    for (NodalVector *field : fields)
      nodes.distribute(*field);
  }

  void
  Filter::spread(NodalVector &x, const NodalVector &b) const
  {
    x.zero_out_ghost_values();
    x.equ(1., b);
    spread({&x});
  }

  void
  Filter::smooth(NodalVector &x, const NodalVector &f) const
  {
    x.zero_out_ghost_values();
    x.equ(1., f);
    smooth({&x});
  }
} // namespace graupel
