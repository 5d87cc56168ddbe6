// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/packing/random_places.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

namespace graupel
{
  namespace
  {
    // Places that are drawn at a time: at first few, as they may be for one sphere only.
    constexpr std::size_t fewest_tries = 8, most_tries = 4096;

    // Of the random numbers.
    constexpr unsigned int numbers_a_try = 3;
  } // namespace

  RandomPlaces::RandomPlaces(const Cylinder                              &cylinder,
                             const std::vector<Wall>                     &walls,
                             const double                                 lower,
                             const double                                 upper,
                             const double                                 largest_radius,
                             const double                                 gap,
                             const std::optional<dealii::BoundingBox<3>> &own,
                             std::mt19937_64                             &generator,
                             MPI_Comm                                     communicator)
    : walls(walls)
    , tube(cylinder.diameter / 2.)
    , lower(lower)
    , upper(upper)
    , gap(gap)
    , bin_size(2. * (1. + gap) * largest_radius)
    , generator(generator)
    , communicator(communicator)
    , n_next(fewest_tries)
  {
    if (!own)
      return;
    // A bin more on all sides, for what is placed beside.
    auto [low, high] = own->get_boundary_points();
    low[2]           = std::max(low[2], lower);
    high[2]          = std::min(high[2], upper);
    const Bin   last = bin(high);
    std::size_t n    = 1;
    first_bin        = bin(low);
    for (unsigned int d = 0; d < 3; ++d)
      {
        n_bins[d] = std::max(0, last[d] - first_bin[d] + 3);
        --first_bin[d];
        n *= n_bins[d];
      }
    bins.resize(n);
  }

  RandomPlaces::Bin
  RandomPlaces::bin(const dealii::Point<3> &x) const
  {
    Bin b;
    for (unsigned int d = 0; d < 3; ++d)
      b[d] = static_cast<int>(std::floor(x[d] / bin_size));
    return b;
  }

  bool
  RandomPlaces::is_known(const Bin &b) const
  {
    for (unsigned int d = 0; d < 3; ++d)
      if (b[d] < first_bin[d] || b[d] >= first_bin[d] + n_bins[d])
        return false;
    return true;
  }

  std::size_t
  RandomPlaces::number(const Bin &b) const
  {
    const auto at = [&](const unsigned int d) {
      return static_cast<std::size_t>(b[d] - first_bin[d]);
    };
    return (at(2) * n_bins[1] + at(1)) * n_bins[0] + at(0);
  }

  void
  RandomPlaces::add_obstacle(const dealii::Point<3> &center, const double radius)
  {
    const Bin at = bin(center);
    if (is_known(at))
      bins[number(at)].push_back({center, radius});
    if (n_tried < tries.size())
      placed[at].push_back({center, radius});
  }

  template <class Others>
  bool
  RandomPlaces::keeps_distance(const Sphere &sphere, const Others &others) const
  {
    const Bin at = bin(sphere.center);
    Bin       b;
    for (b[2] = at[2] - 1; b[2] <= at[2] + 1; ++b[2])
      for (b[1] = at[1] - 1; b[1] <= at[1] + 1; ++b[1])
        for (b[0] = at[0] - 1; b[0] <= at[0] + 1; ++b[0])
          if (const std::vector<Sphere> *in_bin = others(b))
            for (const Sphere &other : *in_bin)
              {
                const double clearance = (1. + gap) * (sphere.radius + other.radius);
                if (other.center.distance_square(sphere.center) < clearance * clearance)
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

  void
  RandomPlaces::draw(const double radius)
  {
    before  = generator;
    n_tried = 0;
    placed.clear();
    tries.resize(n_next);
    n_next = std::min(2 * n_next, most_tries);

    const double room  = (1. + gap) * radius;
    const double reach = tube - room;
    const auto   known = [this](const Bin &b) {
      return is_known(b) ? &bins[number(b)] : nullptr;
    };
    std::vector<unsigned char> is_taken;
    for (Try &now : tries)
      {
        const double rho   = reach * std::sqrt(next_random(generator));
        const double angle = 2. * dealii::numbers::PI * next_random(generator);
        const double z =
          lower + room + (upper - lower - 2. * room) * next_random(generator);
        now.center = dealii::Point<3>(rho * std::cos(angle), rho * std::sin(angle), z);
        is_taken.push_back(!keeps_distance({now.center, radius}, known));
      }
    const int ierr = MPI_Allreduce(MPI_IN_PLACE,
                                   is_taken.data(),
                                   is_taken.size(),
                                   MPI_UNSIGNED_CHAR,
                                   MPI_MAX,
                                   communicator);
    AssertThrowMPI(ierr);
    for (std::size_t k = 0; k < tries.size(); ++k)
      tries[k].is_free = !is_taken[k] && is_inside(tries[k].center, room);
  }

  void
  RandomPlaces::give_back()
  {
    if (!tries.empty())
      {
        generator = before;
        generator.discard(numbers_a_try * n_tried);
      }
    tries.clear();
    n_tried = 0;
    n_next  = fewest_tries;
  }

  bool
  RandomPlaces::place(const double       radius,
                      const unsigned int n_tries,
                      dealii::Point<3>  &center)
  {
    const double room = (1. + gap) * radius;
    if (tube < room || upper - lower < 2. * room)
      return false;
    const auto since = [this](const Bin &b) {
      const auto in_bin = placed.find(b);
      return in_bin == placed.end() ? nullptr : &in_bin->second;
    };
    for (unsigned int attempt = 0; attempt < n_tries; ++attempt)
      {
        if (n_tried == tries.size())
          draw(radius);
        const Try &now = tries[n_tried++];
        center         = now.center;
        if (now.is_free && keeps_distance({center, radius}, since))
          {
            add_obstacle(center, radius);
            return true;
          }
      }
    return false;
  }
} // namespace graupel
