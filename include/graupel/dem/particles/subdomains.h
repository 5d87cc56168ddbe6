// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_subdomains_h
#define graupel_dem_particles_subdomains_h

#include <graupel/dem/numbers/period.h>
#include <graupel/mesh/vessel_mesh.h>

#include <cstdint>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace graupel
{
  /**
   * Which ranks have cells near a place. The vessel is cut into bins, boxes that are at
   * least as long as the reach within which a rank must see particles; a rank is at home
   * in the bins that its cells touch.
   *
   * No rank knows the whole: each knows its own bins and those next to them. Of all
   * others, an even share of the bins is kept by each rank, which is asked: so memory and
   * messages are those of a rank's own cells, on any number of ranks.
   */
  class Subdomains
  {
  public:
    /** Number of a bin. */
    using Bin = std::uint64_t;

    /**
     * @p reach: the edge of a bin [m]. With a @p period what is near the one end is near
     * the other as well. @p mesh must outlive this object. Collective.
     */
    Subdomains(const VesselMesh &mesh, const double reach, const Period &period);

    /** Looks at the mesh anew, after its cells or their owners have changed. Collective.
     */
    void update();

    /** A rank to which particles may have to be shown, at a height that is another by
     * shifts()[shift]. */
    struct Neighbor
    {
      unsigned int rank;
      unsigned int shift;

      bool
      operator<(const Neighbor &other) const
      {
        return std::tie(rank, shift) < std::tie(other.rank, other.shift);
      }
    };

    /** Those that must see own particles, if there are any near them; in order. */
    const std::vector<Neighbor> &
    receivers() const
    {
      return own_receivers;
    }

    /** Those of which this rank is a receiver, with the shift of what they send. */
    const std::vector<Neighbor> &
    senders() const
    {
      return own_senders;
    }

    /** Added to the heights of copies [m]: 0, and with periodic ends up and down by the
     * period. */
    const std::vector<double> &
    shifts() const
    {
      return own_shifts;
    }

    /** Whether there can be copies at all: another rank, or an end that is the other. */
    bool
    is_needed() const
    {
      return n_ranks > 1 || own_shifts.size() > 1;
    }

    static constexpr unsigned int nobody = -1;

    /** Where an own particle is, and who else must know. */
    struct Surroundings
    {
      /** Whether own cells touch the bin. */
      bool is_home = false;
      /** Ranks that must see what is in the bin. */
      std::vector<unsigned int> seen_by;
      /** The lowest other rank that is at home in it, or nobody. */
      unsigned int home_of = nobody;
    };

    /**
     * What is known of the bin of @p x; null if it is neither home, next to home, nor
     * seen through periodic ends from there.
     */
    const Surroundings *surroundings(const dealii::Point<3> &x) const;

    /** Whether @p x with a shift can be near anything at all. */
    bool is_near_vessel(const dealii::Point<3> &x, const unsigned int shift) const;

    /** For each point the ranks that are at home in its bin, in order. Collective. */
    std::vector<std::vector<unsigned int>> ranks_at(
      const std::vector<dealii::Point<3>> &points) const;

    /** A box around all own cells; none without cells. */
    const std::optional<dealii::BoundingBox<3>> &
    own_box() const
    {
      return box;
    }

    /** The rank that is asked of the bin of @p x: the same on all ranks. */
    unsigned int keeper(const dealii::Point<3> &x) const;

  private:
    // That a rank is at home in a bin or, if not, next to home.
    struct Claim
    {
      Bin          bin     = 0;
      unsigned int rank    = nobody;
      bool         is_home = false;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &bin &rank &is_home;
      }
    };

    using Bins = std::vector<Bin>; // in order

    Bin          bin(const dealii::Point<3> &x) const;
    Bin          coordinate(const double x, const unsigned int d) const;
    unsigned int keeper(const Bin bin) const;
    Bins         home() const;
    void         find_box();
    template <class Visit>
    void               visit_box(const std::array<Bin, 3> &low,
                                 const std::array<Bin, 3> &high,
                                 const Visit              &visit) const;
    Bins               grown(const Bins &bins) const;
    Bins               shifted(const Bins &bins, const unsigned int shift) const;
    void               publish(const Bins &home, const Bins &near);
    void               ask(const std::vector<Bins> &near);
    void               find_neighbors(const std::vector<Bins> &near);
    std::vector<Claim> claims_on(const Bins &asked) const;

    const VesselMesh   &mesh;
    const MPI_Comm      communicator;
    const unsigned int  me, n_ranks;
    const double        height;
    std::vector<double> own_shifts;
    dealii::Point<3>    corner;
    double              size; // of a bin [m]
    std::array<Bin, 3>  n_bins;

    std::optional<dealii::BoundingBox<3>> box;
    std::unordered_map<Bin, Surroundings> known;
    std::vector<Neighbor>                 own_receivers, own_senders;
    // Of the bins that this rank keeps, in their order.
    std::vector<Claim> claims;
  };
} // namespace graupel

#endif
