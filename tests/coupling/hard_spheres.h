// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_coupling_hard_spheres_h
#define graupel_tests_coupling_hard_spheres_h

#include <deal.II/base/point.h>

#include <cmath>
#include <random>
#include <vector>

namespace graupel
{
  /** The sites of a face-centred cubic lattice in a cube of edge @p width, at least @p n.
   */
  inline std::vector<dealii::Point<3>>
  lattice_sites(const double width, const unsigned int n)
  {
    const unsigned int                  cells = std::ceil(std::cbrt(n / 4.) - 1e-9);
    std::vector<dealii::Point<3>>       sites;
    const std::vector<dealii::Point<3>> basis{
      {0., 0., 0.}, {0.5, 0.5, 0.}, {0.5, 0., 0.5}, {0., 0.5, 0.5}};
    for (unsigned int i = 0; i < cells; ++i)
      for (unsigned int j = 0; j < cells; ++j)
        for (unsigned int k = 0; k < cells; ++k)
          for (const auto &b : basis)
            sites.emplace_back(width / cells *
                               dealii::Point<3>(i + b[0], j + b[1], k + b[2]));
    return sites;
  }

  /** Whether the sphere @p i of unit diameter would overlap another one at @p place. */
  inline bool
  overlaps(const std::vector<dealii::Point<3>> &spheres,
           const unsigned int                   i,
           const dealii::Point<3>              &place,
           const double                         width)
  {
    for (unsigned int j = 0; j < spheres.size(); ++j)
      {
        double square = 0.;
        for (unsigned int c = 0; c < 3 && square < 1.; ++c)
          {
            double x = place[c] - spheres[j][c];
            x -= width * std::round(x / width);
            square += x * x;
          }
        if (j != i && square < 1.)
          return true;
      }
    return false;
  }

  /**
   * Centers of hard spheres of unit diameter at a @p solid fraction in a periodic cube of
   * edge @p width: a lattice that is shaken by Metropolis' Monte Carlo method.
   */
  inline std::vector<dealii::Point<3>>
  hard_spheres(const double width, const double solid, const unsigned int seed)
  {
    constexpr unsigned int sweeps = 60;
    std::mt19937           random(seed);
    const auto             uniform = [&] { return random() / 4294967296.; };
    const unsigned int n = std::lround(solid * std::pow(width, 3) * 6. / std::acos(-1.));
    auto               spheres = lattice_sites(width, n);
    for (unsigned int i = spheres.size() - 1; i > 0; --i)
      std::swap(spheres[i], spheres[static_cast<unsigned int>(uniform() * (i + 1))]);
    spheres.resize(n);
    const double reach = std::max(0.03, std::min(0.5, 0.24 / std::cbrt(solid) - 0.1));
    for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
      for (unsigned int i = 0; i < n; ++i)
        {
          dealii::Point<3> place = spheres[i];
          for (unsigned int c = 0; c < 3; ++c)
            {
              place[c] += reach * (2. * uniform() - 1.);
              place[c] -= width * std::floor(place[c] / width);
            }
          if (!overlaps(spheres, i, place, width))
            spheres[i] = place;
        }
    return spheres;
  }

  /** Those whose centers are in the cylinder of that width on z = 0, its axis at 0. */
  inline std::vector<dealii::Point<3>>
  in_cylinder(const std::vector<dealii::Point<3>> &spheres, const double width)
  {
    std::vector<dealii::Point<3>> inside;
    for (const auto &sphere : spheres)
      if (const dealii::Point<3> place(
            sphere[0] - 0.5 * width, sphere[1] - 0.5 * width, sphere[2]);
          std::hypot(place[0], place[1]) < 0.499 * width)
        inside.push_back(place);
    return inside;
  }
} // namespace graupel

#endif
