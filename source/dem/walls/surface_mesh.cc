// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/walls/surface_mesh.h>
#include <graupel/dem/walls/surface_topology.h>

#include <CGAL/IO/STL.h>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <tuple>

namespace graupel
{
  namespace
  {
    namespace index = boost::geometry::index;

    using TreePoint =
      boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using TreeBox   = boost::geometry::model::box<TreePoint>;
    using TreeEntry = std::pair<TreeBox, unsigned int>;

    // Of the largest coordinate: a multiple of the rounding of a double.
    constexpr double rounding = 1e-14;
    // Of the longest side: below this height a triangle has no normal.
    constexpr double least_height = 1e-10;
    // Sine of the angle by which a contact may fail to be a local minimum.
    constexpr double same_angle = 1e-9;
    // Of the reach: places nearer to each other than this are the same.
    constexpr double same_place = 1e-3;
    // Rays that are tried, as one may meet an edge by chance, and their slope.
    constexpr unsigned int n_ray_directions = 8;
    constexpr double       ray_tilt         = 0.02;

    // Where on a triangle: see SurfaceTopology::feature().
    struct NearestPoint
    {
      dealii::Point<3> point;
      unsigned int     part;
    };

    dealii::Tensor<1, 3>
    unit_normal(const Triangle &t)
    {
      const auto area = area_vector(t);
      return area / area.norm();
    }

    /*
     * The point of a triangle nearest to x, by the Voronoi regions of its
     * corners and edges. With a_i, b_i the products of x - corner i with the
     * sides from corner 0 to corners 1 and 2, a corner's region lies between two
     * planes, and an edge's is where the barycentric weight of the corner
     * opposite, at the projection of x, is negative.
     * Source: Ericson, Real-Time Collision Detection (2005), section 5.1.5.
     */
    NearestPoint
    nearest_point(const Triangle &t, const dealii::Point<3> &x)
    {
      const auto   side_1 = t[1] - t[0], side_2 = t[2] - t[0];
      const double a0 = side_1 * (x - t[0]), b0 = side_2 * (x - t[0]);
      if (a0 <= 0. && b0 <= 0.)
        return {t[0], 4};

      const double a1 = side_1 * (x - t[1]), b1 = side_2 * (x - t[1]);
      if (a1 >= 0. && b1 <= a1)
        return {t[1], 5};
      if (a0 * b1 - a1 * b0 <= 0. && a0 >= 0. && a1 <= 0.)
        return {t[0] + a0 / (a0 - a1) * side_1, 1};

      const double a2 = side_1 * (x - t[2]), b2 = side_2 * (x - t[2]);
      if (b2 >= 0. && a2 <= b2)
        return {t[2], 6};
      if (a2 * b0 - a0 * b2 <= 0. && b0 >= 0. && b2 <= 0.)
        return {t[0] + b0 / (b0 - b2) * side_2, 3};
      if (a1 * b2 - a2 * b1 <= 0. && b1 >= a1 && a2 >= b2)
        return {t[1] + (b1 - a1) / ((b1 - a1) + (a2 - b2)) * (t[2] - t[1]), 2};

      const auto normal = unit_normal(t);
      return {x - ((x - t[0]) * normal) * normal, 0};
    }

    // How a ray meets a triangle; "unclear" where it is within rounding of an edge.
    enum class Crossing
    {
      none,
      crosses,
      unclear,
      begins_on_it
    };

    /*
     * The ray passes the triangle's three sides on the same hand: the volumes that it
     * spans with them have one sign.
     * Source: Ericson, Real-Time Collision Detection (2005), section 5.3.4.
     */
    Crossing
    crossing(const Triangle             &t,
             const dealii::Point<3>     &begin,
             const dealii::Tensor<1, 3> &direction)
    {
      const dealii::Tensor<1, 3> a = t[0] - begin, b = t[1] - begin, c = t[2] - begin;
      const double               size = std::max({a.norm(), b.norm(), c.norm()});
      const double error = 10. * rounding * std::max(size * size, begin.norm() * size);
      const double volumes[3] = {direction * dealii::cross_product_3d(b, c),
                                 direction * dealii::cross_product_3d(c, a),
                                 direction * dealii::cross_product_3d(a, b)};
      const auto   least      = *std::min_element(volumes, volumes + 3);
      const auto   most       = *std::max_element(volumes, volumes + 3);
      if (least < -error && most > error)
        return Crossing::none;
      if (least <= error && most >= -error)
        return Crossing::unclear;

      const auto   normal = unit_normal(t);
      const double height = a * normal;
      if (std::abs(height) <= 10. * rounding * std::max(size, begin.norm()))
        return Crossing::begins_on_it;
      return (height > 0.) == (direction * normal > 0.) ? Crossing::crosses
                                                        : Crossing::none;
    }

