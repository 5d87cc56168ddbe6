// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_mesh_outline_h
#define graupel_mesh_mesh_outline_h

#include <graupel/mesh/area_profile.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <string>
#include <vector>

namespace graupel
{
  /** A plane that carries faces of a mesh's boundary. */
  struct FlatBoundary
  {
    /** Of most of its faces. */
    std::string name;
    /** In the middle of the faces [m]. */
    dealii::Point<3> point;
    /** Unit normal, out of the mesh. */
    dealii::Tensor<1, 3> normal;
    /** Of its faces [m^2]. */
    double area;
  };

  /**
   * What the boundary of a coarse mesh encloses: the fluid's cross-section over the
   * height, and the planes it lies in. The faces of the manifold @p curved are parts of
   * the cylinder and count as such, exactly; faces with four corners off a plane count by
   * 64 pairs of triangles. The same on every rank.
   */
  class MeshOutline
  {
  public:
    /** @p names of all boundary ids of @p coarse. */
    MeshOutline(const Cylinder                                          &cylinder,
                const dealii::Triangulation<3>                          &coarse,
                const dealii::types::manifold_id                         curved,
                const std::map<std::string, dealii::types::boundary_id> &names);

    /** Area of the fluid's section at @p z [m^2]. */
    double
    cross_section(const double z) const
    {
      return profile.area(z);
    }

    /** Of the fluid between two heights [m^3]. */
    double
    volume(const double lower, const double upper) const
    {
      return profile.volume(lower, upper);
    }

    /** The planes of the boundary, those at z = 0 and at the top left out, the largest
     * first. */
    const std::vector<FlatBoundary> &
    planes() const
    {
      return flat;
    }

    /** Name of a boundary that is neither flat nor part of the cylinder; empty: none. */
    const std::string &
    curved_boundary() const
    {
      return curved_name;
    }

    /** How far a vertex of the mesh lies out of a plane of its boundary, at most: 0 for
     * a convex vessel, up to rounding [m]. */
    double
    farthest_beyond_planes() const
    {
      return farthest;
    }

  private:
    AreaProfile               profile;
    std::vector<FlatBoundary> flat;
    std::string               curved_name;
    double                    farthest = 0.;
  };
} // namespace graupel

#endif
