// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_profiles_h
#define graupel_simulation_observers_profiles_h

#include <graupel/closures/bed_correlations.h>
#include <graupel/mesh/nodal_space.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>

namespace graupel
{
  /** The fields that the profiles look at, ghosts up to date. */
  struct FlowFields
  {
    const NodalSpace &nodes;
    /** alpha [-]. */
    const NodalVector &void_fraction;
    /** z-component of q, the local superficial velocity [m/s]. */
    const NodalVector &flux;
    /** p [Pa]. */
    const NodalVector &pressure;
  };

  /** Means over a part of the vessel, weighted by volume. */
  struct RegionMean
  {
    /** Of the region [m^3]. */
    double volume = 0.;
    /** Mean height z [m]. */
    double height = 0.;
    /** Mean distance from the axis [m]. */
    double radius        = 0.;
    double void_fraction = 0.;
    double flux          = 0.;
    double pressure      = 0.;
  };

  /** Means over @p n_slabs horizontal slabs of equal thickness, from the bottom up.
   * Collective. */
  std::vector<RegionMean> axial_profile(const FlowFields  &fields,
                                        const unsigned int n_slabs);

  /**
   * Means over @p n_annuli annuli of equal width, from the axis to the wall,
   * between the heights @p from and @p to [m]. Annuli that hold no quadrature
   * point of the mesh are left out; none for a vessel that does not fill the cylinder.
   * Collective.
   */
  std::vector<RegionMean> radial_profile(const FlowFields  &fields,
                                         const unsigned int n_annuli,
                                         const double       from,
                                         const double       to);

  /** Pressure at the height @p z [m], linear between the slabs of an axial profile [Pa].
   */
  double pressure_at(const std::vector<RegionMean> &axial, const double z);

  /** A point of the plane y = 0 and the fields there. */
  struct PlanePoint
  {
    double x, z, void_fraction, flux, pressure;
  };

  /** The plane y = 0 on a regular grid. The cells of its points are found once for a
   * mesh. */
  class MidPlane
  {
  public:
    /** @p n_across points across the vessel. */
    MidPlane(const VesselMesh &mesh, const unsigned int n_across);

    /** The fields at its points, z running fastest; those outside of the mesh are left
     * out. All are the first rank's. Collective. */
    std::vector<PlanePoint> values(const FlowFields &fields);

  private:
    const VesselMesh                                &mesh;
    std::vector<dealii::Point<3>>                    points;
    dealii::Utilities::MPI::RemotePointEvaluation<3> places;
  };

  /**
   * What loose packing at the wall does by itself: the common pressure gradient
   * of annuli that each obey Ergun's equation, over Ergun's gradient at
   * @p mean_void_fraction, minus 1 [-]; not a number without annuli.
   */
  double wall_channelling_deviation(const std::vector<RegionMean> &radial,
                                    const FluidProperties         &fluid,
                                    const double                   diameter,
                                    const double                   superficial_velocity,
                                    const double                   mean_void_fraction);
} // namespace graupel

#endif
