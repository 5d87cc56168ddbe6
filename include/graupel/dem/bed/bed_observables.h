#ifndef graupel_dem_bed_bed_observables_h
#define graupel_dem_bed_bed_observables_h

#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/mesh/cylinder.h>

#include <vector>

namespace graupel
{
  /** Volume of the part of a sphere below a plane that is @p height above its lowest
   * point [m^3]. */
  double sphere_volume_below(const double radius, const double height);

  /**
   * What the particles as a bed look like from outside. All sums run over all
   * ranks and are exact: the same on any number of ranks.
   */
  class BedObservables
  {
  public:
    /** Both must outlive this object. The particles may move and change. */
    BedObservables(const ParticleArrays &particles,
                   const Cylinder       &cylinder,
                   MPI_Comm              communicator);

    /**
     * Volume of solid below each of the planes z = @p planes [m^3], spheres cut
     * exactly. Collective.
     */
    std::vector<double> solid_volume_below(const std::vector<double> &planes) const;

    /** Volume of solid between two planes [m^3]. Collective. */
    double solid_volume_between(const double lower, const double upper) const;

    /**
     * Section-averaged solid fraction [-] of each slab between neighbouring
     * planes; one value less than planes. Collective.
     */
    std::vector<double> solid_fractions(const std::vector<double> &planes) const;

    struct Bed
    {
      /**
       * Where the solid fraction, averaged over a slab of one particle
       * diameter, falls to half of its bulk value [m]; 0 without a bed.
       */
      double height = 0.;
      /** Solid fraction over the middle half of the bed [-]. */
      double bulk_solid_fraction = 0.;
      /**
       * 1 - solid volume / (cross-section * height) [-]; 1 without a bed. Of
       * all solid, so it means nothing while particles still rain.
       */
      double mean_void_fraction = 1.;
    };

    /**
     * Finds the bed. The top is the lowest place above the middle of the solid
     * that meets the definition, so that particles that fall from above do not
     * raise it. Collective.
     */
    Bed bed() const;

  private:
    double top_of_bed(const double start,
                      const double threshold,
                      const double slab,
                      const double end) const;
    double slab_fraction(const double middle, const double slab) const;
    double largest_radius() const;

    const ParticleArrays &particles;
    const Cylinder       &cylinder;
    MPI_Comm              communicator;
  };
} // namespace graupel

#endif
