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

    // Unknowns that stay in the fastest memory while all vectors pass by.
    constexpr unsigned int chunk = 2048;
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

  void
  ResidualMinimizer::products(const NodeBlockVector &vector, const unsigned int first)
  {
    removed.assign(n_basis - first + 1, 0.);
    const unsigned int size = vector.locally_owned_size();
    for (unsigned int begin = 0; begin < size; begin += chunk)
      {
        const unsigned int length = std::min(chunk, size - begin);
        const float *const x      = vector.begin() + begin;
        for (unsigned int i = first; i <= n_basis; ++i)
          {
            const float *const y =
              (i < n_basis ? basis[i].begin() : vector.begin()) + begin;
            NodeUnknowns part[4]{0.f, 0.f, 0.f, 0.f};
            unsigned int k = 0;
            for (; k + 16 <= length; k += 16)
              for (unsigned int j = 0; j < 4; ++j)
                part[j] += unknowns_of(x + k, j) * unknowns_of(y + k, j);
            for (; k < length; k += 4)
              part[0] += unknowns_of(x + k, 0) * unknowns_of(y + k, 0);
            removed[i - first] += reduce((part[0] + part[1]) + (part[2] + part[3]));
          }
      }
    dealii::Utilities::MPI::sum(removed, vector.get_mpi_communicator(), removed);
  }

  void
  ResidualMinimizer::project(NodeBlockVector &vector)
  {
    products(vector, 0);
    const unsigned int size = vector.locally_owned_size();
    for (unsigned int begin = 0; begin < size; begin += chunk)
      {
        const unsigned int length = std::min(chunk, size - begin);
        float *const       x      = vector.begin() + begin;
        for (unsigned int i = 0; i < n_basis; ++i)
          {
            const float *const y = basis[i].begin() + begin;
            const float        h = removed[i];
            for (unsigned int k = 0; k < length; ++k)
              x[k] -= h * y[k];
          }
      }
  }

  double
  ResidualMinimizer::squared_rest() const
  {
    double square = removed.back();
    for (unsigned int i = 0; i + 1 < removed.size(); ++i)
      square -= removed[i] * removed[i];
    return square;
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
    preconditioner.vmult(directions[n_basis], source);
    system.vmult(image, directions[n_basis]);

    // Once leaves of the basis what rounding errors in single precision are; twice is
    // enough.
    std::vector<double> column(n_basis + 1, 0.);
    double              before = 0., square = 0.;
    for (unsigned int turn = 0; turn < 2; ++turn)
      {
        project(image);
        if (turn == 0)
          before = removed[n_basis];
        square = squared_rest();
        for (unsigned int i = 0; i < n_basis; ++i)
          column[i] += removed[i];
      }
    if (!(square > dependent * dependent * before))
      return false;
    column[n_basis] = std::sqrt(square);
    image *= 1. / column[n_basis];
    triangle.resize(n_basis);
    triangle.push_back(column);
    ++n_basis;
    return true;
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
    sum = 0.f;
    for (unsigned int k = 0; k < n_basis; ++k)
      sum.add(share[k], directions[k]);
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
        if (!goes_on)
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
    project(residual);
    share.assign(removed.begin(), removed.begin() + n_basis);
    double left        = std::sqrt(std::max(0., squared_rest()));
    bool   hardly_fell = false;
    while (left > std::max(wanted, reliable))
      {
        if (n_basis == most_directions || iterations == maximum)
          return false;
        ++iterations;
        const bool is_extended = (!hardly_fell && extend(residual)) ||
                                 (n_basis > 0 && extend(basis[n_basis - 1]));
        if (!is_extended)
          return false;
        const unsigned int last = n_basis - 1;
        products(residual, last);
        const double found = removed[0];
        share.push_back(found);
        residual.add(-found, basis[last]);
        const double now = std::sqrt(std::max(0., squared_rest()));
        hardly_fell      = now > hardly * left;
        left             = now;
      }
    return true;
  }
} // namespace graupel
