#include <graupel/dem/packing/random_places.h>

#include <deal.II/base/numbers.h>

namespace graupel
{
  RandomPlaces::RandomPlaces(const Cylinder          &cylinder,
                             const std::vector<Wall> &walls,
                             const double             lower,
                             const double             upper,
                             const double             largest_radius,
                             const double             gap)
    : walls(walls)
    , tube(cylinder.diameter / 2.)
    , lower(lower)
    , upper(upper)
    , gap(gap)
    , bin_size(2. * (1. + gap) * largest_radius)
  {
    n_bins[0] = n_bins[1] = static_cast<int>(std::ceil(2. * tube / bin_size));
    // A bin more at each end, for obstacles that reach in.
    n_bins[2] = static_cast<int>(std::ceil((upper - lower) / bin_size)) + 2;
    bins.resize(static_cast<std::size_t>(n_bins[0]) * n_bins[1] * n_bins[2]);
  }

  std::array<int, 3>
  RandomPlaces::bin(const dealii::Point<3> &x) const
  {
    const double       from[3] = {-tube, -tube, lower - bin_size};
    std::array<int, 3> b;
    for (unsigned int d = 0; d < 3; ++d)
      b[d] = std::clamp(
        static_cast<int>(std::floor((x[d] - from[d]) / bin_size)), 0, n_bins[d] - 1);
    return b;
  }

  std::size_t
  RandomPlaces::number(const int x, const int y, const int z) const
  {
    return (static_cast<std::size_t>(z) * n_bins[1] + y) * n_bins[0] + x;
  }

  void
  RandomPlaces::add_obstacle(const dealii::Point<3> &center, const double radius)
  {
    if (center[2] < lower - bin_size || center[2] > upper + bin_size)
      return;
    const auto [x, y, z] = bin(center);
    bins[number(x, y, z)].push_back({center, radius});
  }

  bool
  RandomPlaces::is_free(const dealii::Point<3> &center, const double radius) const
  {
    const auto [x, y, z] = bin(center);
    for (int c = std::max(z - 1, 0); c <= std::min(z + 1, n_bins[2] - 1); ++c)
      for (int b = std::max(y - 1, 0); b <= std::min(y + 1, n_bins[1] - 1); ++b)
        for (int a = std::max(x - 1, 0); a <= std::min(x + 1, n_bins[0] - 1); ++a)
          for (const auto &other : bins[number(a, b, c)])
            {
              const double clearance = (1. + gap) * (radius + other.radius);
              if (other.center.distance_square(center) < clearance * clearance)
                return false;
            }
    return true;
  }

  bool
  RandomPlaces::is_inside(const dealii::Point<3> &center, const double room) const
  {
    for (std::size_t w = top_wall + 1; w < walls.size(); ++w)
      if (!walls[w].is_admissible(center, room))
        return false;
    return true;
  }

  bool
  RandomPlaces::place(const double                   radius,
                      const unsigned int             n_tries,
                      const std::function<double()> &random,
                      dealii::Point<3>              &center)
  {
    const double room  = (1. + gap) * radius;
    const double reach = tube - room;
    if (reach < 0. || upper - lower < 2. * room)
      return false;
    for (unsigned int attempt = 0; attempt < n_tries; ++attempt)
      {
        const double rho   = reach * std::sqrt(random());
        const double angle = 2. * dealii::numbers::PI * random();
        const double z     = lower + room + (upper - lower - 2. * room) * random();
        center = dealii::Point<3>(rho * std::cos(angle), rho * std::sin(angle), z);
        if (is_inside(center, room) && is_free(center, radius))
          {
            add_obstacle(center, radius);
            return true;
          }
      }
    return false;
  }
} // namespace graupel
