// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_area_profile_h
#define graupel_mesh_area_profile_h

#include <array>
#include <functional>
#include <vector>

namespace graupel
{
  /**
   * The area of a vessel's cross-section over its height, and the volume between two
   * heights: parabolas through three values in each of many slabs. Exact where the
   * area is a parabola between the given breaks, as between the vertices of plane
   * facets; it may jump at breaks.
   */
  class AreaProfile
  {
  public:
    /** No height, no volume. */
    AreaProfile() = default;

    /**
     * @p area of a height [m] in m^2; the ascending @p breaks [m], at least two, are the
     * borders of slabs, which are cut further until none is higher than @p step [m].
     */
    AreaProfile(const std::function<double(double)> &area,
                const std::vector<double>           &breaks,
                const double                         step);

    /** [m^2]; 0 outside of the breaks. At a break, of the slab above. */
    double area(const double z) const;

    /** Between two heights; negative if @p lower is the upper one [m^3]. */
    double volume(const double lower, const double upper) const;

    /** The height below which there is @p volume [m^3]; the ends for less or more [m]. */
    double level(const double volume) const;

    /** Borders of the slabs, ascending [m]. */
    const std::vector<double> &
    borders() const
    {
      return ends;
    }

    /** Area and volume of slab @p k: whether there is any of it. */
    bool
    is_empty(const std::size_t k) const
    {
      return !(below[k + 1] > below[k]);
    }

  private:
    // The slab in which z lies, the next one for z outside.
    std::size_t slab_of(const double z) const;
    double      volume_below(const double z) const;

    std::vector<double> ends;
    // Of each slab, at its three Gauss points.
    std::vector<std::array<double, 3>> areas;
    // Volume below each end.
    std::vector<double> below;
  };
} // namespace graupel

#endif
