#ifndef graupel_dem_walls_h
#define graupel_dem_walls_h

#include <graupel/mesh/cylinder.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

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
  struct WallGeometry
  {
    /** Distance of the point from the wall, negative beyond it [m]. */
    double distance;
    /** Unit normal from the vessel's inside to the wall. */
    dealii::Tensor<1, 3> normal;
  };

  /** A plane; the particles are on the side that its normal points away from. */
  struct PlaneWall
  {
    dealii::Point<3> point;
    /** Unit normal, out of the vessel. */
    dealii::Tensor<1, 3> normal;

    WallGeometry
    at(const dealii::Point<3> &x) const
    {
      return {(point - x) * normal, normal};
    }
  };

  /** The inside of an endless circular cylinder around the z axis. */
  struct TubeWall
  {
    /** Inner radius [m]. */
    double radius;

    WallGeometry
    at(const dealii::Point<3> &x) const
    {
      const double rho = std::sqrt(x[0] * x[0] + x[1] * x[1]);
      // On the axis every direction is as good; one must be taken.
      if (!(rho > 0.))
        return {radius, dealii::Tensor<1, 3>({1., 0., 0.})};
      return {radius - rho, dealii::Tensor<1, 3>({x[0] / rho, x[1] / rho, 0.})};
    }
  };

  /** One wall of the vessel, exact rather than made of facets. */
  struct Wall
  {
    /** "wall", "bottom", "top", as in the output. */
    std::string                       name;
    std::variant<PlaneWall, TubeWall> shape;

    /** Slow, for tests and checks; the contact loop dispatches once a wall. */
    WallGeometry
    at(const dealii::Point<3> &x) const
    {
      return std::visit([&](const auto &surface) { return surface.at(x); }, shape);
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
