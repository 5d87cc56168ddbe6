// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/solid_below.h>
#include <graupel/dem/bed/sphere_cuts.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace graupel
{
  using dealii::numbers::PI;

  double
  disc_overlap(const double R, const double r, const double s)
  {
    if (s >= R + r)
      return 0.;
    if (s <= std::abs(R - r))
      return PI * std::min(R, r) * std::min(R, r);
    // Two segments on a common chord; x and y are its distances from the centers.
    // The angles come from the half chord, since a cosine near one has lost them.
    const double x = (s * s + (R - r) * (R + r)) / (2. * s);
    const double y = s - x;
    const double half_chord =
      std::sqrt((R + r - s) * (s + r - R) * (s + R - r) * (s + R + r)) / (2. * s);
    return R * R * std::atan2(half_chord, x) + r * r * std::atan2(half_chord, y) -
           s * half_chord;
  }

  double
  sphere_volume_in_tube(const double r,
                        const double s,
                        const double R,
                        const double lower,
                        const double upper)
  {
    const double from = std::clamp(lower, -r, r), to = std::clamp(upper, -r, r);
    if (s - r >= R || from >= to)
      return 0.;
    if (s + r <= R)
      return sphere_volume_below(r, r + to) - sphere_volume_below(r, r + from);

    // Heights r sin(t), where the circle has radius r cos(t). The common area is
    // smooth between the t at which the circle touches the tube, where it has a
    // power of 3/2; the cubic substitution makes that a whole power.
    static const dealii::QGauss<1> gauss(16);
    const double                   first  = std::acos(std::min(1., std::abs(R - s) / r));
    const double                   second = std::acos(std::min(1., (R + s) / r));
    const double                   begin = std::asin(from / r), end = std::asin(to / r);
    std::array<double, 6>          ends{begin, -first, -second, second, first, end};
    for (double &t : ends)
      t = std::clamp(t, begin, end);

    double volume = 0.;
    for (unsigned int k = 0; k + 1 < ends.size(); ++k)
      for (unsigned int q = 0; ends[k] < ends[k + 1] && q < gauss.size(); ++q)
        {
          const double u     = gauss.point(q)[0];
          const double width = ends[k + 1] - ends[k];
          const double t     = ends[k] + width * u * u * (3. - 2. * u);
          const double dt    = width * 6. * u * (1. - u) * gauss.weight(q);
          volume += disc_overlap(R, r * std::cos(t), s) * r * std::cos(t) * dt;
        }
    return volume;
  }

  namespace
  {
    // Of the unit sphere, beyond x = a.
    double
    beyond_plane(const double a)
    {
      const double x = std::clamp(a, -1., 1.);
      return PI / 3. * (2. - 3. * x + x * x * x);
    }

    // Integral over x of twice the area of the unit sphere's section beyond y = b, which
    // is a segment of the circle of radius sqrt(1 - x^2); from 0 on.
    double
    segments_up_to(const double x, const double b)
    {
      const double h = std::sqrt(std::max(0., 1. - b * b));
      const double w = std::sqrt(std::max(0., h * h - x * x));
      // Where both vanish, as the plane through the center meets the sphere's end.
      const double angle = w > 0. || b > 0. ? std::atan2(w, b) : PI / 2.;
      return (x - x * x * x / 3.) * angle - (b - b * b * b / 3.) * std::atan2(x, w) -
             2. / 3. * b * x * w + 2. / 3. * std::atan2(b * x, w);
    }

    // Beyond x = a and y = b.
    double
    beyond_edge(const double a, const double b)
    {
      if (a < 0.)
        return beyond_plane(b) - (a <= -1. ? 0. : beyond_edge(-a, b));
      if (b < 0.)
        return beyond_edge(b, a);
      const double end = std::sqrt(std::max(0., 1. - b * b));
      return a < end ? segments_up_to(end, b) - segments_up_to(a, b) : 0.;
    }

    // Beyond x = a, y = b and z = c.
    double
    beyond_corner(const double a, const double b, const double c)
    {
      if (a < 0.)
        return beyond_edge(b, c) - (a <= -1. ? 0. : beyond_corner(-a, b, c));
      if (b < 0.)
        return beyond_corner(b, a, c);
      if (c < 0.)
        return beyond_corner(c, a, b);
      const double end = std::sqrt(std::max(0., 1. - b * b - c * c));
      if (!(a < end))
        return 0.;
      // The section is half of both segments, less the quarter of the circle, and the
      // rectangle that both leave out.
      const auto up_to = [&](const double x) {
        return 0.5 * (segments_up_to(x, b) + segments_up_to(x, c)) -
               PI / 4. * (x - x * x * x / 3.) + b * c * x;
      };
      return up_to(end) - up_to(a);
    }
  } // namespace

  double
  sphere_volume_in_box(const double                 r,
                       const std::array<double, 3> &lower,
                       const std::array<double, 3> &upper)
  {
    double volume = 0.;
    for (unsigned int corner = 0; corner < 8; ++corner)
      {
        std::array<double, 3> at;
        int                   sign = 1;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const bool is_upper = corner >> i & 1u;
            at[i]               = (is_upper ? upper : lower)[i] / r;
            sign                = is_upper ? -sign : sign;
          }
        volume += sign * beyond_corner(at[0], at[1], at[2]);
      }
    return std::max(0., volume) * r * r * r;
  }
} // namespace graupel
