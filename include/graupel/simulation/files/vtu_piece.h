// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_vtu_piece_h
#define graupel_simulation_vtu_piece_h

#include <deal.II/base/point.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * Points, or lines of two points each, with values at the points: what one rank adds to
   * a VTU file for ParaView. Positions are in double precision and whole numbers are
   * whole. deal.II writes all numbers as floats of four bytes, in which ids beyond 2^24
   * are not what they were.
   */
  class VtuPiece
  {
  public:
    /** VTK's numbers of the kinds of cells. */
    enum Cell : unsigned char
    {
      vertex = 1,
      line   = 3
    };

    /** The @p points of the cells, one or two of each in their order [m]. */
    VtuPiece(const Cell cell, const std::vector<dealii::Point<3>> &points);

    /** A value of each point. Made for std::int32_t, std::int64_t, float and double. */
    template <typename Number>
    void add(const std::string &name, const std::vector<Number> &values);

    /** A vector of each point, in numbers of this kind. Made for float and double. */
    template <typename Number>
    void add_vectors(const std::string                       &name,
                     const std::vector<dealii::Tensor<1, 3>> &vectors);

    /** Writes the file of this piece alone, arrays in base64 and compressed. */
    void write_vtu(std::ostream &stream) const;

  private:
    const Cell        cell;
    const std::size_t n_points;
    std::string       points, values; // as XML
  };
} // namespace graupel

#endif
