// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/residual_minimizer.h>

namespace graupel
{
  namespace
  {
    // Directions that are kept.
    constexpr unsigned int most_directions = 200;
    // A residual in single precision that has fallen to this part of the exact one gives
    // way to the exact one [-].
    constexpr double reliable = 1e-4;
    // What an exact residual must be of the last one at most [-].
    constexpr double least_progress = 0.5;
    // Of a residual that hardly falls: what is left of it after a direction [-].
    constexpr double hardly = 0.95;
    // Of a direction that is one of those before [-].
    constexpr double dependent = 1e-5;

    constexpr unsigned int failed = dealii::numbers::invalid_unsigned_int;

    // Of the size of a vector: what may be left of it without its products with the basis
    // where these need not be taken out twice [-].
    constexpr double hardly_left = 0.7;
    // Of the size of the residual: by what it may grow so that its sum over the
    // continuity equation is 0 [-]. Where it would cost more the sum stays: a direction
    // made for it is one that single precision has no exact image of.
    constexpr double price_of_balance = 0.9;

    // Unknowns that stay in the fastest memory while all vectors pass by.
    constexpr unsigned int chunk = 2048;

    // Of vectors of whole nodes.
    double
    product(const float *const x, const float *const y, const unsigned int length)
    {
      NodeUnknowns part[4]{0.f, 0.f, 0.f, 0.f};
      unsigned int k = 0;
      for (; k + 16 <= length; k += 16)
        for (unsigned int j = 0; j < 4; ++j)
          part[j] += unknowns_of(x + k, j) * unknowns_of(y + k, j);
      for (; k < length; k += 4)
        part[0] += unknowns_of(x + k, 0) * unknowns_of(y + k, 0);
      return reduce((part[0] + part[1]) + (part[2] + part[3]));
    }

    // Over the continuity equation.
    double
    sum_of(const float *const x, const unsigned int length)
    {
      NodeUnknowns sum = 0.f;
      for (unsigned int k = 0; k < length; k += 4)
        sum += unknowns_of(x + k, 0);
      return sum[3];
    }
  } // namespace

  ResidualMinimizer::ResidualMinimizer(const FlowMatrix          &exact,
                                       const NodeBlockMatrix     &system,
                                       const BlockPreconditioner &preconditioner)
    : exact(exact)
    , system(system)
    , preconditioner(preconditioner)
  {
    system.initialize(residual);
    system.initialize(sum);
    // They are referred to while others join them.
    basis.reserve(most_directions);
    directions.reserve(most_directions);
  }

  double
  ResidualMinimizer::take_residual(const BlockVector &x, const BlockVector &b)
  {
    exact_residual.reinit(b, true);
    exact.vmult(exact_residual, x);
    exact_residual.sadd(-1., 1., b);
    scale = exact_residual.l2_norm();
    if (scale > 0.)
      system.to_nodes(residual, exact_residual, scale);
    return scale;
  }

  std::vector<double>
  ResidualMinimizer::products(const NodeBlockVector &vector) const
  {
    std::vector<double> result(n_basis + 1, 0.);
    const unsigned int  size = vector.locally_owned_size();
    for (unsigned int begin = 0; begin < size; begin += chunk)
      {
        const unsigned int length = std::min(chunk, size - begin);
        const auto         add = [&](const unsigned int i, const NodeBlockVector &other) {
          result[i] += product(vector.begin() + begin, other.begin() + begin, length);
        };
        for (unsigned int i = 0; i < n_basis; ++i)
          add(i, basis[i]);
        add(n_basis, vector);
      }
    dealii::Utilities::MPI::sum(result, vector.get_mpi_communicator(), result);
    return result;
  }

  template <typename Use>
  void
  ResidualMinimizer::subtract_basis(NodeBlockVector           &vector,
                                    const std::vector<double> &part,
                                    const Use                 &use) const
  {
    const unsigned int size = vector.locally_owned_size();
    for (unsigned int begin = 0; begin < size; begin += chunk)
      {
        const unsigned int length = std::min(chunk, size - begin);
        float *const       x      = vector.begin() + begin;
        for (unsigned int i = 0; i < n_basis; ++i)
          {
            const float *const y = basis[i].begin() + begin;
            const float        h = part[i];
            for (unsigned int k = 0; k < length; ++k)
              x[k] -= h * y[k];
          }
        use(begin, length);
      }
  }

