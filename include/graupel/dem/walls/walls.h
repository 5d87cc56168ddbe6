#ifndef graupel_dem_walls_walls_h
#define graupel_dem_walls_walls_h

#include <graupel/dem/numbers/lanes.h>
#include <graupel/dem/numbers/triple.h>
#include <graupel/dem/walls/surface_mesh.h>
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
    /** Velocity with which it moves [m/s]. */
    Triple<double> velocity = {};

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
    double         radius;
    Triple<double> velocity = {};

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

  /** An end of the vessel through which particles leave, or come in again. */
  struct NoWall
  {
    Triple<double> velocity = {};

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
    SurfaceMesh    mesh;
    Triple<double> velocity = {};
  };

  /** One wall of the vessel; the analytic ones are exact. */
  struct Wall
  {
    /** "wall", "bottom", "top", as in the output. */
    std::string                                            name;
    std::variant<PlaneWall, TubeWall, NoWall, SurfaceWall> shape;

    /**
     * Where a sphere touches: for a surface at this @p facet, as far as it is
     * closer than @p reach [m]. Slow; the contact loop dispatches once a wall.
     */
    WallGeometry<double> at(const Triple<double> &x,
                            const unsigned int    facet = 0,
                            const double          reach = 0.) const;

    /** Whether the wall is closer to @p x than @p distance [m]. */
    bool is_near(const dealii::Point<3> &x, const double distance) const;

    const Triple<double> &
    velocity() const
    {
      return std::visit(
        [](const auto &surface) -> const Triple<double> & { return surface.velocity; },
        shape);
    }

    /** Moves the wall through @p dt [s]. */
    void
    move(const double dt)
    {
      if (auto *plane = std::get_if<PlaneWall>(&shape))
        plane->point += dt * plane->velocity;
    }
  };

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
    /** Planes: point [m], normal out of the vessel, optional velocity [m/s]. */
    std::string planes;
    /** STL files, and the length of their unit [m]. */
    std::string surfaces;
    double      surface_unit = 1e-3;

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
     * The walls of the vessel in the order of VesselWall, then the planes, then
     * the surfaces. Throws InputError for what cannot be read.
     */
    std::vector<Wall> walls(const Cylinder &cylinder) const;
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
