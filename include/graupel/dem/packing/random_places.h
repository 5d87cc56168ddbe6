#ifndef graupel_dem_packing_random_places_h
#define graupel_dem_packing_random_places_h

#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/walls/walls.h>

#include <functional>
#include <vector>

namespace graupel
{
  /**
   * Random places for spheres between two heights of a vessel, each at a distance
   * of all others and of the walls (random sequential addition).
   */
  class RandomPlaces
  {
  public:
    /**
     * @p walls of the vessel beside the cylinder must outlive this object; only those
     * after VesselWall are asked.
     * @p lower and @p upper bound the spheres, not their centers [m];
     * @p largest_radius of all spheres, obstacles included [m]; @p gap: distance
     * kept, over a sphere's radius [-].
     */
    RandomPlaces(const Cylinder          &cylinder,
                 const std::vector<Wall> &walls,
                 const double             lower,
                 const double             upper,
                 const double             largest_radius,
                 const double             gap);

    /** A sphere that is there already. */
    void add_obstacle(const dealii::Point<3> &center, const double radius);

    /**
     * Looks for a place for a sphere, @p n_tries times; the place is taken then.
     * @p random gives numbers even between 0 and 1. Returns false if there is none.
     */
    bool place(const double                   radius,
               const unsigned int             n_tries,
               const std::function<double()> &random,
               dealii::Point<3>              &center);

  private:
    struct Sphere
    {
      dealii::Point<3> center;
      double           radius;
    };

    std::array<int, 3> bin(const dealii::Point<3> &x) const;
    std::size_t        number(const int x, const int y, const int z) const;
    bool               is_free(const dealii::Point<3> &center, const double radius) const;

    // Whether the further walls are farther away than @p room and the point inside them.
    bool is_inside(const dealii::Point<3> &center, const double room) const;

    const std::vector<Wall>         &walls;
    const double                     tube;
    const double                     lower, upper;
    const double                     gap;
    const double                     bin_size;
    std::array<int, 3>               n_bins;
    std::vector<std::vector<Sphere>> bins;
  };
} // namespace graupel

#endif
