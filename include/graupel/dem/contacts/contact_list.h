// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_contacts_contact_list_h
#define graupel_dem_contacts_contact_list_h

#include <graupel/dem/laws/contact_laws.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace graupel
{
  /**
   * The touching contacts of one kind (two types of particles, or a type and a
   * wall), with their springs, packed without holes in blocks of as many as there
   * are lanes. The order means nothing; rows are those of the ParticleArrays.
   */
  class ContactList
  {
  public:
    /** Contacts of one pass of the contact loop, component by component. */
    struct alignas(64) Block
    {
      double        springs[6][n_lanes];
      std::uint32_t first[n_lanes];
      std::uint32_t second[n_lanes];
    };

    std::size_t
    size() const
    {
      return n;
    }

    /** Contacts from this one on have begun in the present substep. */
    std::size_t
    first_fresh() const
    {
      return fresh;
    }

    /** Calls all contacts old. */
    void
    age()
    {
      fresh = n;
    }

    /**
     * Sorts by the first row, if many contacts have begun since the last time:
     * then the loop over contacts finds the particles in the cache. Only while
     * there are no fresh ones.
     */
    void
    sort_if_needed()
    {
      if (appended * 20 >= n)
        sort();
    }

    /** Sorts by the first row, then the second. Only while there are no fresh ones. */
    void
    sort()
    {
      std::vector<std::pair<std::uint64_t, std::uint32_t>> order(n);
      for (std::size_t k = 0; k < n; ++k)
        order[k] = {(static_cast<std::uint64_t>(first(k)) << 32) | second(k), k};
      std::sort(order.begin(), order.end());
      ContactList sorted;
      sorted.blocks.reserve(blocks.size());
      for (const auto &[rows, k] : order)
        sorted.add(first(k), second(k), springs(k));
      *this    = std::move(sorted);
      appended = 0;
    }

    void
    clear()
    {
      blocks.clear();
      n = fresh = appended = 0;
    }

    /** Adds an old contact; only while there are no fresh ones. */
    void
    add(const std::uint32_t first, const std::uint32_t second, const Springs<double> &s)
    {
      append(first, second, s);
      fresh = n;
    }

    /** Adds a contact that begins in this substep. */
    void
    begin(const std::uint32_t first, const std::uint32_t second)
    {
      append(first, second, Springs<double>{});
    }

    /** Removes a contact; the last one takes its number. */
    void
    remove(const std::size_t k)
    {
      const std::size_t last = n - 1;
      Block            &to = blocks[k / n_lanes], &from = blocks[last / n_lanes];
      for (auto &component : to.springs)
        component[k % n_lanes] = from.springs[&component - to.springs][last % n_lanes];
      to.first[k % n_lanes]  = from.first[last % n_lanes];
      to.second[k % n_lanes] = from.second[last % n_lanes];
      n                      = last;
      fresh                  = std::min(fresh, n);
      if (n % n_lanes == 0)
        blocks.pop_back();
    }

    std::uint32_t &
    first(const std::size_t k)
    {
      return blocks[k / n_lanes].first[k % n_lanes];
    }

    std::uint32_t
    first(const std::size_t k) const
    {
      return blocks[k / n_lanes].first[k % n_lanes];
    }

    std::uint32_t &
    second(const std::size_t k)
    {
      return blocks[k / n_lanes].second[k % n_lanes];
    }

    std::uint32_t
    second(const std::size_t k) const
    {
      return blocks[k / n_lanes].second[k % n_lanes];
    }

    Springs<double>
    springs(const std::size_t k) const
    {
      const auto        &s = blocks[k / n_lanes].springs;
      const unsigned int l = k % n_lanes;
      return {{s[0][l], s[1][l], s[2][l]}, {s[3][l], s[4][l], s[5][l]}};
    }

    /** The blocks; lanes from size() on in the last one name valid rows. */
    std::vector<Block> blocks;

  private:
    void
    append(const std::uint32_t    first,
           const std::uint32_t    second,
           const Springs<double> &s)
    {
      const unsigned int l = n % n_lanes;
      if (l == 0)
        blocks.push_back(Block{});
      Block       &block      = blocks.back();
      const double numbers[6] = {s.tangential.x,
                                 s.tangential.y,
                                 s.tangential.z,
                                 s.rolling.x,
                                 s.rolling.y,
                                 s.rolling.z};
      for (unsigned int c = 0; c < 6; ++c)
        block.springs[c][l] = numbers[c];
      block.first[l]  = first;
      block.second[l] = second;
      ++n;
      ++appended;
    }

    std::size_t n     = 0;
    std::size_t fresh = 0;
    // Since the last sort.
    std::size_t appended = 0;
  };
} // namespace graupel

#endif