    void
    check_triangle(const unsigned int t, const Triangle &triangle)
    {
      const auto refuse = [&](const std::string &reason) {
        std::ostringstream text;
        text << "triangle " << t + 1 << " with corners (" << triangle[0] << "), ("
             << triangle[1] << "), (" << triangle[2] << ") m " << reason;
        throw InputError("", text.str());
      };
      for (const auto &corner : triangle)
        for (unsigned int d = 0; d < 3; ++d)
          if (!std::isfinite(corner[d]))
            refuse("has a coordinate that is not a finite number. Write the file anew.");

      const double longest = std::max({triangle[0].distance(triangle[1]),
                                       triangle[1].distance(triangle[2]),
                                       triangle[2].distance(triangle[0])});
      if (!(2. * area_vector(triangle).norm() > least_height * longest * longest))
        refuse("has no area. Remove degenerate triangles (most mesh programs have a "
               "command for it), or write the file with more digits.");
    }

    const std::vector<Triangle> &
    checked(const std::vector<Triangle> &triangles)
    {
      if (triangles.empty())
        throw InputError("", "there are no triangles. A surface needs at least one.");
      for (unsigned int t = 0; t < triangles.size(); ++t)
        check_triangle(t, triangles[t]);
      return triangles;
    }

    TreeBox
    box_around(const dealii::Point<3> &lower, const dealii::Point<3> &upper)
    {
      return {TreePoint(lower[0], lower[1], lower[2]),
              TreePoint(upper[0], upper[1], upper[2])};
    }

    TreeBox
    box_around(const dealii::Point<3> &center, const double reach)
    {
      const dealii::Tensor<1, 3> diagonal({reach, reach, reach});
      return box_around(center - diagonal, center + diagonal);
    }

    std::vector<TreeEntry>
    tree_entries(const SurfaceTopology &topology)
    {
      std::vector<TreeEntry> entries;
      entries.reserve(topology.n_triangles());
      for (unsigned int t = 0; t < topology.n_triangles(); ++t)
        {
          const Triangle   corners = topology.triangle(t);
          dealii::Point<3> lower = corners[0], upper = corners[0];
          for (unsigned int d = 0; d < 3; ++d)
            {
              lower[d] = std::min({corners[0][d], corners[1][d], corners[2][d]});
              upper[d] = std::max({corners[0][d], corners[1][d], corners[2][d]});
            }
          entries.emplace_back(box_around(lower, upper), t);
        }
      return entries;
    }

    // A corner for the reader's dictionary. Ordered with NaN as the largest
    // number: otherwise the reader takes it for any other number, and it is lost.
    struct StlCorner : public std::array<double, 3>
    {
      bool
      operator<(const StlCorner &other) const
      {
        const auto before = [](const double a, const double b) {
          return a < b || (std::isnan(b) && !std::isnan(a));
        };
        return std::lexicographical_compare(
          begin(), end(), other.begin(), other.end(), before);
      }
    };
  } // namespace

  struct SurfaceMesh::Data
  {
    explicit Data(const std::vector<Triangle> &triangles);

    bool is_nearest_around(const unsigned int      feature,
                           const dealii::Point<3> &point,
                           const dealii::Point<3> &center) const;
    void add_touch(const unsigned int      t,
                   const dealii::Point<3> &center,
                   const double            reach,
                   std::vector<Touch>     &touches) const;
    void name_after_facets(const double reach, std::vector<Touch> &touches) const;
    // Whether a ray from an inner point of the bounding box meets the surface an odd
    // number of times; nothing where that is unclear.
    std::optional<bool> is_inside(const dealii::Point<3>     &point,
                                  const dealii::Tensor<1, 3> &direction) const;

    SurfaceTopology                           topology;
    bool                                      is_closed;
    index::rtree<TreeEntry, index::rstar<16>> tree;
    dealii::BoundingBox<3>                    bounding_box;
  };

