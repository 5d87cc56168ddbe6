// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/contact_geometry.h>
#include <graupel/dem/contacts/contact_sweep.h>

#include <limits>
#include <numeric>
#include <tuple>

namespace graupel
{
  void
  ContactSweep::sort()
  {
    for (auto *lists : {&pair_lists, &wall_lists})
      for (auto &list : *lists)
        list.sort_if_needed();
  }

  std::vector<LooseContact>
  ContactSweep::contacts_of(const ParticleArrays             &particles,
                            const std::vector<std::uint32_t> &rows) const
  {
    std::vector<unsigned char> wanted(particles.n_rows(), 0);
    for (const auto row : rows)
      wanted[row] = 1;
    std::vector<LooseContact> contacts;
    for (const auto &list : pair_lists)
      for (std::size_t k = 0; k < list.size(); ++k)
        if (wanted[list.first(k)] || wanted[list.second(k)])
          contacts.push_back(
            {particles.id[list.first(k)], particles.id[list.second(k)], list.springs(k)});
    for (unsigned int w = 0; w < wall_lists.size(); ++w)
      for (std::size_t k = 0; k < wall_lists[w].size(); ++k)
        if (wanted[wall_lists[w].first(k)])
          contacts.push_back({particles.id[wall_lists[w].first(k)],
                              wall_id(w / n_types, wall_lists[w].second(k)),
                              wall_lists[w].springs(k)});
    return contacts;
  }

  void
  ContactSweep::clear()
  {
    for (auto *lists : {&pair_lists, &wall_lists})
      for (auto &list : *lists)
        list.clear();
  }

  void
  ContactSweep::leave_wall(const unsigned int wall)
  {
    for (unsigned int type = 0; type < n_types; ++type)
      wall_lists[wall * n_types + type].clear();
    idle_rows[wall].clear();
  }

  std::vector<LooseContact>
  ContactSweep::renumber(const std::vector<std::int64_t>  &old_ids,
                         const std::vector<std::uint32_t> &new_row)
  {
    const auto number = [&](const std::uint32_t row) {
      return row < new_row.size() ? new_row[row] : no_row;
    };
    std::vector<LooseContact> loose;
    for (auto &list : pair_lists)
      for (std::size_t k = list.size(); k-- > 0;)
        {
          const auto i = number(list.first(k)), j = number(list.second(k));
          if (i != no_row && j != no_row)
            {
              list.first(k)  = i;
              list.second(k) = j;
              continue;
            }
          if (i != no_row || j != no_row)
            loose.push_back(
              {old_ids[list.first(k)], old_ids[list.second(k)], list.springs(k)});
          list.remove(k);
        }
    for (auto &list : wall_lists)
      for (std::size_t k = list.size(); k-- > 0;)
        if (number(list.first(k)) == no_row)
          list.remove(k);
        else
          list.first(k) = number(list.first(k));
    return loose;
  }

