// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_benchmarks_bed_file_h
#define graupel_benchmarks_bed_file_h

#include <deal.II/base/point.h>

#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace graupel
{
  /** Equal spheres [m]. */
  struct Bed
  {
    std::vector<dealii::Point<3>> centers;
    double                        radius = 0.;
    /** The bed stands so often above itself, each time higher by this [m]. */
    unsigned int copies = 1;
    double       lift   = 0.;

    /** Calls @p visit with the center of each sphere of all copies. */
    template <class Visit>
    void
    visit_all(const Visit &visit) const
    {
      for (unsigned int copy = 0; copy < copies; ++copy)
        for (auto center : centers)
          {
            center[2] += copy * lift;
            visit(center);
          }
    }
  };

  /** One sphere a line, "x y z radius" [m]; may end in .gz. */
  inline Bed
  read_bed(const std::string &name)
  {
    std::ifstream                       file(name, std::ios::binary);
    boost::iostreams::filtering_istream text;
    if (name.size() > 3 && name.substr(name.size() - 3) == ".gz")
      text.push(boost::iostreams::gzip_decompressor());
    text.push(file);

    Bed    bed;
    double x, y, z, radius;
    while (text >> x >> y >> z >> radius)
      {
        if (bed.centers.empty())
          bed.radius = radius;
        if (std::abs(radius - bed.radius) > 1e-6 * bed.radius)
          throw std::runtime_error(
            name + ": this benchmark takes equal spheres; sphere " +
            std::to_string(bed.centers.size() + 1) + " has another radius");
        bed.centers.emplace_back(x, y, z);
      }
    if (!text.eof() || bed.centers.empty())
      throw std::runtime_error(name + ": line " + std::to_string(bed.centers.size() + 1) +
                               " is not \"x y z radius\", four numbers in metres");
    return bed;
  }

  /** Height up to which the bed reaches [m]. */
  inline double
  top_of(const Bed &bed)
  {
    double top = 0.;
    for (const auto &center : bed.centers)
      top = std::max(top, center[2] + bed.radius);
    return top + (bed.copies - 1) * bed.lift;
  }

  /** The least lift of a copy at which it overlaps the bed nowhere [m]: what lies in the
   * lowest four diameters of the one meets the highest four of the other. */
  inline double
  lift_of_a_copy(const Bed &bed)
  {
    const double                  d = 2. * bed.radius, reach = 4. * d, top = top_of(bed);
    std::vector<dealii::Point<3>> low, high;
    for (const auto &center : bed.centers)
      {
        if (center[2] < reach)
          low.push_back(center);
        if (center[2] > top - reach)
          high.push_back(center);
      }

    double lift = 0.;
    for (const auto &below : high)
      for (const auto &above : low)
        {
          const double x = below[0] - above[0], y = below[1] - above[1];
          const double rest = d * d - x * x - y * y;
          if (rest > 0.)
            lift = std::max(lift, below[2] - above[2] + std::sqrt(rest));
        }
    return lift;
  }

  /** Puts so many of it above each other. */
  inline void
  stack(Bed &bed, const unsigned int copies)
  {
    bed.lift   = copies > 1 ? lift_of_a_copy(bed) : 0.;
    bed.copies = copies;
  }
} // namespace graupel

#endif