  bool
  ResidualMinimizer::extend(const NodeBlockVector &source)
  {
    if (directions.size() == n_basis)
      for (auto *vectors : {&basis, &directions})
        {
          vectors->emplace_back();
          system.initialize(vectors->back());
        }
    NodeBlockVector &image = basis[n_basis];
    preconditioner.vmult(directions[n_basis], image, source);

    const auto squared_rest = [&](const std::vector<double> &part) {
      double square = part[n_basis];
      for (unsigned int i = 0; i < n_basis; ++i)
        square -= part[i] * part[i];
      return square;
    };
    std::vector<double> part   = products(image), column(part);
    const double        before = part[n_basis];
    double              square = squared_rest(part);
    // Once leaves of the basis what rounding errors in single precision are; where little
    // else is left, twice is enough.
    if (square < hardly_left * hardly_left * before)
      {
        subtract_basis(image, part, [](unsigned int, unsigned int) {});
        part   = products(image);
        square = squared_rest(part);
        for (unsigned int i = 0; i < n_basis; ++i)
          column[i] += part[i];
      }
    if (!(square > dependent * dependent * before))
      return false;

    const double        size    = std::sqrt(square);
    const float         inverse = 1. / size;
    std::vector<double> totals(3, 0.); // residual times image and itself, continuity
    const auto add_up = [&](const unsigned int begin, const unsigned int length) {
      float *const       x = image.begin() + begin;
      const float *const r = residual.begin() + begin;
      for (unsigned int k = 0; k < length; ++k)
        x[k] *= inverse;
      totals[0] += product(r, x, length);
      totals[1] += product(r, r, length);
      totals[2] += sum_of(x, length);
    };
    subtract_basis(image, part, add_up);
    dealii::Utilities::MPI::sum(totals, residual.get_mpi_communicator(), totals);
    const double found = totals[0];
    residual.add(-found, image);
    left = std::sqrt(std::max(0., totals[1] - found * found));
    share.push_back(found);
    sums.resize(n_basis);
    sums.push_back(totals[2]);
    column.resize(n_basis);
    column.push_back(size);
    triangle.resize(n_basis);
    triangle.push_back(column);
    ++n_basis;
    return true;
  }

  void
  ResidualMinimizer::balance()
  {
    const double missing =
      dealii::Utilities::MPI::sum(sum_of(residual.begin(), residual.locally_owned_size()),
                                  residual.get_mpi_communicator());
    double squares = 0.;
    for (unsigned int i = 0; i < n_basis; ++i)
      squares += sums[i] * sums[i];
    // The shortest correction within the basis, which the residual is orthogonal to.
    if (std::abs(missing) < price_of_balance * left * std::sqrt(squares))
      for (unsigned int i = 0; i < n_basis; ++i)
        share[i] += missing * sums[i] / squares;
  }

  void
  ResidualMinimizer::add_directions(BlockVector &x)
  {
    for (unsigned int k = n_basis; k-- > 0;)
      {
        share[k] /= triangle[k][k];
        for (unsigned int i = 0; i < k; ++i)
          share[i] -= share[k] * triangle[k][i];
      }
    sum                     = 0.f;
    const unsigned int size = sum.locally_owned_size();
    for (unsigned int begin = 0; begin < size; begin += chunk)
      for (unsigned int i = 0; i < n_basis; ++i)
        {
          const unsigned int length = std::min(chunk, size - begin);
          float *const       s      = sum.begin() + begin;
          const float *const z      = directions[i].begin() + begin;
          const float        factor = share[i];
          for (unsigned int k = 0; k < length; ++k)
            s[k] += factor * z[k];
        }
    system.add_to(x, sum, scale);
  }

  void
  ResidualMinimizer::forget()
  {
    n_basis = 0;
  }

  unsigned int
  ResidualMinimizer::solve(BlockVector       &x,
                           const BlockVector &b,
                           const double       tolerance,
                           const double       part,
                           const unsigned int maximum)
  {
    double       error      = take_residual(x, b);
    const double wanted     = std::max(tolerance, part * error);
    unsigned int iterations = 0;
    while (!(error <= wanted))
      {
        const bool   goes_on    = minimize(0.7 * wanted / error, maximum, iterations);
        const double last_error = error;
        add_directions(x);
        if (!goes_on && iterations < maximum)
          forget();
        error = take_residual(x, b);
        if (iterations >= maximum || (goes_on && !(error < least_progress * last_error)))
          return error <= wanted ? iterations : failed;
      }
    return iterations;
  }

  bool
  ResidualMinimizer::minimize(const double       wanted,
                              const unsigned int maximum,
                              unsigned int      &iterations)
  {
    share = products(residual);
    share.resize(n_basis);
    double square = 0.;
    subtract_basis(
      residual, share, [&](const unsigned int begin, const unsigned int length) {
        square += product(residual.begin() + begin, residual.begin() + begin, length);
      });
    left =
      std::sqrt(dealii::Utilities::MPI::sum(square, residual.get_mpi_communicator()));
    bool hardly_fell = false, goes_on = true;
    while (goes_on && left > std::max(wanted, reliable))
      {
        goes_on = n_basis < most_directions && iterations < maximum;
        if (!goes_on)
          break;
        ++iterations;
        const double before = left;
        goes_on             = (!hardly_fell && extend(residual)) ||
                  (n_basis > 0 && extend(basis[n_basis - 1]));
        hardly_fell = left > hardly * before;
      }
    if (goes_on && left <= wanted)
      balance();
    return goes_on;
  }
} // namespace graupel
