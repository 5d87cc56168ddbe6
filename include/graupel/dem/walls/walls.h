// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_walls_walls_h
#define graupel_dem_walls_walls_h

#include <graupel/dem/numbers/lanes.h>
#include <graupel/dem/numbers/triple.h>
#include <graupel/dem/walls/surface_mesh.h>
#include <graupel/dem/walls/wall_course.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace graupel
{
  /**
   * Where a point lies relative to a wall. The overlap of a sphere is its
   * radius minus the distance of its center.
   */
  template <class Real>
  struct WallGeometry
  {
    /** Distance of the point from the wall, negative beyond it [m]. */
    Real distance;
    /** Unit normal from the vessel's inside to the wall. */
    Triple<Real> normal;
  };

  /** A plane; the particles are on the side that its normal points away from. */
  struct PlaneWall
  {
    Triple<double> point;
    /** Unit normal, out of the vessel. */
    Triple<double> normal;

    template <class Real>
    WallGeometry<Real>
    at(const Triple<Real> &x) const
    {
      const Triple<Real> n{normal.x, normal.y, normal.z};
      return {(point.x - x.x) * n.x + (point.y - x.y) * n.y + (point.z - x.z) * n.z, n};
    }
  };

  /** The inside of an endless circular cylinder around the z axis. */
  struct TubeWall
  {
    /** Inner radius [m]. */
    double radius;

    template <class Real>
    WallGeometry<Real>
    at(const Triple<Real> &x) const
    {
      using std::sqrt;
      const Real rho = sqrt(x.x * x.x + x.y * x.y);
      // On the axis every direction is as good; one must be taken.
      const auto off_axis = rho > Real(0.);
      return {radius - rho,
              {select(off_axis, x.x / rho, Real(1.)),
               select(off_axis, x.y / rho, Real(0.)),
               Real(0.)}};
    }
  };

  /**
   * An end of the vessel through which particles leave, or come in again; a wall that
   * is not there yet, or no more.
   */
  struct NoWall
  {
    template <class Real>
    WallGeometry<Real>
    at(const Triple<Real> &) const
    {
      return {std::numeric_limits<double>::infinity(), {Real(0.), Real(0.), Real(1.)}};
    }
  };

  /** A wall made of triangles, in which a sphere can touch several facets. */
  struct SurfaceWall
  {
    /** As it was built: the mesh stays, the particles are seen from it. */
    SurfaceMesh mesh;
    /** Where it is now. */
    Placement placement = {};
    bool      has_moved = false;
    /** Whether the particles are inside of it; it is closed then. */
    bool is_container = false;

    /** See SurfaceMesh::touches(); places and normals are those of the vessel. */
    void touches(const dealii::Point<3>          &center,
                 const double                     reach,
                 std::vector<SurfaceMesh::Touch> &touches) const;

    /** @p place as the mesh sees it. */
    dealii::Point<3> seen_from_mesh(const dealii::Point<3> &place) const;
  };

  using WallShape = std::variant<PlaneWall, TubeWall, NoWall, SurfaceWall>;

  /** One wall of the vessel; the analytic ones are exact. */
  struct Wall
  {
    /** "wall", "bottom", "top", as in the output. */
    std::string name;
    /** Where it is now; NoWall while it is not there. */
    WallShape shape;
    /** What it does over time. */
    WallCourse course = {};
    WallPose   pose   = {};
    /** Its motion through the last substep. */
    WallStep step = {};
    /** Its shape as built, once it has moved or gone. */
    std::optional<WallShape> built    = {};
    bool                     is_there = true;

    /**
     * Where a sphere touches: for a surface at this @p facet, as far as it is
     * closer than @p reach [m]. Slow; the contact loop dispatches once a wall.
     */
    WallGeometry<double> at(const Triple<double> &x,
                            const unsigned int    facet = 0,
                            const double          reach = 0.) const;

    /** Whether the wall is closer to @p x than @p distance [m]. */
    bool is_near(const dealii::Point<3> &x, const double distance) const;

    /**
     * Whether a particle may be at @p x as far as this wall goes: farther away than
     * @p distance [m], not beyond a plane, not inside a closed surface, but inside of
     * one that is a container.
     */
    bool is_admissible(const dealii::Point<3> &x, const double distance) const;

    /** Velocity of the middle of its axis [m/s]. */
    const Triple<double> &
    velocity() const
    {
      return step.end.velocity;
    }

    /** Moves the wall through @p dt [s], from @p clock on. */
    void move(const double dt, const Clock &clock = {});

    /** Puts it where @p where says, as @p clock says. */
    void place(const WallPose &where, const Clock &clock);

    /** Comes or goes by @p clock; whether it has. */
    bool look_at(const Clock &clock);

    /**
     * A bound on how fast its surface came nearer to any particle in the last substep
     * [m/s]; @p vessel_size: of the vessel and all particles from the origin [m].
     */
    double approach_speed(const double vessel_size) const;

    /** Equal for walls of the same shape, as built: their facets have the same numbers.
     */
    std::uint64_t fingerprint() const;
  };

  /**
   * The first of the walls from number @p first on that does not admit a particle at
   * @p x (see Wall::is_admissible()); none: null.
   */
  const Wall *first_refusing_wall(const std::vector<Wall> &walls,
                                  const dealii::Point<3>  &x,
                                  const double             distance,
                                  const unsigned int       first = 0);

  /** Places of the vessel's walls in the list of vessel_walls(). */
  enum VesselWall : unsigned int
  {
    lateral_wall = 0,
    bottom_wall  = 1,
    top_wall     = 2
  };

  /** The lateral wall, the bottom z = 0 and the top z = height of a cylinder. */
  std::vector<Wall> vessel_walls(const Cylinder &cylinder);

  /** The walls as the prm file tells them. */
  struct WallParameters
  {
    /** "closed", "open" (particles leave) or "periodic". */
    std::string bottom = "closed";
    std::string top    = "closed";
    /** Planes: name, point [m], normal out of the vessel, optional velocity [m/s]. */
    std::string planes;
    /** STL files with their names, and the length of their unit [m]. */
    std::string surfaces;
    double      surface_unit = 1e-3;
    /** Whether the flat boundaries of the mesh's file are planes too. */
    bool from_mesh = false;
    /** Names of the surfaces in which the particles are. */
    std::string containers;
    /** "NAME = velocity A; B; C | NAME = rotation X Y Z; AX AY AZ; OMEGA". */
    std::string motion;
    /** "NAME until T, NAME from T, NAME until settled". */
    std::string gates;

    /** Declares the section "Walls". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;

    bool
    is_periodic() const
    {
      return bottom == "periodic";
    }

    bool
    is_open() const
    {
      return bottom == "open" || top == "open";
    }

    /**
     * Names of the walls of walls(), in their order; no file is read. Throws InputError
     * for names that cannot be.
     */
    std::vector<std::string> names() const;

    /**
     * The walls of the vessel in the order of VesselWall, then the planes, then
     * the surfaces. Throws InputError for what cannot be read.
     */
    std::vector<Wall> walls(const Cylinder &cylinder) const;

  private:
    void declare_courses(dealii::ParameterHandler &prm);
    void set_course(const std::string &entry, std::vector<Wall> &walls) const;
    void set_gate(const std::string &entry, std::vector<Wall> &walls) const;
    // The walls without the surfaces' triangles, which stand as NoWall.
    std::vector<Wall> outline(const Cylinder &cylinder) const;
  };

  /** Walls that a vessel can have, beyond any use. */
  constexpr std::int64_t most_walls = 1024;

  /**
   * The partner id that stands for wall number @p wall in a contact, or for a facet
   * of it; negative, so that it never is a particle's.
   */
  constexpr std::int64_t
  wall_id(const unsigned int wall, const unsigned int facet = 0)
  {
    return -1 - (static_cast<std::int64_t>(wall) + most_walls * facet);
  }

  /** The wall that a negative partner id names. */
  constexpr unsigned int
  wall_of(const std::int64_t partner)
  {
    return (-1 - partner) % most_walls;
  }

  /** The facet that a negative partner id names. */
  constexpr unsigned int
  facet_of(const std::int64_t partner)
  {
    return (-1 - partner) / most_walls;
  }
} // namespace graupel

#endif