  void
  ContactSweep::add(const ParticleArrays &particles, std::vector<LooseContact> contacts)
  {
    if (contacts.empty())
      return;
    const auto key = [](const LooseContact &c) { return std::tie(c.first, c.second); };
    std::sort(contacts.begin(), contacts.end(), [&](const auto &a, const auto &b) {
      return key(a) < key(b);
    });
    contacts.erase(
      std::unique(contacts.begin(),
                  contacts.end(),
                  [&](const auto &a, const auto &b) { return key(a) == key(b); }),
      contacts.end());

    std::vector<std::pair<std::int64_t, std::uint32_t>> rows;
    for (std::uint32_t row = 0; row < particles.n_rows(); ++row)
      rows.emplace_back(particles.id[row], row);
    std::sort(rows.begin(), rows.end());
    // Of the rows of one id (periodic ends make images) the one nearest to a place.
    const auto nearest = [&](const std::int64_t id, const std::uint32_t other) {
      auto row = std::lower_bound(rows.begin(), rows.end(), std::make_pair(id, 0u));
      std::uint32_t best  = no_row;
      double        least = std::numeric_limits<double>::infinity();
      for (; row != rows.end() && row->first == id; ++row)
        {
          const double distance = particles.body[row->second].position.distance_square(
            particles.body[other].position);
          if (distance < least)
            {
              least = distance;
              best  = row->second;
            }
        }
      return best;
    };
    const auto own_row = [&](const std::int64_t id) {
      const auto row = std::lower_bound(rows.begin(), rows.end(), std::make_pair(id, 0u));
      return row != rows.end() && row->first == id && row->second < particles.n_owned
               ? row->second
               : no_row;
    };

    for (const auto &contact : contacts)
      {
        const auto i = own_row(contact.first);
        if (contact.second < 0)
          {
            if (i != no_row)
              wall_lists[wall_of(contact.second) * n_types + particles.type[i]].add(
                i, facet_of(contact.second), contact.springs);
            continue;
          }
        // Each own partner touches the nearest copy of the other; two own ones each
        // other, or each an image.
        const auto j = own_row(contact.second);
        if (i != no_row)
          {
            const auto partner = nearest(contact.second, i);
            if (partner != no_row)
              pair_list(particles, {i, partner}).add(i, partner, contact.springs);
            if (partner == j)
              continue;
          }
        if (j != no_row)
          {
            const auto partner = nearest(contact.first, j);
            if (partner != no_row)
              pair_list(particles, {partner, j}).add(partner, j, contact.springs);
          }
      }
  }

  TouchingRows
  ContactSweep::touching_rows(const unsigned int n_rows) const
  {
    TouchingRows touching;
    touching.starts.assign(n_rows + 1, 0);
    const auto each = [&](const auto &visit) {
      for (const auto &list : pair_lists)
        for (std::size_t k = 0; k < list.size(); ++k)
          {
            visit(list.first(k), list.second(k));
            visit(list.second(k), list.first(k));
          }
    };
    each([&](const std::uint32_t i, const std::uint32_t) { ++touching.starts[i + 1]; });
    std::partial_sum(
      touching.starts.begin(), touching.starts.end(), touching.starts.begin());
    touching.partners.resize(touching.starts.back());
    std::vector<std::uint32_t> next(touching.starts.begin(), touching.starts.end() - 1);
    each([&](const std::uint32_t i, const std::uint32_t j) {
      touching.partners[next[i]++] = j;
    });
    return touching;
  }

  void
  ContactSweep::watch_walls(const VerletList &list, const std::vector<Wall> &walls)
  {
    std::vector<std::uint32_t> touching;
    for (unsigned int w = 0; w < n_walls; ++w)
      {
        touching.clear();
        // A surface may be touched at several places: its rows all stay.
        for (unsigned int t = 0; t < n_types && !is_surface(walls[w]); ++t)
          for (std::size_t k = 0; k < wall_lists[w * n_types + t].size(); ++k)
            touching.push_back(wall_lists[w * n_types + t].first(k));
        std::sort(touching.begin(), touching.end());
        idle_rows[w].clear();
        std::set_difference(list.wall_rows[w].begin(),
                            list.wall_rows[w].end(),
                            touching.begin(),
                            touching.end(),
                            std::back_inserter(idle_rows[w]));
      }
  }

  std::size_t
  ContactSweep::n_touching_pairs(const ParticleArrays &particles) const
  {
    std::size_t n = 0;
    for (const auto &list : pair_lists)
      for (std::size_t k = 0; k < list.size(); ++k)
        n += list.first(k) < particles.n_owned;
    return n;
  }

  std::size_t
  ContactSweep::n_touching_walls() const
  {
    std::size_t n = 0;
    for (const auto &list : wall_lists)
      n += list.size();
    return n;
  }

  std::size_t
  ContactSweep::n_contacts() const
  {
    std::size_t n = n_touching_walls();
    for (const auto &list : pair_lists)
      n += list.size();
    return n;
  }
} // namespace graupel
