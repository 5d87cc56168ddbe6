// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_walls_surface_topology_h
#define graupel_dem_walls_surface_topology_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace graupel
{
  /** Corners of a triangle [m]. */
  using Triangle = std::array<dealii::Point<3>, 3>;

  /** The area times the unit normal [m^2]. */
  inline dealii::Tensor<1, 3>
  area_vector(const Triangle &t)
  {
    return 0.5 * dealii::cross_product_3d(t[1] - t[0], t[2] - t[0]);
  }

  /**
   * Which triangles of a surface are neighbours, and which form a flat facet
   * together; see SurfaceMesh, which is made of it.
   *
   * A feature is the inside of a triangle, an edge or a vertex. They have one
   * numbering, in this order, so that a place found from two triangles has the
   * same number from both.
   */
  class SurfaceTopology
  {
  public:
    /** For each item a list of numbers, all in one array. */
    struct Lists
    {
      std::vector<unsigned int> starts = {0};
      std::vector<unsigned int> entries;

      const unsigned int *
      begin(const unsigned int item) const
      {
        return entries.data() + starts[item];
      }

      const unsigned int *
      end(const unsigned int item) const
      {
        return entries.data() + starts[item + 1];
      }
    };

    /** A range of numbers, for loops. */
    struct Range
    {
      const unsigned int *first, *last;

      const unsigned int *
      begin() const
      {
        return first;
      }

      const unsigned int *
      end() const
      {
        return last;
      }

      unsigned int
      size() const
      {
        return last - first;
      }
    };

    /** From triangles with finite corners and areas that are not zero. */
    explicit SurfaceTopology(const std::vector<Triangle> &triangles);

    unsigned int
    n_triangles() const
    {
      return corners.size();
    }

    unsigned int
    n_facets() const
    {
      return number_of_facets;
    }

    /** Edges of one triangle only. */
    unsigned int n_free_edges() const;

    /** Whether each edge belongs to two triangles. */
    bool is_closed() const;

    /** The largest absolute coordinate [m], by which rounding is measured. */
    double
    size() const
    {
      return largest_coordinate;
    }

    Triangle
    triangle(const unsigned int t) const
    {
      return {
        {vertices[corners[t][0]], vertices[corners[t][1]], vertices[corners[t][2]]}};
    }

    /**
     * Number of the feature that is a part of triangle @p t: 0 the inside, 1 to
     * 3 the edges (edge k begins at corner k - 1), 4 to 6 the corners.
     */
    unsigned int
    feature(const unsigned int t, const unsigned int part) const
    {
      if (part == 0)
        return t;
      return n_triangles() +
             (part < 4 ? edges[t][part - 1] : n_edges + corners[t][part - 4]);
    }

    /** The triangles that a feature belongs to, in rising order. */
    Range triangles_of(const unsigned int feature) const;

    /** The facets that a feature belongs to, in rising order. */
    Range facets_of(const unsigned int feature) const;

  private:
    void   join_corners(const std::vector<Triangle> &triangles);
    void   number_edges();
    void   list_triangles();
    void   join_facets();
    double grow_facet(const unsigned int seed, const unsigned int facet);
    bool   opposite(const unsigned int t,
                    const unsigned int side,
                    const unsigned int other) const;
    void   sort_facets(const std::vector<double> &areas);
    void   list_facets();

    std::vector<dealii::Point<3>> vertices;
    /** Vertices of each triangle, and its edges: edge k begins at corner k. */
    std::vector<std::array<unsigned int, 3>> corners, edges;
    unsigned int                             n_edges            = 0;
    unsigned int                             number_of_facets   = 0;
    double                                   largest_coordinate = 0.;

    /** For each edge, then for each vertex. */
    Lists triangles, facets;
    /** 0, 1, 2 ...: what a triangle's inside belongs to. */
    std::vector<unsigned int> triangle_itself, facet_of_triangle;
  };
} // namespace graupel

#endif
