// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_bed_sphere_cuts_h
#define graupel_dem_bed_sphere_cuts_h

#include <array>

namespace graupel
{
  /**
   * Area common to two discs of radii @p R and @p r [m] in one plane, their
   * centers @p s apart [m^2]. To rounding relative to the larger disc.
   */
  double disc_overlap(const double R, const double r, const double s);

  /**
   * Volume [m^3] of that part of a sphere of radius @p r which lies inside the
   * endless tube of radius @p R around the z axis, and between the planes
   * @p lower and @p upper, heights over its center; @p s is the distance of its
   * center from the axis [m].
   *
   * Discs are cut exactly and integrated over the height between the heights at
   * which circles touch; to about 1e-11 of the cube of the radius.
   */
  double sphere_volume_in_tube(const double r,
                               const double s,
                               const double R,
                               const double lower,
                               const double upper);

  /**
   * Volume [m^3] of that part of a sphere of radius @p r which lies inside a box with
   * the corners @p lower and @p upper, as seen from its center. Closed form, to rounding
   * relative to the sphere.
   *
   * Signed sum of the parts of the sphere beyond each corner; beyond planes that meet at
   * right angles they follow by integrating segments of circles. Strobl, Formella &
   * Poeschel (2016), doi:10.1016/j.jcp.2016.02.003, have the case of any planes.
   */
  double sphere_volume_in_box(const double                 r,
                              const std::array<double, 3> &lower,
                              const std::array<double, 3> &upper);
} // namespace graupel

#endif
