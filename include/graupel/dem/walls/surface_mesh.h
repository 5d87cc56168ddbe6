// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_walls_surface_mesh_h
#define graupel_dem_walls_surface_mesh_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * A wall made of triangles, e.g. from an STL file. It is a sheet with two
   * sides: which way a triangle is wound plays no role, and a sphere may touch
   * from either side.
   *
   * Neighbouring triangles in one plane form a facet, whose number is the name
   * of a contact: a sphere that rolls over the joint of two such triangles
   * keeps its contact and the springs stored under that name. "In one plane"
   * means that no corner is off by more than 1e-5 of the mesh's largest
   * coordinate, which is what single precision and six printed digits leave of
   * a plane. The smallest facet has number 0.
   *
   * A sphere touches where the distance from its center has a local minimum
   * over the surface, neighbours across edges and corners included. So a sphere
   * on a face near a convex edge has one contact, one on the edge itself has
   * one, and one in a concave corner has one with each face. Triangles are
   * neighbours where their corners are the same numbers; at a joint where they
   * are not (a corner in the middle of another triangle's edge), a facet ends.
   *
   * The same on every rank. Constant after construction; threads may share it.
   */
  class SurfaceMesh
  {
  public:
    /** One place where a sphere touches. */
    struct Touch
    {
      /** Name of the contact, below n_facets(), each at most once a sphere. */
      unsigned int facet;
      /** The place, on the surface [m]. */
      dealii::Point<3> point;
      /** From the center to the place, never negative [m]. */
      double distance;
      /**
       * Unit vector from the center to the place. A center on the surface,
       * to rounding, has no such direction and gets a normal of the triangle.
       */
      dealii::Tensor<1, 3> normal;
    };

    /**
     * From triangles given by their corners [m]. Throws InputError if there is
     * none, if a coordinate is not a finite number, or if a triangle has no
     * area; the first triangle is number 1 in the message.
     */
    explicit SurfaceMesh(const std::vector<std::array<dealii::Point<3>, 3>> &triangles);

    /**
     * From an STL file, text or binary. The format has no unit: coordinates are
     * multiplied by @p scale to give metres, 1e-3 for a file in millimetres.
     * Its normals are ignored. Throws InputError, with the name of the file,
     * for a file that cannot be read and for the reasons of the constructor.
     */
    static SurfaceMesh read_stl(const std::string &file, const double scale);

    /**
     * Replaces @p touches by the places closer to @p center than @p reach [m],
     * the radius of a sphere or more. Their order depends on center and mesh
     * only. At most one a facet: if a facet that is not convex is touched in
     * several places, and no neighbour shares them, the nearest is taken. Places
     * within a thousandth of reach from each other count as one.
     */
    void touches(const dealii::Point<3> &center,
                 const double            reach,
                 std::vector<Touch>     &touches) const;

    /** Whether some triangle is closer to @p center than @p reach [m]. */
    bool near(const dealii::Point<3> &center, const double reach) const;

    unsigned int n_triangles() const;

    /** Corners of triangle number @p t [m]. */
    std::array<dealii::Point<3>, 3> triangle(const unsigned int t) const;

    unsigned int n_facets() const;

    /**
     * Edges that belong to one triangle only: the rim of an open sheet. None if
     * the surface is closed; many, where it should be, if its pieces do not fit.
     */
    unsigned int n_free_edges() const;

    /** Whether the surface has an inside: each edge belongs to two triangles. */
    bool is_closed() const;

    /**
     * Whether @p point lies inside of a closed surface, or on it, by how often a ray from
     * there meets triangles: how they are wound plays no role, and a hollow within the
     * body is outside. False if the surface is not closed.
     */
    bool contains(const dealii::Point<3> &point) const;

    /** The smallest box around all triangles [m]. */
    const dealii::BoundingBox<3> &bounding_box() const;

  private:
    /** Triangles, who neighbours whom, and the search tree; never changed. */
    struct Data;

    std::shared_ptr<const Data> data;
  };
} // namespace graupel

#endif
