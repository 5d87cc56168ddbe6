// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_dem_stl_shapes_h
#define graupel_tests_dem_stl_shapes_h

#include <deal.II/base/point.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

namespace graupel
{
  using Triangles = std::vector<std::array<dealii::Point<3>, 3>>;

  inline void
  add_quad(Triangles &triangles, const std::array<dealii::Point<3>, 4> &corners)
  {
    triangles.push_back({{corners[0], corners[1], corners[2]}});
    triangles.push_back({{corners[0], corners[2], corners[3]}});
  }

  /** The six faces of a box [m]. */
  inline Triangles
  box_shape(const dealii::Point<3> &lower, const dealii::Point<3> &upper)
  {
    const auto corner =
      [&](const unsigned int x, const unsigned int y, const unsigned int z) {
        return dealii::Point<3>(
          (x ? upper : lower)[0], (y ? upper : lower)[1], (z ? upper : lower)[2]);
      };
    Triangles triangles;
    for (const unsigned int s : {0, 1})
      {
        add_quad(triangles,
                 {{corner(s, 0, 0), corner(s, 1, 0), corner(s, 1, 1), corner(s, 0, 1)}});
        add_quad(triangles,
                 {{corner(0, s, 0), corner(1, s, 0), corner(1, s, 1), corner(0, s, 1)}});
        add_quad(triangles,
                 {{corner(0, 0, s), corner(1, 0, s), corner(1, 1, s), corner(0, 1, s)}});
      }
    return triangles;
  }

  /** Writes triangles [m] in millimetres, a file for each process; returns its path. */
  inline std::string
  write_stl(const std::string &name, const Triangles &triangles)
  {
    const std::string file =
      testing::TempDir() + name + '-' + std::to_string(getpid()) + ".stl";
    std::ofstream stream(file);
    stream << std::setprecision(12) << "solid " << name << '\n';
    for (const auto &triangle : triangles)
      {
        stream << "facet normal 0 0 1\nouter loop\n";
        for (const auto &corner : triangle)
          stream << "vertex " << 1e3 * corner[0] << ' ' << 1e3 * corner[1] << ' '
                 << 1e3 * corner[2] << '\n';
        stream << "endloop\nendfacet\n";
      }
    stream << "endsolid " << name << '\n';
    return file;
  }
} // namespace graupel

#endif
