// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/vessel/section.h>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    using Point2 = dealii::Point<2>;

    // Lines across the disc that are cut in any case: end lines of strips.
    constexpr unsigned int least_strips = 40;
    // Gauss's three points in a strip, and their weights.
    const double outer_point = std::sqrt(0.6);

    double
    cross(const Point2 &a, const Point2 &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    // a x + b y <= c
    struct HalfPlane
    {
      double a, b, c;

      double
      room(const Point2 &x) const
      {
        return c - a * x[0] - b * x[1];
      }
    };

    std::vector<HalfPlane>
    half_planes(const std::vector<HalfSpace> &spaces, const double z)
    {
      std::vector<HalfPlane> result;
      for (const HalfSpace &space : spaces)
        result.push_back({space.normal[0],
                          space.normal[1],
                          space.normal * space.point - space.normal[2] * z});
      return result;
    }

    // The part of a convex polygon in the half plane.
    std::vector<Point2>
    clip(const std::vector<Point2> &polygon, const HalfPlane &half)
    {
      std::vector<Point2> result;
      for (std::size_t k = 0; k < polygon.size(); ++k)
        {
          const Point2 &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
          const double  room = half.room(here), next_room = half.room(next);
          if (room >= 0.)
            result.push_back(here);
          if ((room > 0. && next_room < 0.) || (room < 0. && next_room > 0.))
            result.push_back(here + room / (room - next_room) * (next - here));
        }
      return result;
    }

    // The polygon in which the section lies, against the clock: a square around the disc,
    // cut.
    std::vector<Point2>
    frame(const double radius, const std::vector<HalfPlane> &halves)
    {
      const double        R = 1.5 * radius;
      std::vector<Point2> polygon{{-R, -R}, {R, -R}, {R, R}, {-R, R}};
      for (const HalfPlane &half : halves)
        polygon = clip(polygon, half);
      return polygon;
    }

    // Where the way from p to q enters the disc and leaves it, as parts of it; equal ones
    // if it does not.
    std::pair<double, double>
    inside_disc(const Point2 &p, const Point2 &q, const double radius)
    {
      const auto   d = q - p;
      const double a = d * d, b = dealii::Tensor<1, 2>(p) * d,
                   c = p.square() - radius * radius;
      const double D = b * b - a * c;
      if (!(D > 0.))
        return {0., 0.};
      const double root = std::sqrt(D);
      return {std::clamp((-b - root) / a, 0., 1.), std::clamp((-b + root) / a, 0., 1.)};
    }

    // What the disc shares with the triangle of its center, p and q, negative if these
    // go with the clock; the perimeter of what lies on the way from p to q.
    void
    add_swept(const Point2 &p, const Point2 &q, const double radius, SectionSize &size)
    {
      const auto [enter, leave] = inside_disc(p, q, radius);
      const Point2 in = p + enter * (q - p), out = p + leave * (q - p);
      const auto   add_arc = [&](const Point2 &a, const Point2 &b) {
        const double angle =
          std::atan2(cross(a, b), dealii::Tensor<1, 2>(a) * dealii::Tensor<1, 2>(b));
        size.area += 0.5 * radius * radius * angle;
        size.perimeter += radius * std::abs(angle);
      };
      if (!(leave > enter))
        return add_arc(p, q);
      if (enter > 0.)
        add_arc(p, in);
      if (leave < 1.)
        add_arc(out, q);
      size.area += 0.5 * cross(in, out);
      size.perimeter += in.distance(out);
    }

    // Where a side of a body's section crosses a line, and whose it is.
    struct Side
    {
      Point2       low, high; // in y
      unsigned int body;

      double
      x_at(const double y) const
      {
        return low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]);
      }
    };

    // The sides that cross lines along x, by their lower ends. A corner at z lies
    // below it, for all triangles alike.
    std::vector<Side>
    sides_at(const std::vector<ClosedBody> &bodies, const double z)
    {
      std::vector<Side> sides;
      for (unsigned int body = 0; body < bodies.size(); ++body)
        for (const auto &triangle : bodies[body].triangles)
          {
            Point2       ends[2];
            unsigned int n = 0;
            for (unsigned int k = 0; k < 3; ++k)
              {
                dealii::Point<3> low = triangle[k], high = triangle[(k + 1) % 3];
                if (low[2] > high[2])
                  std::swap(low, high);
                if (!(high[2] > z) || low[2] > z)
                  continue;
                const auto at = low + (z - low[2]) / (high[2] - low[2]) * (high - low);
                ends[n++]     = Point2(at[0], at[1]);
              }
            if (n == 2 && ends[0][1] != ends[1][1])
              {
                if (ends[0][1] > ends[1][1])
                  std::swap(ends[0], ends[1]);
                sides.push_back({ends[0], ends[1], body});
              }
          }
      std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
        return a.low[1] < b.low[1];
      });
      return sides;
    }

    // The part of the line at y that is in the disc and all half planes.
    std::pair<double, double>
    chord(const double radius, const std::vector<HalfPlane> &halves, const double y)
    {
      double to = std::sqrt(std::max(0., radius * radius - y * y)), from = -to;
      for (const HalfPlane &half : halves)
        {
          const double room = half.c - half.b * y;
          if (half.a > 0.)
            to = std::min(to, room / half.a);
          else if (half.a < 0.)
            from = std::max(from, room / half.a);
          else if (room < 0.)
            to = from;
        }
      return {from, std::max(from, to)};
    }

    // The length of a chord inside of all containers and outside of all other bodies.
    class FreeLength
    {
    public:
      explicit FreeLength(const std::vector<ClosedBody> &bodies)
        : bodies(bodies)
      {
      }

      double
      operator()(const std::pair<double, double> &chord,
                 const std::vector<const Side *> &sides,
                 const double                     y)
      {
        crossings.clear();
        for (const Side *side : sides)
          if (side->low[1] <= y && y < side->high[1])
            crossings.emplace_back(side->x_at(y), side->body);
        std::sort(crossings.begin(), crossings.end());
        // How many bodies forbid the place, far outside of all.
        int blocked = 0;
        inside.assign(bodies.size(), false);
        for (const ClosedBody &body : bodies)
          blocked += body.is_container;
        double     length = 0., from = chord.first;
        const auto pass = [&](const double to) {
          const double end = std::clamp(to, chord.first, chord.second);
          if (blocked == 0)
            length += std::max(0., end - from);
          from = std::max(from, end);
        };
        for (const auto &[x, body] : crossings)
          {
            pass(x);
            inside[body] = !inside[body];
            blocked += inside[body] == bodies[body].is_container ? -1 : 1;
          }
        pass(chord.second);
        return length;
      }

    private:
      const std::vector<ClosedBody>               &bodies;
      std::vector<std::pair<double, unsigned int>> crossings;
      std::vector<bool>                            inside;
    };

    // Where the free length of lines is not smooth, and even strips between.
    std::vector<double>
    strip_ends(const double                  radius,
               const std::vector<HalfPlane> &halves,
               const std::vector<Side>      &sides)
    {
      std::vector<double> ends;
      for (unsigned int k = 0; k <= least_strips; ++k)
        ends.push_back(-radius * std::cos(dealii::numbers::PI * k / least_strips));
      const auto polygon = frame(radius, halves);
      for (std::size_t k = 0; k < polygon.size(); ++k)
        {
          const Point2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
          const auto [enter, leave] = inside_disc(p, q, radius);
          for (const double part : {0., enter, leave})
            ends.push_back(p[1] + part * (q[1] - p[1]));
        }
      for (const Side &side : sides)
        {
          ends.push_back(side.low[1]);
          ends.push_back(side.high[1]);
        }
      for (double &y : ends)
        y = std::clamp(y, -radius, radius);
      std::sort(ends.begin(), ends.end());
      ends.erase(std::unique(
                   ends.begin(),
                   ends.end(),
                   [&](const double a, const double b) { return b - a < 1e-9 * radius; }),
                 ends.end());
      return ends;
    }
  } // namespace

  SectionSize
  disc_section(const double radius, const std::vector<HalfSpace> &spaces, const double z)
  {
    const auto  polygon = frame(radius, half_planes(spaces, z));
    SectionSize size;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      add_swept(polygon[k], polygon[(k + 1) % polygon.size()], radius, size);
    size.area = std::max(0., size.area);
    return size;
  }

  double
  section_area(const double                   radius,
               const std::vector<HalfSpace>  &spaces,
               const std::vector<ClosedBody> &bodies,
               const double                   z)
  {
    const auto                halves = half_planes(spaces, z);
    const auto                sides  = sides_at(bodies, z);
    const auto                ends   = strip_ends(radius, halves, sides);
    FreeLength                free_length(bodies);
    double                    area = 0.;
    std::size_t               next = 0;
    std::vector<const Side *> present;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      {
        const double middle = 0.5 * (ends[k] + ends[k + 1]);
        const double half   = 0.5 * (ends[k + 1] - ends[k]);
        while (next < sides.size() && sides[next].low[1] < ends[k + 1])
          present.push_back(&sides[next++]);
        present.erase(
          std::remove_if(present.begin(),
                         present.end(),
                         [&](const Side *side) { return side->high[1] <= ends[k]; }),
          present.end());
        for (const int place : {-1, 0, 1})
          {
            const double y = middle + place * outer_point * half;
            area += half * (place == 0 ? 8. : 5.) / 9. *
                    free_length(chord(radius, halves, y), present, y);
          }
      }
    return area;
  }
} // namespace graupel
