// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/verlet_list.h>
#include <graupel/dem/numbers/lanes.h>

#include <limits>
#include <numeric>

namespace graupel
{
  namespace
  {
    // More bins than this many per particle cost more to walk than they save;
    // the box of a rank with a few stray particles could have millions.
    constexpr double bins_per_particle = 8.;
  } // namespace

  VerletList::VerletList(const double skin, const double near_skin)
    : skin(skin)
    , near_skin(near_skin)
  {
  }

  void
  VerletList::clear()
  {
    near.clear();
    far.clear();
    n_listed = 0;
    wall_rows.clear();
  }

  void
  VerletList::build(const ParticleArrays    &particles,
                    const std::vector<Wall> &walls,
                    const TouchingRows      &touching,
                    const bool               only_ghosts)
  {
    wall_rows.resize(walls.size());
    choose_movers(particles, only_ghosts);
    drop_pairs_of_movers();
    n_listed = particles.n_owned;
    if (particles.n_owned == 0)
      return;

    double largest = 0.;
    for (const auto &body : particles.body)
      largest = std::max(largest, body.radius);
    sort_into_bins(particles, 2. * largest + skin);
    find_pairs(particles, touching);
    sort_by_distance(particles);
    sort_near_if_needed();

    find_wall_rows(particles, walls);
  }