  SurfaceMesh::Data::Data(const std::vector<Triangle> &triangles)
    : topology(checked(triangles))
    , is_closed(topology.is_closed())
    , tree(tree_entries(topology))
  {
    const auto       bounds = tree.bounds();
    const auto      &lower = bounds.min_corner(), &upper = bounds.max_corner();
    dealii::Point<3> first(lower.get<0>(), lower.get<1>(), lower.get<2>());
    dealii::Point<3> last(upper.get<0>(), upper.get<1>(), upper.get<2>());
    bounding_box = dealii::BoundingBox<3>({first, last});
  }

  // Whether no triangle around an edge or a vertex comes nearer to the center
  // than the given point of it: none leads from there towards the center.
  bool
  SurfaceMesh::Data::is_nearest_around(const unsigned int      feature,
                                       const dealii::Point<3> &point,
                                       const dealii::Point<3> &center) const
  {
    const auto   to_center = center - point;
    const double distance  = to_center.norm();
    const double error     = rounding * topology.size();
    const double limit     = std::max(same_angle * distance, error);
    for (const unsigned int t : topology.triangles_of(feature))
      for (const auto &corner : topology.triangle(t))
        {
          const auto   along   = corner - point;
          const double advance = to_center * along;
          // The second term for corners so close that their direction is rounded.
          if (advance > 0. && advance > limit * along.norm() + error * distance)
            return false;
        }
    return true;
  }

  // Adds the nearest point of triangle t if it is a local minimum of the distance
  // that is not there yet, with the number of its feature for that of its facet.
  void
  SurfaceMesh::Data::add_touch(const unsigned int      t,
                               const dealii::Point<3> &center,
                               const double            reach,
                               std::vector<Touch>     &touches) const
  {
    const Triangle     triangle = topology.triangle(t);
    const auto         nearest  = nearest_point(triangle, center);
    const auto         vector   = nearest.point - center;
    const double       distance = vector.norm();
    const unsigned int feature  = topology.feature(t, nearest.part);
    if (!(distance < reach) ||
        std::any_of(touches.begin(),
                    touches.end(),
                    [&](const Touch &touch) { return touch.facet == feature; }) ||
        (nearest.part > 0 && !is_nearest_around(feature, nearest.point, center)))
      return;
    touches.push_back({feature,
                       nearest.point,
                       distance,
                       distance > rounding * topology.size() ? vector / distance
                                                             : unit_normal(triangle)});
  }

  // Each contact takes the lowest of its feature's facets that is free. Contacts
  // with one facet only have no choice and go first, the nearest ahead. Drops
  // those for which none is left, and those in the place of another.
  void
  SurfaceMesh::Data::name_after_facets(const double        reach,
                                       std::vector<Touch> &touches) const
  {
    const auto rank = [&](const Touch &touch) {
      return std::make_tuple(
        topology.facets_of(touch.facet).size() > 1, touch.distance, touch.facet);
    };
    std::sort(touches.begin(), touches.end(), [&](const Touch &a, const Touch &b) {
      return rank(a) < rank(b);
    });

    auto       end        = touches.begin();
    const auto same_facet = [&](const unsigned int facet) {
      return std::any_of(
        touches.begin(), end, [&](const Touch &other) { return other.facet == facet; });
    };
    for (const Touch &touch : touches)
      {
        if (std::any_of(touches.begin(), end, [&](const Touch &other) {
              return other.point.distance(touch.point) <= same_place * reach;
            }))
          continue;
        const auto facets = topology.facets_of(touch.facet);
        const auto facet  = std::find_if_not(facets.begin(), facets.end(), same_facet);
        if (facet == facets.end())
          continue;
        *end       = touch;
        end->facet = *facet;
        ++end;
      }
    touches.erase(end, touches.end());
  }

