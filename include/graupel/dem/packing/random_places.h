// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_packing_random_places_h
#define graupel_dem_packing_random_places_h

#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/walls/walls.h>

#include <deal.II/base/bounding_box.h>

#include <map>
#include <optional>
#include <random>
#include <vector>

namespace graupel
{
  /** The next number of @p generator, even between 0 and 1. The standard leaves the
   * distributions to the library; this is the same everywhere. */
  inline double
  next_random(std::mt19937_64 &generator)
  {
    return static_cast<double>(generator() >> 11) * 0x1p-53;
  }

  /**
   * Random places for spheres between two heights of a vessel, each at a distance
   * of all others and of the walls (random sequential addition). The same on any number
   * of ranks.
   *
   * All ranks try the same places, and each knows the spheres near its own cells alone.
   * So places are drawn in advance, some at a time, and each rank says which of them are
   * taken; what is not used of them is given back to the random numbers.
   */
  class RandomPlaces
  {
  public:
    /**
     * @p walls of the vessel beside the cylinder must outlive this object; only those
     * after VesselWall are asked.
     * @p lower and @p upper bound the spheres, not their centers [m];
     * @p largest_radius of all spheres, obstacles included [m]; @p gap: distance
     * kept, over a sphere's radius [-]. @p own: a box around the obstacles that this rank
     * knows and around what it owns; the boxes of all ranks cover the vessel.
     */
    RandomPlaces(const Cylinder                              &cylinder,
                 const std::vector<Wall>                     &walls,
                 const double                                 lower,
                 const double                                 upper,
                 const double                                 largest_radius,
                 const double                                 gap,
                 const std::optional<dealii::BoundingBox<3>> &own,
                 std::mt19937_64                             &generator,
                 MPI_Comm                                     communicator);

    /** A sphere that is there already and in this rank's box, or an image of the last one
     * that was placed, anywhere. */
    void add_obstacle(const dealii::Point<3> &center, const double radius);

    /**
     * Looks for a place for a sphere, @p n_tries times; the place is taken then. Returns
     * false if there is none. The same on all ranks, collective.
     */
    bool place(const double radius, const unsigned int n_tries, dealii::Point<3> &center);

    /** Gives back the numbers that were drawn for places that were not tried. To be
     * called before others are drawn, and at the end. */
    void give_back();

  private:
    struct Sphere
    {
      dealii::Point<3> center;
      double           radius;
    };
    struct Try
    {
      dealii::Point<3> center;
      // Not taken when it was drawn.
      bool is_free;
    };
    using Bin = std::array<int, 3>;

    Bin         bin(const dealii::Point<3> &x) const;
    bool        is_known(const Bin &bin) const;
    std::size_t number(const Bin &bin) const;
    // Of what @p others gives for the bins around it.
    template <class Others>
    bool keeps_distance(const Sphere &sphere, const Others &others) const;
    void draw(const double radius);

    // Whether the further walls are farther away than @p room and the point inside them.
    bool is_inside(const dealii::Point<3> &center, const double room) const;

    const std::vector<Wall> &walls;
    const double             tube;
    const double             lower, upper;
    const double             gap;
    const double             bin_size;
    std::mt19937_64         &generator;
    const MPI_Comm           communicator;

    // The bins of this rank, and the spheres in them.
    Bin                              first_bin{}, n_bins{};
    std::vector<std::vector<Sphere>> bins;

    // What was drawn, how much of it was tried, and the generator before that.
    std::vector<Try> tries;
    std::size_t      n_tried = 0;
    std::size_t      n_next;
    std::mt19937_64  before;
    // What was placed since it was drawn, anywhere.
    std::map<Bin, std::vector<Sphere>> placed;
  };
} // namespace graupel

#endif
