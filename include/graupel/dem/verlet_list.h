#ifndef graupel_dem_verlet_list_h
#define graupel_dem_verlet_list_h

#include <graupel/dem/particle_arrays.h>
#include <graupel/dem/walls.h>

#include <vector>

namespace graupel
{
  /** Rows of two neighbours; the first has the lower id. */
  struct NeighborPair
  {
    unsigned int first;
    unsigned int second;
  };

  /**
   * Who can touch whom until some particle has moved by half the skin: every
   * pair of rows closer than the sum of their radii plus the skin, once, that
   * has at least one own particle; and, for each wall, the own rows that are
   * that close to it.
   */
  class VerletList
  {
  public:
    /** @p skin: distance added to that of touching [m]. */
    explicit VerletList(const double skin);

    /** Finds all neighbours from the present positions. */
    void build(const ParticleArrays &particles, const std::vector<Wall> &walls);

    /** The pairs, ordered by the first-found row, for locality. */
    std::vector<NeighborPair> pairs;
    /** The own rows near each wall, in the order of the walls. */
    std::vector<std::vector<unsigned int>> wall_rows;

  private:
    void sort_into_bins(const ParticleArrays &particles, const double bin_size);
    void find_pairs(const ParticleArrays &particles);

    const double skin;

    // Bins over the bounding box of all rows: the rows of bin b, in ascending
    // order, are rows[begin[b]] .. rows[begin[b + 1] - 1].
    std::array<int, 3>        n_bins;
    std::vector<unsigned int> bin_of_row;
    std::vector<unsigned int> begin;
    std::vector<unsigned int> rows;
  };
} // namespace graupel

#endif
