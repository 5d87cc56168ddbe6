// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_bed_solid_below_h
#define graupel_dem_bed_solid_below_h

#include <graupel/dem/numbers/exact_sum.h>
#include <graupel/dem/particles/particle_arrays.h>

#include <vector>

namespace graupel
{
  /** Volume of the part of a sphere below a plane that is @p height above its lowest
   * point [m^3]. */
  double sphere_volume_below(const double radius, const double height);

  /**
   * The solid below level planes, for many questions about the same particles: they are
   * sorted once, and then only the spheres that a plane cuts are looked at. Sums run over
   * all ranks and are exact: the same on any number of ranks.
   */
  class SolidBelow
  {
  public:
    /** The own rows of @p particles as they are now. Collective. */
    SolidBelow(const ParticleArrays &particles, MPI_Comm communicator);

    /** Volume of solid below each of the planes z = @p planes [m^3], spheres cut exactly.
     * Collective. */
    std::vector<double> at(const std::vector<double> &planes) const;

    /** Volume of solid between two planes [m^3]. Collective. */
    double between(const double lower, const double upper) const;

    /** Of all particles of all ranks; 0 without any [m]. */
    double
    largest_radius() const
    {
      return largest;
    }

  private:
    struct Sphere
    {
      double lowest; // point [m]
      double radius; // [m]
    };

    ExactSum below(const double plane) const;

    const MPI_Comm        communicator;
    double                largest = 0.; // radius [m]
    std::vector<Sphere>   spheres;      // from the lowest up
    std::vector<ExactSum> before;       // volume of those before each of them, and of all
  };
} // namespace graupel

#endif
