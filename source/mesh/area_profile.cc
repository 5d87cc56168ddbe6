// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/mesh/area_profile.h>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    // Gauss's points on (-1, 1) are 0 and +-this; the weights 8/9 and 5/9.
    const double outer_point = std::sqrt(0.6);

    // The coefficients of 1, s, s^2 of the parabola through the values at Gauss's points.
    std::array<double, 3>
    parabola(const std::array<double, 3> &values)
    {
      return {
        {values[1],
         (values[2] - values[0]) / (2. * outer_point),
         (values[2] - 2. * values[1] + values[0]) / (2. * outer_point * outer_point)}};
    }
  } // namespace

  AreaProfile::AreaProfile(const std::function<double(double)> &area,
                           const std::vector<double>           &breaks,
                           const double                         step)
  {
    ends.push_back(breaks.front());
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
      {
        const double from = breaks[k], height = breaks[k + 1] - from;
        if (!(height > 0.))
          continue;
        const auto n = std::max(1l, static_cast<long>(std::ceil(height / step - 1e-9)));
        for (long i = 1; i <= n; ++i)
          ends.push_back(i == n ? breaks[k + 1] : from + height * i / n);
      }
    below.push_back(0.);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      {
        const double middle = 0.5 * (ends[k] + ends[k + 1]);
        const double half   = 0.5 * (ends[k + 1] - ends[k]);
        areas.push_back({{area(middle - outer_point * half),
                          area(middle),
                          area(middle + outer_point * half)}});
        const auto &a = areas.back();
        below.push_back(below.back() + half * (5. * (a[0] + a[2]) + 8. * a[1]) / 9.);
      }
  }

  std::size_t
  AreaProfile::slab_of(const double z) const
  {
    const auto above = std::upper_bound(ends.begin(), ends.end(), z) - ends.begin();
    return std::clamp<std::ptrdiff_t>(above - 1, 0, ends.size() - 2);
  }

  double
  AreaProfile::area(const double z) const
  {
    if (areas.empty() || z < ends.front() || z > ends.back())
      return 0.;
    const std::size_t k = slab_of(z);
    const auto        c = parabola(areas[k]);
    const double      s = (2. * z - ends[k] - ends[k + 1]) / (ends[k + 1] - ends[k]);
    return std::max(0., c[0] + s * (c[1] + s * c[2]));
  }

  double
  AreaProfile::volume_below(const double z) const
  {
    if (areas.empty() || z <= ends.front())
      return 0.;
    if (z >= ends.back())
      return below.back();
    const std::size_t k    = slab_of(z);
    const auto        c    = parabola(areas[k]);
    const double      half = 0.5 * (ends[k + 1] - ends[k]);
    const double      s    = (z - ends[k]) / half - 1.;
    // The parabola's integral from -1.
    const double part =
      c[0] * (s + 1.) + c[1] * (s * s - 1.) / 2. + c[2] * (s * s * s + 1.) / 3.;
    return std::clamp(below[k] + half * part, below[k], below[k + 1]);
  }

  double
  AreaProfile::volume(const double lower, const double upper) const
  {
    return volume_below(upper) - volume_below(lower);
  }

  double
  AreaProfile::level(const double volume) const
  {
    if (areas.empty())
      return 0.;
    double low = ends.front(), high = ends.back();
    if (volume >= below.back())
      return high;
    // Bisection to the last bit: the volume never falls.
    for (unsigned int n = 0; n < 200; ++n)
      {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
          break;
        (volume_below(middle) < volume ? low : high) = middle;
      }
    return high;
  }
} // namespace graupel
