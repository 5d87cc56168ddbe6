// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_dem_shapes_h
#define graupel_tests_dem_shapes_h

#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/vessel/vessel.h>

#include <cmath>
#include <functional>

namespace graupel
{
  /** A vessel, and what it is by simpler means. */
  struct Shape
  {
    std::string name;
    Vessel      vessel;
    /** Whether a point is at least so far inside [m]. */
    std::function<bool(const dealii::Point<3> &, const double)> is_inside;
    /** Area of the section [m^2], where it is known. */
    std::function<double(double)> area;
  };

  /** The sides x = +-a and y = +-b. */
  inline std::vector<HalfSpace>
  four_sides(const double a, const double b)
  {
    using dealii::Point;
    const auto normal = [](const double x, const double y) {
      return dealii::Tensor<1, 3>({x, y, 0.});
    };
    return {{Point<3>(a, 0., 0.), normal(1., 0.)},
            {Point<3>(-a, 0., 0.), normal(-1., 0.)},
            {Point<3>(0., b, 0.), normal(0., 1.)},
            {Point<3>(0., -b, 0.), normal(0., -1.)}};
  }

  /** A closed frustum around the z axis, from radius @p r at @p z to @p R at @p Z. */
  inline std::vector<std::array<dealii::Point<3>, 3>>
  frustum(
    const double r, const double z, const double R, const double Z, const unsigned int n)
  {
    using dealii::Point;
    const auto at = [&](const unsigned int k, const double radius, const double height) {
      const double angle = 2. * dealii::numbers::PI * (k % n) / n;
      return Point<3>(radius * std::cos(angle), radius * std::sin(angle), height);
    };
    std::vector<std::array<Point<3>, 3>> triangles;
    for (unsigned int k = 0; k < n; ++k)
      {
        triangles.push_back({{at(k, r, z), at(k + 1, r, z), at(k, R, Z)}});
        triangles.push_back({{at(k, R, Z), at(k + 1, r, z), at(k + 1, R, Z)}});
        triangles.push_back({{at(k, r, z), Point<3>(0., 0., z), at(k + 1, r, z)}});
        triangles.push_back({{at(k, R, Z), at(k + 1, R, Z), Point<3>(0., 0., Z)}});
      }
    return triangles;
  }

  /**
   * A cylinder of 25 mm; a square duct of 16 mm; a slab of 44 mm x 10 mm; a cone of 45
   * degrees, from 8 mm to 40 mm across; a pyramid of four planes that meet at a point.
   */
  inline std::vector<Shape>
  shapes()
  {
    using dealii::Point;
    std::vector<Shape> result;
    const double       height = 0.06;
    const auto         in_box = [=](const double a, const double b) {
      return [=](const Point<3> &x, const double room) {
        return std::abs(x[0]) <= a - room && std::abs(x[1]) <= b - room && x[2] >= room &&
               x[2] <= height - room;
      };
    };
    result.push_back(
      {"cylinder",
       Vessel(Cylinder{0.025, height}),
       [=](const Point<3> &x, const double room) {
         return std::hypot(x[0], x[1]) <= 0.0125 - room && x[2] >= room &&
                x[2] <= height - room;
       },
       [](const double) { return dealii::numbers::PI * 0.0125 * 0.0125; }});
    result.push_back({"duct",
                      Vessel(Cylinder{0.0228, height}, four_sides(0.008, 0.008)),
                      in_box(0.008, 0.008),
                      [](const double) { return 0.016 * 0.016; }});
    result.push_back({"slab",
                      Vessel(Cylinder{0.046, height}, four_sides(0.022, 0.005)),
                      in_box(0.022, 0.005),
                      [](const double) { return 0.044 * 0.010; }});

    const unsigned int n      = 256;
    const double       bottom = 0.006, top = 0.022, r = 0.004, R = 0.02;
    const double pi = dealii::numbers::PI, of_circle = n / 2. * std::sin(2. * pi / n);
    result.push_back(
      {"cone",
       Vessel(Cylinder{0.042, height}, {}, {{frustum(r, bottom, R, top, n), true}}),
       [=](const Point<3> &x, const double room) {
         return std::hypot(x[0], x[1]) <= r + x[2] - bottom - std::sqrt(2.) * room &&
                x[2] >= bottom + room && x[2] <= top - room;
       },
       [=](const double z) {
         return z < bottom || z > top ? 0. : of_circle * std::pow(r + z - bottom, 2);
       }});

    // Sides that rise twice as much as they go out, from the origin's 4 mm on.
    std::vector<HalfSpace> slopes;
    const double           c = 1. / std::sqrt(5.), s = 2. / std::sqrt(5.);
    for (const auto &[x, y] :
         {std::pair<double, double>{1., 0.}, {-1., 0.}, {0., 1.}, {0., -1.}})
      slopes.push_back(
        {Point<3>(0., 0., 0.004), dealii::Tensor<1, 3>({s * x, s * y, -c})});
    result.push_back(
      {"pyramid",
       Vessel(Cylinder{0.1, 0.04}, slopes),
       [=](const Point<3> &x, const double room) {
         const double half = (x[2] - 0.004) / 2. - room / s;
         return std::abs(x[0]) <= half && std::abs(x[1]) <= half && x[2] <= 0.04 - room;
       },
       [](const double z) { return z < 0.004 ? 0. : (z - 0.004) * (z - 0.004); }});
    return result;
  }

  /** Spheres of diameter @p d, on a cubic lattice that begins on the plane z = @p lowest,
   * as many as the shape holds below @p upper; this rank's, or all. */
  inline ParticleArrays
  lattice_in(const Shape &shape,
             const double d,
             const double lowest,
             const double upper,
             const bool   shared_out)
  {
    ParticleArrays     spheres;
    const unsigned int me    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const int          n     = static_cast<int>(shape.vessel.cylinder().diameter / d) + 1;
    unsigned int       count = 0;
    for (double z = lowest + d / 2.; z < upper - 0.4999 * d; z += d)
      for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
          {
            const dealii::Point<3> x(i * d, j * d, z);
            // Room is kept with rounding in mind.
            if (!shape.is_inside(x, d / 2. * (1. - 1e-9)))
              continue;
            if (!shared_out || count++ % ranks == me)
              {
                spheres.resize(++spheres.n_owned);
                spheres.body.back().radius   = d / 2.;
                spheres.body.back().position = x;
              }
          }
    return spheres;
  }
} // namespace graupel

#endif
