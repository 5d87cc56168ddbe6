// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_vessel_section_h
#define graupel_dem_vessel_section_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace graupel
{
  /** The side of a plane on which particles can be: that its normal points away from. */
  struct HalfSpace
  {
    dealii::Point<3> point;
    /** Unit normal, out of the space. */
    dealii::Tensor<1, 3> normal;
  };

  /** What a closed surface of triangles encloses. */
  struct ClosedBody
  {
    /** Corners, wound in any way [m]. */
    std::vector<std::array<dealii::Point<3>, 3>> triangles;
    /** Whether the particles are inside of it, else outside. */
    bool is_container = false;
  };

  /** The size of a plane figure. */
  struct SectionSize
  {
    /** [m^2] */
    double area = 0.;
    /** [m] */
    double perimeter = 0.;
  };

  /**
   * Of the disc of @p radius around the z axis as far as it lies in all of @p spaces, at
   * the height @p z. To rounding.
   */
  SectionSize disc_section(const double                  radius,
                           const std::vector<HalfSpace> &spaces,
                           const double                  z);

  /**
   * Area of that part of the disc in @p spaces which lies inside all containers and
   * outside of all other bodies of @p bodies, which may meet and overlap, at the height
   * @p z [m^2]. By lines along x, exact on each, between the corners of the figure three
   * each and a hundred at least: about 1e-6 of the disc.
   */
  double section_area(const double                   radius,
                      const std::vector<HalfSpace>  &spaces,
                      const std::vector<ClosedBody> &bodies,
                      const double                   z);
} // namespace graupel

#endif
