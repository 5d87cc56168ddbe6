// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/mesh/mesh_outline.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace graupel
{
  namespace
  {
    using dealii::Point;
    using Vector              = dealii::Tensor<1, 3>;
    constexpr double infinity = std::numeric_limits<double>::infinity();

    // Of the vessel's size: what is closer lies in one plane.
    constexpr double flatness = 1e-6;
    // Cuts of a face that is not flat, along each side.
    constexpr unsigned int cuts = 8;
    // Heights of corners beyond which the section is not told between all of them.
    constexpr std::size_t most_heights = 256;

    // Corners in the order of deal.II: 0-1 and 2-3 are sides.
    struct Face
    {
      std::array<Point<3>, 4> corners;
      Vector                  outwards; // about
      std::string             name;
      bool                    on_cylinder;

      Point<3>
      at(const double s, const double t) const
      {
        return Point<3>((1. - t) * ((1. - s) * Vector(corners[0]) + s * corners[1]) +
                        t * ((1. - s) * Vector(corners[2]) + s * corners[3]));
      }

      // Area times normal.
      Vector
      area() const
      {
        const Vector area = 0.5 * dealii::cross_product_3d(corners[3] - corners[0],
                                                           corners[2] - corners[1]);
        return area * outwards > 0. ? area : -area;
      }

      bool
      lies_between(const double lower, const double upper) const
      {
        return std::all_of(corners.begin(), corners.end(), [&](const auto &corner) {
          return corner[2] >= lower && corner[2] <= upper;
        });
      }

      bool
      is_flat(const double tolerance) const
      {
        const Vector normal = area() / area().norm();
        const auto   middle = at(0.5, 0.5);
        return std::all_of(corners.begin(), corners.end(), [&](const auto &corner) {
          return std::abs((corner - middle) * normal) <= tolerance;
        });
      }
    };

    std::vector<Face>
    boundary_faces(const dealii::Triangulation<3>                          &coarse,
                   const dealii::types::manifold_id                         curved,
                   const std::map<std::string, dealii::types::boundary_id> &names)
    {
      std::map<dealii::types::boundary_id, std::string> name_of;
      for (const auto &[name, id] : names)
        name_of[id] = name;
      std::vector<Face> faces;
      for (const auto &cell : coarse.cell_iterators_on_level(0))
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              Face f;
              for (const unsigned int v : face->vertex_indices())
                f.corners[v] = face->vertex(v);
              f.outwards    = face->center() - cell->center();
              f.name        = name_of[face->boundary_id()];
              f.on_cylinder = face->manifold_id() == curved;
              faces.push_back(f);
            }
      return faces;
    }

    // Twice the area that a triangle of the boundary sweeps over, seen from the axis, as
    // it is cut by the plane at z; positive against the clock. On the cylinder its sides
    // are straight in angle and height.
    double
    swept_at(const double                   z,
             const std::array<Point<3>, 3> &triangle,
             const Vector                  &outwards,
             const bool                     on_cylinder,
             const double                   radius)
    {
      // A corner at z lies below it: so does the next triangle's, and loops are closed.
      Point<3>     ends[2];
      double       angles[2];
      unsigned int n       = 0;
      const double forward = std::atan2(triangle[0][1], triangle[0][0]);
      const auto   angle   = [&](const Point<3> &x) { // in the neighbourhood of forward
        return std::remainder(std::atan2(x[1], x[0]) - forward, 2. * dealii::numbers::PI);
      };
      for (unsigned int k = 0; k < 3; ++k)
        {
          Point<3> low = triangle[k], high = triangle[(k + 1) % 3];
          if (low[2] > high[2])
            std::swap(low, high);
          if (!(high[2] > z) || low[2] > z)
            continue;
          const double part = (z - low[2]) / (high[2] - low[2]);
          ends[n]           = low + part * (high - low);
          angles[n]         = (1. - part) * angle(low) + part * angle(high);
          ++n;
        }
      if (n < 2)
        return 0.;
      if (on_cylinder)
        return radius * radius * std::abs(angles[1] - angles[0]);
      const Vector along = ends[1] - ends[0];
      const double cross = ends[0][0] * ends[1][1] - ends[0][1] * ends[1][0];
      return along[1] * outwards[0] - along[0] * outwards[1] > 0. ? cross : -cross;
    }

    double
    swept_at(const double z, const Face &face, const double radius, const bool flat)
    {
      if (face.lies_between(z, infinity) || face.lies_between(-infinity, z))
        return 0.;
      const unsigned int n     = flat || face.on_cylinder ? 1 : cuts;
      double             swept = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const Point<3> a = face.at(i / double(n), j / double(n)),
                           b = face.at((i + 1) / double(n), j / double(n)),
                           c = face.at(i / double(n), (j + 1) / double(n)),
                           d = face.at((i + 1) / double(n), (j + 1) / double(n));
            for (const auto &triangle : {std::array<Point<3>, 3>{{a, b, d}}, {{a, d, c}}})
              {
                Vector normal = dealii::cross_product_3d(triangle[1] - triangle[0],
                                                         triangle[2] - triangle[0]);
                if (normal * face.outwards < 0.)
                  normal *= -1.;
                swept += swept_at(z, triangle, normal, face.on_cylinder, radius);
              }
          }
      return swept;
    }

    // The heights between which the section is a parabola, not closer than tolerance; of
    // a mesh with too many of them only those at which it can jump.
    std::vector<double>
    heights(const std::vector<Face> &faces, const double height, const double tolerance)
    {
      std::vector<double> all, of_steps;
      for (const Face &face : faces)
        {
          const double z = face.corners[0][2];
          if (face.lies_between(z - tolerance, z + tolerance))
            of_steps.push_back(z);
          for (const auto &corner : face.corners)
            all.push_back(corner[2]);
        }
      const auto apart = [&](std::vector<double> values) {
        std::sort(values.begin(), values.end());
        std::vector<double> result{0.};
        for (const double z : values)
          if (z > result.back() + tolerance && z < height - tolerance)
            result.push_back(z);
        result.push_back(height);
        return result;
      };
      const auto result = apart(all);
      return result.size() > most_heights ? apart(of_steps) : result;
    }

    std::vector<FlatBoundary>
    planes_of(const std::vector<Face> &faces, const double height, const double tolerance)
    {
      struct Plane
      {
        Vector                        normal, moment;
        Point<3>                      point;
        double                        area = 0.;
        std::map<std::string, double> names;
      };
      std::vector<Plane> planes;
      for (const Face &face : faces)
        {
          if (face.on_cylinder)
            continue;
          if (face.lies_between(-tolerance, tolerance) ||
              face.lies_between(height - tolerance, height + tolerance))
            continue;
          const double measure = face.area().norm();
          const Vector normal  = face.area() / measure;
          const auto   plane =
            std::find_if(planes.begin(), planes.end(), [&](const Plane &p) {
              return (p.normal - normal).norm() < 1e-6 &&
                     std::abs((face.corners[0] - p.point) * p.normal) <= tolerance;
            });
          Plane &p = plane == planes.end() ? planes.emplace_back() : *plane;
          if (p.area == 0.)
            {
              p.normal = normal;
              p.point  = face.at(0.5, 0.5);
            }
          p.moment += measure * Vector(face.at(0.5, 0.5));
          p.area += measure;
          p.names[face.name] += measure;
        }
      std::stable_sort(planes.begin(), planes.end(), [](const auto &a, const auto &b) {
        return a.area > b.area * (1. + 1e-9);
      });
      std::vector<FlatBoundary> result;
      for (const Plane &p : planes)
        {
          const auto most = std::max_element(
            p.names.begin(), p.names.end(), [](const auto &a, const auto &b) {
              return a.second < b.second;
            });
          result.push_back({most->first, Point<3>(p.moment / p.area), p.normal, p.area});
        }
      return result;
    }
  } // namespace

  MeshOutline::MeshOutline(const Cylinder                  &cylinder,
                           const dealii::Triangulation<3>  &coarse,
                           const dealii::types::manifold_id curved,
                           const std::map<std::string, dealii::types::boundary_id> &names)
  {
    const std::vector<Face> faces = boundary_faces(coarse, curved, names);
    const double      tolerance = flatness * std::max(cylinder.diameter, cylinder.height);
    const double      radius    = cylinder.diameter / 2.;
    std::vector<bool> is_flat;
    for (const Face &face : faces)
      {
        is_flat.push_back(face.is_flat(tolerance));
        if (!face.on_cylinder && !is_flat.back())
          curved_name = face.name;
      }
    const auto levels = heights(faces, cylinder.height, tolerance);
    profile           = AreaProfile(
      [&](const double z) {
        double swept = 0.;
        for (std::size_t k = 0; k < faces.size(); ++k)
          swept += swept_at(z, faces[k], radius, is_flat[k]);
        return std::max(0., 0.5 * swept);
      },
      levels,
      cylinder.height / most_heights);
    flat = planes_of(faces, cylinder.height, tolerance);
    for (const FlatBoundary &plane : flat)
      for (const Face &face : faces)
        for (const auto &corner : face.corners)
          farthest = std::max(farthest, (corner - plane.point) * plane.normal);
  }
} // namespace graupel
