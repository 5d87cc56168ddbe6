// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/walls/surface_topology.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace graupel
{
  namespace
  {
    // Of the largest coordinate: how far single precision or six printed digits
    // move a corner out of its plane.
    constexpr double flatness = 1e-5;

    // Of the largest coordinate: how far rounding moves a corner that was computed twice.
    constexpr double same_corner = 1e-13;

    constexpr unsigned int unassigned = static_cast<unsigned int>(-1);

    // A plane through the middle of the triangles added to it, each counted by
    // its area: the more of them, the less the rounding of one tilts it.
    struct MeanPlane
    {
      dealii::Tensor<1, 3> area_sum, center_sum;
      double               area = 0.;

      void
      add(const Triangle &t)
      {
        const auto   vector  = area_vector(t);
        const double measure = vector.norm();
        area_sum += vector * area_sum >= 0. ? vector : -vector;
        center_sum += measure / 3. * ((t[0] + t[1]) + t[2]);
        area += measure;
      }

      bool
      contains(const Triangle &t, const double tolerance) const
      {
        const auto normal = area_sum / area_sum.norm();
        const auto center = center_sum / area;
        return std::all_of(t.begin(), t.end(), [&](const auto &corner) {
          return std::abs((corner - center) * normal) <= tolerance;
        });
      }
    };
  } // namespace

  SurfaceTopology::SurfaceTopology(const std::vector<Triangle> &triangles)
  {
    join_corners(triangles);
    number_edges();
    list_triangles();
    join_facets();
    list_facets();
  }

  unsigned int
  SurfaceTopology::n_free_edges() const
  {
    unsigned int n = 0;
    for (unsigned int e = 0; e < n_edges; ++e)
      n += triangles.end(e) - triangles.begin(e) == 1;
    return n;
  }

  bool
  SurfaceTopology::is_closed() const
  {
    for (unsigned int e = 0; e < n_edges; ++e)
      if (triangles.end(e) - triangles.begin(e) != 2)
        return false;
    return true;
  }

  SurfaceTopology::Range
  SurfaceTopology::triangles_of(const unsigned int feature) const
  {
    if (feature < n_triangles())
      return {&triangle_itself[feature], &triangle_itself[feature] + 1};
    const unsigned int item = feature - n_triangles();
    return {triangles.begin(item), triangles.end(item)};
  }

  SurfaceTopology::Range
  SurfaceTopology::facets_of(const unsigned int feature) const
  {
    if (feature < n_triangles())
      return {&facet_of_triangle[feature], &facet_of_triangle[feature] + 1};
    const unsigned int item = feature - n_triangles();
    return {facets.begin(item), facets.end(item)};
  }

  // Corners with the same numbers become one vertex, and so do those next to each other.
  void
  SurfaceTopology::join_corners(const std::vector<Triangle> &soup)
  {
    const auto corner = [&](const unsigned int c) -> const dealii::Point<3> & {
      return soup[c / 3][c % 3];
    };
    const auto numbers = [&](const unsigned int c) {
      return std::tie(corner(c)[0], corner(c)[1], corner(c)[2]);
    };

    std::vector<unsigned int> order(3 * soup.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return numbers(a) < numbers(b);
    });

    corners.resize(soup.size());
    for (const unsigned int c : order)
      {
        if (vertices.empty() || vertices.back() != corner(c))
          vertices.push_back(corner(c));
        corners[c / 3][c % 3] = vertices.size() - 1;
        for (unsigned int d = 0; d < 3; ++d)
          largest_coordinate = std::max(largest_coordinate, std::abs(corner(c)[d]));
      }

    namespace index                 = boost::geometry::index;
    const auto                 tree = dealii::pack_rtree_of_indices(vertices);
    const dealii::Tensor<1, 3> reach({same_corner * largest_coordinate,
                                      same_corner * largest_coordinate,
                                      same_corner * largest_coordinate});
    std::vector<unsigned int>  first(vertices.size());
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        const dealii::BoundingBox<3> near({vertices[v] - reach, vertices[v] + reach});
        first[v] = v;
        for (const auto other : tree | index::adaptors::queried(index::intersects(near)))
          first[v] = std::min<unsigned int>(first[v], other);
      }
    for (auto &of_triangle : corners)
      for (unsigned int &vertex : of_triangle)
        vertex = first[vertex];
  }

  void
  SurfaceTopology::number_edges()
  {
    // Sides of triangles, side k of triangle t as 3 t + k, by the ends.
    const auto ends = [&](const unsigned int side) {
      const auto        &c = corners[side / 3];
      const unsigned int a = c[side % 3], b = c[(side % 3 + 1) % 3];
      return std::make_pair(std::min(a, b), std::max(a, b));
    };
    std::vector<unsigned int> order(3 * n_triangles());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return ends(a) < ends(b);
    });

    edges.resize(n_triangles());
    for (unsigned int k = 0; k < order.size(); ++k)
      {
        n_edges += k == 0 || ends(order[k]) != ends(order[k - 1]);
        edges[order[k] / 3][order[k] % 3] = n_edges - 1;
      }
  }

  void
  SurfaceTopology::list_triangles()
  {
    triangle_itself.resize(n_triangles());
    std::iota(triangle_itself.begin(), triangle_itself.end(), 0);

    triangles.starts.assign(n_edges + vertices.size() + 1, 0);
    for (unsigned int t = 0; t < n_triangles(); ++t)
      for (unsigned int part = 1; part < 7; ++part)
        ++triangles.starts[feature(t, part) - n_triangles() + 1];
    std::partial_sum(
      triangles.starts.begin(), triangles.starts.end(), triangles.starts.begin());

    triangles.entries.resize(triangles.starts.back());
    std::vector<unsigned int> next = triangles.starts;
    for (unsigned int t = 0; t < n_triangles(); ++t)
      for (unsigned int part = 1; part < 7; ++part)
        triangles.entries[next[feature(t, part) - n_triangles()]++] = t;
  }

  // Facets grow from the largest triangles, whose planes are known best.
  void
  SurfaceTopology::join_facets()
  {
    std::vector<double> areas(n_triangles());
    for (unsigned int t = 0; t < n_triangles(); ++t)
      areas[t] = area_vector(triangle(t)).norm();
    std::vector<unsigned int> order = triangle_itself;
    std::stable_sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return areas[a] > areas[b];
    });

    facet_of_triangle.assign(n_triangles(), unassigned);
    std::vector<double> facet_areas;
    for (const unsigned int seed : order)
      if (facet_of_triangle[seed] == unassigned)
        facet_areas.push_back(grow_facet(seed, facet_areas.size()));
    number_of_facets = facet_areas.size();
    sort_facets(facet_areas);
  }

  // Adds triangle after triangle across flat joints; returns the area [m^2].
  double
  SurfaceTopology::grow_facet(const unsigned int seed, const unsigned int facet)
  {
    MeanPlane plane;
    plane.add(triangle(seed));
    facet_of_triangle[seed] = facet;

    std::vector<unsigned int> front = {seed};
    while (!front.empty())
      {
        const unsigned int t = front.back();
        front.pop_back();
        for (unsigned int side = 0; side < 3; ++side)
          for (const unsigned int other : triangles_of(feature(t, side + 1)))
            if (facet_of_triangle[other] == unassigned && opposite(t, side, other) &&
                plane.contains(triangle(other), flatness * largest_coordinate))
              {
                plane.add(triangle(other));
                facet_of_triangle[other] = facet;
                front.push_back(other);
              }
      }
    return plane.area;
  }

  // Whether two triangles in one plane lie on two sides of their common edge,
  // rather than one upon the other.
  bool
  SurfaceTopology::opposite(const unsigned int t,
                            const unsigned int side,
                            const unsigned int other) const
  {
    const auto  &own    = corners[t];
    const auto  &theirs = corners[other];
    const auto   edge   = edges[t][side];
    const auto   start  = vertices[own[side]];
    auto         along  = vertices[own[(side + 1) % 3]] - start;
    unsigned int k      = 0;
    while (edges[other][k] != edge)
      ++k;
    along /= along.norm();
    const auto from_edge = [&](const unsigned int vertex) {
      const auto v = vertices[vertex] - start;
      return v - (v * along) * along;
    };
    return from_edge(own[(side + 2) % 3]) * from_edge(theirs[(k + 2) % 3]) < 0.;
  }

  // The smallest first: where a contact on an edge takes the lowest of several
  // numbers, that is the one least likely to be taken by another contact.
  void
  SurfaceTopology::sort_facets(const std::vector<double> &areas)
  {
    std::vector<unsigned int> order(areas.size()), place(areas.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return areas[a] < areas[b];
    });
    for (unsigned int k = 0; k < order.size(); ++k)
      place[order[k]] = k;
    for (unsigned int &facet : facet_of_triangle)
      facet = place[facet];
  }

  void
  SurfaceTopology::list_facets()
  {
    facets.starts.reserve(triangles.starts.size());
    for (unsigned int item = 0; item + 1 < triangles.starts.size(); ++item)
      {
        const auto start = facets.entries.size();
        for (auto t = triangles.begin(item); t != triangles.end(item); ++t)
          facets.entries.push_back(facet_of_triangle[*t]);
        const auto first = facets.entries.begin() + start;
        std::sort(first, facets.entries.end());
        facets.entries.erase(std::unique(first, facets.entries.end()),
                             facets.entries.end());
        facets.starts.push_back(facets.entries.size());
      }
  }
} // namespace graupel
