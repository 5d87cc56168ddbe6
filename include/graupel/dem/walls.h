#ifndef graupel_dem_walls_h
#define graupel_dem_walls_h

#include <graupel/dem/lanes.h>
#include <graupel/dem/triple.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/base/point.h>

#include <cmath>
#include <cstdint>
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

  /** One wall of the vessel, exact rather than made of facets. */
  struct Wall
  {
    /** "wall", "bottom", "top", as in the output. */
    std::string                       name;
    std::variant<PlaneWall, TubeWall> shape;

    /** Slow; the contact loop dispatches once a wall. */
    WallGeometry<double>
    at(const Triple<double> &x) const
    {
      return std::visit([&](const auto &surface) { return surface.at(x); }, shape);
    }

    /** Whether the wall is closer to @p x than @p distance [m]. */
    bool
    is_near(const dealii::Point<3> &x, const double distance) const
    {
      return std::visit(
        [&](const auto &surface) { return surface.at(triple(x)).distance < distance; },
        shape);
    }

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

  /**
   * The partner id that stands for wall number @p wall in the table of springs;
   * negative, so that it never is a particle's.
   */
  constexpr std::int64_t
  wall_id(const unsigned int wall)
  {
    return -1 - static_cast<std::int64_t>(wall);
  }
} // namespace graupel

#endif
