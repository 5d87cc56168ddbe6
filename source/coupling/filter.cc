#include <graupel/coupling/filter.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <boost/math/special_functions/bessel.hpp>

namespace graupel
{
  namespace
  {
    // Where the Chebyshev series of the exponential is cut.
    constexpr double cut = 1e-6;
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
    stiffness.reinit(nodes.coupling_pattern);

    // Quadrature in the corners, as for the nodes' volumes: it makes K the
    // seven-point Laplacian on a lattice. Gauss points would leave a checkerboard
    // of wave number pi/h an eigenvalue nine times smaller, and with it in the
    // void fraction.
    dealii::FEValues<3>                          values(nodes.mesh.mapping(),
                               nodes.fe,
                               dealii::QGaussLobatto<3>(2),
                               dealii::update_gradients | dealii::update_JxW_values);
    const unsigned int                           n = nodes.fe.n_dofs_per_cell();
    dealii::FullMatrix<double>                   local(n, n);
    std::vector<dealii::types::global_dof_index> indices(n);
    for (const auto &cell : nodes.owned_cells())
      {
        values.reinit(cell);
        local = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              local(a, b) +=
                values.shape_grad(a, q) * values.shape_grad(b, q) * values.JxW(q);
        cell->get_dof_indices(indices);
        nodes.hanging_nodes.distribute_local_to_global(local, indices, stiffness);
      }
    stiffness.compress(dealii::VectorOperation::add);

    // Gershgorin's bound on the eigenvalues of M^-1 K.
    for (const auto row : nodes.owned)
      {
        double sum = 0.;
        for (auto entry = stiffness.begin(row); entry != stiffness.end(row); ++entry)
          sum += std::abs(entry->value());
        largest_eigenvalue = std::max(largest_eigenvalue, sum * inverse_measure(row));
      }
    largest_eigenvalue =
      dealii::Utilities::MPI::max(largest_eigenvalue, nodes.mesh.communicator());
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

  void
  Filter::shifted_product(NodalVector &y, const NodalVector &x) const
  {
    // (2 / lambda_max M^-1 K - 1) x
    stiffness.vmult(y, x);
    y.scale(inverse_measure);
    y.sadd(2. / largest_eigenvalue, -1., x);
  }

  void
  Filter::apply_once(NodalVector &x) const
  {
    NodalVector before(x), now(x), next(x);
    shifted_product(now, before);
    x *= coefficients[0];
    x.add(coefficients[1], now);
    for (unsigned int k = 2; k < coefficients.size(); ++k)
      {
        shifted_product(next, now);
        next.sadd(2., -1., before);
        x.add(coefficients[k], next);
        before.swap(now);
        now.swap(next);
      }
  }

  void
  Filter::spread(NodalVector &x, const NodalVector &b) const
  {
    x.zero_out_ghost_values();
    x.equ(1., b);
    x.scale(inverse_measure);
    smooth(x, x);
  }

  void
  Filter::smooth(NodalVector &x, const NodalVector &f) const
  {
    x.zero_out_ghost_values();
    if (&x != &f)
      x.equ(1., f);
    if (coefficients.size() > 1)
      for (unsigned int i = 0; i < repetitions; ++i)
        apply_once(x);
    nodes.hanging_nodes.distribute(x);
    x.update_ghost_values();
  }
} // namespace graupel
