#include <graupel/dem/bed/bed_observables.h>
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
} // namespace graupel
