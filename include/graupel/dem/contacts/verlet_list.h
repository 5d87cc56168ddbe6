// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_contacts_verlet_list_h
#define graupel_dem_contacts_verlet_list_h

#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/walls/walls.h>

#include <vector>

namespace graupel
{
  /** Rows of two neighbours; the first has the lower id. */
  struct NeighborPair
  {
    std::uint32_t first;
    std::uint32_t second;
  };

  /** For each row the rows that it touches, to tell pairs that are contacts. */
  struct TouchingRows
  {
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> partners;

    bool
    contains(const std::uint32_t row, const std::uint32_t partner) const
    {
      return std::find(partners.begin() + starts[row],
                       partners.begin() + starts[row + 1],
                       partner) != partners.begin() + starts[row + 1];
    }
  };

  /**
   * Who can touch whom but does not: every pair of rows, once, that has at least
   * one own particle, is closer than the sum of their radii plus the skin, and is
   * not a contact already; and, for each wall, the own rows that are that close to
   * it.
   *
   * Distances are those between the places at which the particles were listed.
   * The list is complete while no particle is farther than half the skin from
   * that place; a particle that goes farther is listed anew, by itself: in a bed
   * on which particles rain only the rain is.
   *
   * The pairs are kept in two parts. The near ones are those that can touch while
   * no particle moves by half the near skin; only they are looked at each substep.
   */
  class VerletList
  {
  public:
    /** Who has gone this part of the skin is listed anew along with those that must be,
     * so that the next time is later [-]. */
    static constexpr double moving_part = 0.05;

    /** @p skin and @p near_skin: distances added to that of touching [m]. */
    VerletList(const double skin, const double near_skin);

    /** Forgets everything: rows have new numbers. */
    void clear();

    /** Some own rows have gone, and all others are listed: @p new_row of each old own
     * row, or no_row. Ghosts are forgotten. */
    void                           renumber(const std::vector<std::uint32_t> &new_row);
    static constexpr std::uint32_t no_row = -1;

    /**
     * Lists all particles anew that are farther than a small part of the skin from
     * their listed place or are not listed yet, and all ghosts; with @p only_ghosts of
     * the own ones only those that are not listed yet. Sets all near pairs.
     * @p touching: the contacts, which stay out of the list.
     */
    void build(const ParticleArrays    &particles,
               const std::vector<Wall> &walls,
               const TouchingRows      &touching,
               const bool               only_ghosts = false);

    /** Sorts the pairs into near and far ones by their present distance. */
    void sort_by_distance(const ParticleArrays &particles);

    /** Largest distance of an own particle from its listed place [m]; infinite
     * if one is not listed. */
    double largest_move(const ParticleArrays &particles) const;

    /** The same of the ghosts. */
    double largest_move_of_ghosts(const ParticleArrays &particles) const;

    /** Pairs that can touch soon. */
    std::vector<NeighborPair> near;
    /** All others. */
    std::vector<NeighborPair> far;
    /** The own rows near each wall, in the order of the walls. */
    std::vector<std::vector<std::uint32_t>> wall_rows;

  private:
    void   choose_movers(const ParticleArrays &particles, const bool only_ghosts);
    double largest_move(const ParticleArrays &particles,
                        const unsigned int    begin,
                        const unsigned int    end) const;
    void   drop_pairs_of_movers();
    void find_wall_rows(const ParticleArrays &particles, const std::vector<Wall> &walls);
    void sort_near_if_needed();
    void sort_into_bins(const ParticleArrays &particles, const double bin_size);
    void find_pairs(const ParticleArrays &particles, const TouchingRows &touching);
    void find_pairs_of(const std::uint32_t   row,
                       const ParticleArrays &particles,
                       const TouchingRows   &touching);

    const double skin;
    const double near_skin;

    // Where each row was listed, how many of them were own rows then and still
    // have their number, and which ones are listed anew now.
    std::vector<dealii::Point<3>> listed;
    unsigned int                  n_listed = 0;
    std::vector<unsigned char>    moves;

    // Bins over the bounding box of all rows. The rows of bin b, in ascending
    // order, are number begin[b] to begin[b + 1] - 1 in the sorted arrays.
    std::array<int, 3>         n_bins;
    std::vector<unsigned int>  bin_of_row;
    std::vector<unsigned int>  begin;
    std::vector<std::uint32_t> sorted_row;
    std::vector<double>        sorted_x, sorted_y, sorted_z, sorted_radius;
  };
} // namespace graupel

#endif
