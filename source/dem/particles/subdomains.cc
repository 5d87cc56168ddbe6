// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/rank_messages.h>
#include <graupel/dem/particles/subdomains.h>

#include <boost/serialization/vector.hpp>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    // Of the way from the middle of a flat face to that of the curved one, by which a
    // curved cell may reach out of the box of its vertices.
    constexpr double bulge = 1.5;
    // Of a cell's size, for rounding.
    constexpr double margin = 1e-6;

    dealii::BoundingBox<3>
    box_of(const VesselMesh::CellIterator &cell)
    {
      double more = margin * cell->diameter();
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          more = std::max(more, bulge * face->center(true).distance(face->center()));
      auto box = cell->bounding_box();
      box.extend(more);
      return box;
    }

    template <class T, class Less>
    void
    sort_out_doubles(std::vector<T> &list, const Less &less)
    {
      std::sort(list.begin(), list.end(), less);
      const auto same = [&](const T &a, const T &b) { return !less(a, b); };
      list.erase(std::unique(list.begin(), list.end(), same), list.end());
    }
  } // namespace

  Subdomains::Subdomains(const VesselMesh &mesh, const double reach, const Period &period)
    : mesh(mesh)
    , communicator(mesh.communicator())
    , me(mpi::this_mpi_process(communicator))
    , n_ranks(mpi::n_mpi_processes(communicator))
    , height(mesh.cylinder().height)
    , own_shifts(period.exists()
                   ? std::vector<double>{0., period.length(), -period.length()}
                   : std::vector<double>{0.})
    , corner(-mesh.cylinder().diameter / 2., -mesh.cylinder().diameter / 2., 0.)
    , size(reach)
    , n_bins{}
  {
    const std::array<double, 3> extent{
      {mesh.cylinder().diameter, mesh.cylinder().diameter, height}};
    for (unsigned int d = 0; d < 3; ++d)
      n_bins[d] = static_cast<Bin>(std::ceil(extent[d] / size));
    update();
  }

  void
  Subdomains::update()
  {
    find_box();
    known.clear();
    claims.clear();
    own_receivers.clear();
    own_senders.clear();
    if (!is_needed())
      return;
    const Bins        home_bins = home();
    std::vector<Bins> near{grown(home_bins)};
    publish(home_bins, near[0]);
    for (unsigned int shift = 1; shift < own_shifts.size(); ++shift)
      near.push_back(shifted(near[0], shift));
    ask(near);
    find_neighbors(near);
  }

  Subdomains::Bin
  Subdomains::coordinate(const double x, const unsigned int d) const
  {
    // Points outside the box count to its outermost bins, which keeps
    // neighbours neighbours.
    return static_cast<Bin>(
      std::clamp(std::floor((x - corner[d]) / size), 0., n_bins[d] - 1.));
  }

  Subdomains::Bin
  Subdomains::bin(const dealii::Point<3> &x) const
  {
    return (coordinate(x[2], 2) * n_bins[1] + coordinate(x[1], 1)) * n_bins[0] +
           coordinate(x[0], 0);
  }

  unsigned int
  Subdomains::keeper(const Bin bin) const
  {
    return bin / ((n_bins[0] * n_bins[1] * n_bins[2] + n_ranks - 1) / n_ranks);
  }

  unsigned int
  Subdomains::keeper(const dealii::Point<3> &x) const
  {
    return keeper(bin(x));
  }

  template <class Visit>
  void
  Subdomains::visit_box(const std::array<Bin, 3> &low,
                        const std::array<Bin, 3> &high,
                        const Visit              &visit) const
  {
    for (Bin z = low[2]; z <= high[2]; ++z)
      for (Bin y = low[1]; y <= high[1]; ++y)
        for (Bin x = low[0]; x <= high[0]; ++x)
          visit((z * n_bins[1] + y) * n_bins[0] + x);
  }

  void
  Subdomains::find_box()
  {
    box.reset();
    for (const auto &cell : mesh.owned_cells())
      if (box)
        box->merge_with(box_of(cell));
      else
        box = box_of(cell);
  }

  Subdomains::Bins
  Subdomains::home() const
  {
    Bins bins;
    for (const auto &cell : mesh.owned_cells())
      {
        const auto         box = box_of(cell);
        std::array<Bin, 3> low, high;
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = coordinate(box.lower_bound(d), d);
            high[d] = coordinate(box.upper_bound(d), d);
          }
        visit_box(low, high, [&](const Bin bin) { bins.push_back(bin); });
      }
    sort_out_doubles(bins, std::less<Bin>());
    return bins;
  }

  Subdomains::Bins
  Subdomains::grown(const Bins &bins) const
  {
    Bins result;
    for (const Bin bin : bins)
      {
        const std::array<Bin, 3> at{
          {bin % n_bins[0], bin / n_bins[0] % n_bins[1], bin / (n_bins[0] * n_bins[1])}};
        std::array<Bin, 3> low, high;
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = at[d] - (at[d] > 0);
            high[d] = std::min(at[d] + 1, n_bins[d] - 1);
          }
        visit_box(low, high, [&](const Bin next) { result.push_back(next); });
      }
    sort_out_doubles(result, std::less<Bin>());
    return result;
  }

  Subdomains::Bins
  Subdomains::shifted(const Bins &bins, const unsigned int shift) const
  {
    const Bin in_layer = n_bins[0] * n_bins[1];
    Bins      result;
    for (const Bin bin : bins)
      {
        // The outermost bins hold what is a bin further out as well.
        const Bin    z     = bin / in_layer;
        const double lower = (z == 0 ? -size : z * size) + own_shifts[shift],
                     upper = (z == n_bins[2] - 1 ? height + size : (z + 1) * size) +
                             own_shifts[shift];
        if (upper < -size || lower > height + size)
          continue;
        for (Bin at = coordinate(lower, 2); at <= coordinate(upper, 2); ++at)
          result.push_back(at * in_layer + bin % in_layer);
      }
    sort_out_doubles(result, std::less<Bin>());
    return result;
  }

  void
  Subdomains::publish(const Bins &home, const Bins &near)
  {
    ByRank<std::vector<Claim>> mine;
    for (const Bin bin : near)
      mine[keeper(bin)].push_back(
        {bin, me, std::binary_search(home.begin(), home.end(), bin)});
    for (const auto &[rank, of_rank] : send_parts(mine, communicator))
      claims.insert(claims.end(), of_rank.begin(), of_rank.end());
    std::sort(claims.begin(), claims.end(), [](const Claim &a, const Claim &b) {
      return std::tie(a.bin, a.rank) < std::tie(b.bin, b.rank);
    });
  }

  std::vector<Subdomains::Claim>
  Subdomains::claims_on(const Bins &asked) const
  {
    std::vector<Claim> found;
    for (const Bin bin : asked)
      for (auto claim = std::lower_bound(
             claims.begin(),
             claims.end(),
             bin,
             [](const Claim &a, const Bin searched) { return a.bin < searched; });
           claim != claims.end() && claim->bin == bin;
           ++claim)
        found.push_back(*claim);
    return found;
  }

  void
  Subdomains::ask(const std::vector<Bins> &near)
  {
    Bins all;
    for (const auto &bins : near)
      all.insert(all.end(), bins.begin(), bins.end());
    sort_out_doubles(all, std::less<Bin>());
    ByRank<Bins> asked;
    for (const Bin bin : all)
      {
        asked[keeper(bin)].push_back(bin);
        known[bin];
      }
    const auto answers = ask_ranks<std::vector<Claim>, Bins>(
      asked, [this](const Bins &bins) { return claims_on(bins); }, communicator);
    // Of a bin they are in the order of the ranks.
    for (const auto &[rank, found] : answers)
      for (const Claim &claim : found)
        {
          Surroundings &at = known[claim.bin];
          if (claim.rank != me || own_shifts.size() > 1)
            at.seen_by.push_back(claim.rank);
          if (claim.is_home && claim.rank == me)
            at.is_home = true;
          else if (claim.is_home)
            at.home_of = std::min(at.home_of, claim.rank);
        }
  }

  void
  Subdomains::find_neighbors(const std::vector<Bins> &near)
  {
    for (unsigned int shift = 0; shift < near.size(); ++shift)
      for (const Bin bin : near[shift])
        for (const unsigned int rank : known.at(bin).seen_by)
          if (rank != me || shift > 0)
            own_receivers.push_back({rank, shift});
    sort_out_doubles(own_receivers, std::less<Neighbor>());

    ByRank<std::vector<unsigned int>> told;
    for (const Neighbor &receiver : own_receivers)
      told[receiver.rank].push_back(receiver.shift);
    for (const auto &[rank, with] : send_parts(told, communicator))
      for (const unsigned int shift : with)
        own_senders.push_back({rank, shift});
  }

  const Subdomains::Surroundings *
  Subdomains::surroundings(const dealii::Point<3> &x) const
  {
    const auto found = known.find(bin(x));
    return found == known.end() ? nullptr : &found->second;
  }

  bool
  Subdomains::is_near_vessel(const dealii::Point<3> &x, const unsigned int shift) const
  {
    return shift == 0 || (x[2] >= -size && x[2] <= height + size);
  }

  std::vector<std::vector<unsigned int>>
  Subdomains::ranks_at(const std::vector<dealii::Point<3>> &points) const
  {
    ByRank<Bins> asked;
    for (const auto &point : points)
      asked[keeper(point)].push_back(bin(point));
    for (auto &[rank, bins] : asked)
      sort_out_doubles(bins, std::less<Bin>());
    const auto answers = ask_ranks<std::vector<Claim>, Bins>(
      asked, [this](const Bins &bins) { return claims_on(bins); }, communicator);
    std::unordered_map<Bin, std::vector<unsigned int>> ranks;
    for (const auto &[rank, found] : answers)
      for (const Claim &claim : found)
        if (claim.is_home)
          ranks[claim.bin].push_back(claim.rank);
    std::vector<std::vector<unsigned int>> result;
    for (const auto &point : points)
      result.push_back(ranks[bin(point)]);
    return result;
  }
} // namespace graupel