  std::optional<bool>
  SurfaceMesh::Data::is_inside(const dealii::Point<3>     &point,
                               const dealii::Tensor<1, 3> &direction) const
  {
    // The box around a ray that nearly follows a coordinate is thin.
    const auto       corners = bounding_box.get_boundary_points();
    const auto       way     = 2. * corners.first.distance(corners.second) * direction;
    dealii::Point<3> lower = point, upper = point;
    for (unsigned int d = 0; d < 3; ++d)
      (way[d] < 0. ? lower : upper)[d] += way[d];
    unsigned int n_crossings = 0;
    bool         is_clear = true, is_on_it = false;
    const auto   meet = [&](const TreeEntry &entry) {
      const auto found = crossing(topology.triangle(entry.second), point, direction);
      n_crossings += found == Crossing::crosses;
      is_clear = is_clear && found != Crossing::unclear;
      is_on_it = is_on_it || found == Crossing::begins_on_it;
    };
    tree.query(index::intersects(box_around(lower, upper)),
               boost::make_function_output_iterator(meet));
    if (is_on_it)
      return true;
    return is_clear ? std::optional<bool>(n_crossings % 2 == 1) : std::nullopt;
  }

  SurfaceMesh::SurfaceMesh(const std::vector<std::array<dealii::Point<3>, 3>> &triangles)
    : data(std::make_shared<const Data>(triangles))
  {
  }

  SurfaceMesh
  SurfaceMesh::read_stl(const std::string &file, const double scale)
  {
    const auto refuse = [&](const std::string &reason) {
      throw InputError("", "surface file " + file + ": " + reason);
    };
    if (!(scale > 0. && std::isfinite(scale)))
      refuse("its scale must be a positive number, such as 0.001 for millimetres.");
    if (!std::ifstream(file))
      refuse("it cannot be opened. Is the path right, seen from where the run starts?");

    std::vector<StlCorner>                   corners;
    std::vector<std::array<unsigned int, 3>> numbers;
    if (!CGAL::IO::read_STL(file, corners, numbers))
      refuse("it is not a whole STL file, neither as text nor as binary. Is it cut "
             "off, or has it a coordinate that is not a number?");

    std::vector<Triangle> triangles(numbers.size());
    for (unsigned int t = 0; t < triangles.size(); ++t)
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int d = 0; d < 3; ++d)
          triangles[t][k][d] = scale * corners[numbers[t][k]][d];
    try
      {
        return SurfaceMesh(triangles);
      }
    catch (const InputError &error)
      {
        refuse(error.what());
        throw;
      }
  }

  void
  SurfaceMesh::touches(const dealii::Point<3> &center,
                       const double            reach,
                       std::vector<Touch>     &touches) const
  {
    touches.clear();
    data->tree.query(index::intersects(box_around(center, reach)),
                     boost::make_function_output_iterator([&](const TreeEntry &entry) {
                       data->add_touch(entry.second, center, reach, touches);
                     }));
    if (!touches.empty())
      data->name_after_facets(reach, touches);
  }

  bool
  SurfaceMesh::near(const dealii::Point<3> &center, const double reach) const
  {
    const auto is_near = [&](const TreeEntry &entry) {
      return nearest_point(data->topology.triangle(entry.second), center)
               .point.distance(center) < reach;
    };
    return data->tree.qbegin(index::intersects(box_around(center, reach)) &&
                             index::satisfies(is_near)) != data->tree.qend();
  }

  unsigned int
  SurfaceMesh::n_triangles() const
  {
    return data->topology.n_triangles();
  }

  unsigned int
  SurfaceMesh::n_facets() const
  {
    return data->topology.n_facets();
  }

  unsigned int
  SurfaceMesh::n_free_edges() const
  {
    return data->topology.n_free_edges();
  }

  std::array<dealii::Point<3>, 3>
  SurfaceMesh::triangle(const unsigned int t) const
  {
    return data->topology.triangle(t);
  }

  bool
  SurfaceMesh::is_closed() const
  {
    return data->is_closed;
  }

  bool
  SurfaceMesh::contains(const dealii::Point<3> &point) const
  {
    if (!is_closed() || !bounding_box().point_inside(point))
      return false;
    // Up, and aside by what no edge of a drawing is; anew where that meets an edge.
    for (unsigned int k = 0; k < n_ray_directions; ++k)
      {
        dealii::Tensor<1, 3> direction(
          {ray_tilt * std::sin(1. + 2.3 * k), ray_tilt * std::sin(2. + 3.1 * k), 1.});
        direction /= direction.norm();
        if (const auto inside = data->is_inside(point, direction))
          return *inside;
      }
    return true; // on an edge or a corner
  }

  const dealii::BoundingBox<3> &
  SurfaceMesh::bounding_box() const
  {
    return data->bounding_box;
  }
} // namespace graupel
