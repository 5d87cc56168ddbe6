// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_bin_grid_h
#define graupel_simulation_parameters_bin_grid_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * A box that is cut into equal bins: along a line, or over a plane. Its frame is the
   * corner and three unit vectors at right angles, in which places are told.
   */
  struct BinGrid
  {
    std::string                         name;
    dealii::Point<3>                    corner; // [m]
    std::array<dealii::Tensor<1, 3>, 3> axes;
    std::array<double, 3>               sizes; // [m]
    /** Bins along the axes; those of a line lie along the first, those of a plane along
     * the first two. */
    std::array<unsigned int, 3> counts;

    unsigned int n_bins() const;

    /** Places along the axes of the bin @p bin; the first runs fastest. */
    std::array<unsigned int, 3> places(const unsigned int bin) const;

    /** Of a bin along an axis [m]. */
    double
    width(const unsigned int axis) const
    {
      return sizes[axis] / counts[axis];
    }

    /** @p point in the frame: lengths along the axes from the corner [m]. */
    std::array<double, 3> in_frame(const dealii::Point<3> &point) const;

    /** The bin that a point lies in; none outside of all. */
    std::optional<unsigned int> bin_at(const dealii::Point<3> &point) const;

    /** The point of a bin at these @p parts of its widths. */
    dealii::Point<3> point_of(const unsigned int           bin,
                              const std::array<double, 3> &parts) const;

    dealii::Point<3>
    middle_of(const unsigned int bin) const
    {
      return point_of(bin, {0.5, 0.5, 0.5});
    }
  };

  /**
   * Reads lines, "NAME: from (x y z)  to (x y z)  bins  width  thickness | ...", of the
   * parameter @p parameter. Bins reach half of the width to both sides, along the level
   * direction across the line (y for one along x, x for one along z), and half of the
   * thickness at right angles to both. Throws InputError.
   */
  std::vector<BinGrid> read_lines(const std::string &parameter, const std::string &text);

  /**
   * Reads planes, "NAME: corner (x y z)  end of one side (x y z)  end of the other (x y
   * z)  bins  bins  thickness | ...": bins along the two sides, which must be at right
   * angles, and half of the thickness to both sides of the plane. Throws InputError.
   */
  std::vector<BinGrid> read_planes(const std::string &parameter, const std::string &text);
} // namespace graupel

#endif