  void
  VerletList::find_wall_rows(const ParticleArrays    &particles,
                             const std::vector<Wall> &walls)
  {
    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        // A wall that moves comes nearer to all.
        auto      &rows   = wall_rows[w];
        const bool all    = walls[w].course.moves();
        const auto is_old = [&](const std::uint32_t row) {
          return all || row >= particles.n_owned || moves[row];
        };
        rows.erase(std::remove_if(rows.begin(), rows.end(), is_old), rows.end());
        for (unsigned int i = 0; i < particles.n_owned; ++i)
          if ((all || moves[i]) &&
              walls[w].is_near(listed[i], particles.body[i].radius + skin))
            rows.push_back(i);
        std::sort(rows.begin(), rows.end());
      }
  }

  void
  VerletList::sort_near_if_needed()
  {
    // In the order of the rows the loop over pairs finds the particles in the cache.
    std::size_t descents = 0;
    for (std::size_t k = 1; k < near.size(); ++k)
      descents += near[k].first < near[k - 1].first;
    if (20 * descents > near.size())
      std::sort(
        near.begin(), near.end(), [](const NeighborPair &a, const NeighborPair &b) {
          return a.first < b.first;
        });
  }

  void
  VerletList::choose_movers(const ParticleArrays &particles, const bool only_ghosts)
  {
    const double limit = moving_part * moving_part * skin * skin;
    listed.resize(particles.n_rows());
    moves.assign(particles.n_rows(), 1);
    for (unsigned int i = 0; i < particles.n_rows(); ++i)
      {
        const auto &x = particles.body[i].position;
        if (i < n_listed && (only_ghosts || x.distance_square(listed[i]) < limit))
          moves[i] = 0;
        else
          listed[i] = x;
      }
  }

  double
  VerletList::largest_move(const ParticleArrays &particles,
                           const unsigned int    begin,
                           const unsigned int    end) const
  {
    double farthest = 0.;
    for (unsigned int i = begin; i < end; ++i)
      farthest =
        std::max(farthest, particles.body[i].position.distance_square(listed[i]));
    return std::sqrt(farthest);
  }

  double
  VerletList::largest_move(const ParticleArrays &particles) const
  {
    return n_listed < particles.n_owned ? std::numeric_limits<double>::infinity()
                                        : largest_move(particles, 0, particles.n_owned);
  }

  double
  VerletList::largest_move_of_ghosts(const ParticleArrays &particles) const
  {
    return largest_move(particles, particles.n_owned, particles.n_rows());
  }

  void
  VerletList::renumber(const std::vector<std::uint32_t> &new_row)
  {
    if (n_listed == 0)
      return;
    const auto number = [&](const std::uint32_t row) {
      return row < new_row.size() ? new_row[row] : no_row;
    };
    for (auto *pairs : {&near, &far})
      {
        std::size_t kept = 0;
        for (const auto pair : *pairs)
          if (number(pair.first) != no_row && number(pair.second) != no_row)
            (*pairs)[kept++] = {number(pair.first), number(pair.second)};
        pairs->resize(kept);
      }
    for (auto &rows : wall_rows)
      {
        std::size_t kept = 0;
        for (const auto row : rows)
          if (number(row) != no_row)
            rows[kept++] = number(row);
        rows.resize(kept);
        std::sort(rows.begin(), rows.end());
      }
    n_listed = 0;
    for (std::uint32_t row = 0; row < new_row.size(); ++row)
      if (new_row[row] != no_row)
        {
          listed[new_row[row]] = listed[row];
          ++n_listed;
        }
  }

  void
  VerletList::drop_pairs_of_movers()
  {
    const auto drop = [&](const NeighborPair pair) {
      return pair.first >= n_listed || pair.second >= n_listed || moves[pair.first] ||
             moves[pair.second];
    };
    for (auto *pairs : {&near, &far})
      pairs->erase(std::remove_if(pairs->begin(), pairs->end(), drop), pairs->end());
  }

  void
  VerletList::sort_into_bins(const ParticleArrays &particles, const double bin_size)
  {
    const unsigned int n   = particles.n_rows();
    dealii::Point<3>   low = listed[0], high = low;
    for (const auto &x : listed)
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }

    const auto extent = high - low;
    double     size   = bin_size;
    const auto count  = [&](const unsigned int d) {
      return 1. + std::floor(extent[d] / size);
    };
    while (count(0) * count(1) * count(2) > 64. + bins_per_particle * n)
      size *= 1.25;
    for (unsigned int d = 0; d < 3; ++d)
      n_bins[d] = static_cast<int>(count(d));

    bin_of_row.resize(n);
    begin.assign(n_bins[0] * n_bins[1] * n_bins[2] + 1, 0);
    const double inverse = 1. / size;
    for (unsigned int i = 0; i < n; ++i)
      {
        std::array<int, 3> b;
        for (unsigned int d = 0; d < 3; ++d)
          b[d] =
            std::min(static_cast<int>((listed[i][d] - low[d]) * inverse), n_bins[d] - 1);
        bin_of_row[i] = (b[2] * n_bins[1] + b[1]) * n_bins[0] + b[0];
        ++begin[bin_of_row[i] + 1];
      }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());

    // Room for a register beyond the end.
    for (auto *array : {&sorted_x, &sorted_y, &sorted_z, &sorted_radius})
      array->resize(n + n_lanes);
    sorted_row.resize(n);
    std::vector<unsigned int> next(begin.begin(), begin.end() - 1);
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int k = next[bin_of_row[i]]++;
        sorted_row[k]        = i;
        sorted_x[k]          = listed[i][0];
        sorted_y[k]          = listed[i][1];
        sorted_z[k]          = listed[i][2];
        sorted_radius[k]     = particles.body[i].radius;
      }
  }

  void
  VerletList::find_pairs(const ParticleArrays &particles, const TouchingRows &touching)
  {
    for (unsigned int i = 0; i < particles.n_rows(); ++i)
      if (moves[i])
        find_pairs_of(i, particles, touching);
  }

  void
  VerletList::find_pairs_of(const std::uint32_t   i,
                            const ParticleArrays &particles,
                            const TouchingRows   &touching)
  {
    // Of two movers the lower row finds the pair, and of two ghosts none.
    const bool ghost   = i >= particles.n_owned;
    const auto propose = [&](const std::uint32_t j) {
      if (particles.id[j] == particles.id[i] || (moves[j] && j < i) ||
          (ghost && j >= particles.n_owned))
        return;
      // A contact that comes apart in this very substep still is one.
      if (touching.contains(i, j))
        return;
      if (particles.id[i] < particles.id[j])
        far.push_back({i, j});
      else
        far.push_back({j, i});
    };

    const int   x       = bin_of_row[i] % n_bins[0];
    const int   y       = bin_of_row[i] / n_bins[0] % n_bins[1];
    const int   z       = bin_of_row[i] / (n_bins[0] * n_bins[1]);
    const int   first_x = std::max(x - 1, 0), last_x = std::min(x + 1, n_bins[0] - 1);
    const Lanes own_x = listed[i][0], own_y = listed[i][1], own_z = listed[i][2];
    const Lanes own_reach = particles.body[i].radius + skin;
    for (int c = std::max(z - 1, 0); c <= std::min(z + 1, n_bins[2] - 1); ++c)
      for (int b = std::max(y - 1, 0); b <= std::min(y + 1, n_bins[1] - 1); ++b)
        {
          // Three bins in a row along x are contiguous.
          const int          line = (c * n_bins[1] + b) * n_bins[0];
          const unsigned int end  = begin[line + last_x + 1];
          for (unsigned int k = begin[line + first_x]; k < end; k += n_lanes)
            {
              using std::experimental::element_aligned;
              const Lanes dx    = Lanes(&sorted_x[k], element_aligned) - own_x;
              const Lanes dy    = Lanes(&sorted_y[k], element_aligned) - own_y;
              const Lanes dz    = Lanes(&sorted_z[k], element_aligned) - own_z;
              const Lanes reach = Lanes(&sorted_radius[k], element_aligned) + own_reach;
              const auto  close = dx * dx + dy * dy + dz * dz < reach * reach;
              if (some(close))
                for (unsigned int l = 0; l < std::min(n_lanes, end - k); ++l)
                  if (close[l])
                    propose(sorted_row[k + l]);
            }
        }
  }

  void
  VerletList::sort_by_distance(const ParticleArrays &particles)
  {
    const auto is_near = [&](const NeighborPair pair) {
      const Body  &a = particles.body[pair.first], &b = particles.body[pair.second];
      const double reach = a.radius + b.radius + near_skin;
      return a.position.distance_square(b.position) < reach * reach;
    };

    std::size_t kept = 0;
    const auto  n    = near.size();
    for (std::size_t k = 0; k < n; ++k)
      if (is_near(near[k]))
        near[kept++] = near[k];
      else
        far.push_back(near[k]);
    near.resize(kept);

    kept = 0;
    for (const auto pair : far)
      if (is_near(pair))
        near.push_back(pair);
      else
        far[kept++] = pair;
    far.resize(kept);
  }
} // namespace graupel
