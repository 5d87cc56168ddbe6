#ifndef graupel_dem_bed_sphere_cuts_h
#define graupel_dem_bed_sphere_cuts_h

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
} // namespace graupel

#endif
