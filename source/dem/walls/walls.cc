// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/walls/walls.h>

namespace graupel
{
  namespace
  {
    // FNV-1a over the bytes of numbers: http://www.isthe.com/chongo/tech/comp/fnv.
    struct Fingerprint
    {
      std::uint64_t value = 0xcbf29ce484222325u;

      Fingerprint &
      add(const std::uint64_t word)
      {
        for (unsigned int byte = 0; byte < 8; ++byte)
          value = (value ^ ((word >> (8 * byte)) & 0xff)) * 0x100000001b3u;
        return *this;
      }

      Fingerprint &
      add(const double number)
      {
        std::uint64_t word;
        static_assert(sizeof(word) == sizeof(number));
        std::memcpy(&word, &number, sizeof(word));
        return add(word);
      }

      Fingerprint &
      add(const Triple<double> &v)
      {
        return add(v.x).add(v.y).add(v.z);
      }
    };

    // Puts a shape where it belongs.
    void
    put(const Placement &placement, const WallShape &built, WallShape &shape)
    {
      if (auto *surface = std::get_if<SurfaceWall>(&shape))
        {
          surface->placement = placement;
          surface->has_moved = true;
        }
      else if (auto *plane = std::get_if<PlaneWall>(&shape))
        {
          const auto &as_built = std::get<PlaneWall>(built);
          plane->point         = placement.place_of(as_built.point);
          plane->normal        = placement.turn(as_built.normal);
        }
    }

    // Largest distance of the corners of a box from an axis [m].
    double
    largest_arm(const dealii::BoundingBox<3> &box,
                const Triple<double>         &center,
                const Triple<double>         &axis)
    {
      double largest = 0.;
      for (unsigned int corner = 0; corner < 8; ++corner)
        largest =
          std::max(largest, cross(triple(box.vertex(corner)) - center, axis).norm());
      return largest;
    }
  } // namespace

  dealii::Point<3>
  SurfaceWall::seen_from_mesh(const dealii::Point<3> &place) const
  {
    return has_moved ? dealii::Point<3>(tensor(placement.built_from(triple(place))))
                     : place;
  }

  void
  SurfaceWall::touches(const dealii::Point<3>          &center,
                       const double                     reach,
                       std::vector<SurfaceMesh::Touch> &touches) const
  {
    mesh.touches(seen_from_mesh(center), reach, touches);
    if (has_moved)
      for (auto &touch : touches)
        {
          touch.point = dealii::Point<3>(tensor(placement.place_of(triple(touch.point))));
          touch.normal = tensor(placement.turn(triple(touch.normal)));
        }
  }

  WallGeometry<double>
  Wall::at(const Triple<double> &x, const unsigned int facet, const double reach) const
  {
    return std::visit(
      [&](const auto &surface) -> WallGeometry<double> {
        if constexpr (std::is_same_v<std::decay_t<decltype(surface)>, SurfaceWall>)
          {
            std::vector<SurfaceMesh::Touch> touches;
            surface.touches(dealii::Point<3>(tensor(x)), reach, touches);
            for (const auto &touch : touches)
              if (touch.facet == facet)
                return {touch.distance, triple(touch.normal)};
            return NoWall().at(x);
          }
        else
          return surface.at(x);
      },
      shape);
  }

  bool
  Wall::is_near(const dealii::Point<3> &x, const double distance) const
  {
    if (const auto *surface = std::get_if<SurfaceWall>(&shape))
      return surface->mesh.near(surface->seen_from_mesh(x), distance);
    return at(triple(x)).distance < distance;
  }

  bool
  Wall::is_admissible(const dealii::Point<3> &x, const double distance) const
  {
    if (is_near(x, distance))
      return false;
    const auto *surface = std::get_if<SurfaceWall>(&shape);
    return surface == nullptr ||
           surface->mesh.contains(surface->seen_from_mesh(x)) == surface->is_container;
  }

  void
  Wall::move(const double dt, const Clock &clock)
  {
    if (!course.moves())
      return;
    if (!built)
      built = shape;
    step = course.step(dt, clock, pose);
    put(course.placement(pose), *built, shape);
  }

  void
  Wall::place(const WallPose &where, const Clock &clock)
  {
    if (!built && where.is_as_built() && !course.moves())
      return;
    if (!built)
      built = shape;
    pose     = where;
    step     = {};
    step.end = step.middle = course.velocity_at(clock, pose);
    put(course.placement(pose), *built, shape);
  }

  bool
  Wall::look_at(const Clock &clock)
  {
    const bool comes = course.is_there(clock);
    if (comes == is_there)
      return false;
    if (!built)
      built = shape;
    is_there = comes;
    shape    = comes ? *built : WallShape(NoWall{});
    if (comes && !pose.is_as_built())
      put(course.placement(pose), *built, shape);
    return true;
  }

  double
  Wall::approach_speed(const double vessel_size) const
  {
    const auto  &motion = step.middle;
    const double spin   = motion.spin.norm();
    const double within = vessel_size + motion.center.norm();
    if (const auto *plane = std::get_if<PlaneWall>(&shape))
      // In its own plane it may move as it likes.
      return std::abs(plane->normal * motion.velocity) +
             spin * cross(plane->normal, course.axis()).norm() * within;
    if (const auto *surface = std::get_if<SurfaceWall>(&shape))
      return motion.velocity.norm() +
             spin * std::min(within,
                             largest_arm(surface->mesh.bounding_box(),
                                         course.center(),
                                         course.axis()));
    return 0.;
  }

  std::uint64_t
  Wall::fingerprint() const
  {
    const WallShape &original = built ? *built : shape;
    Fingerprint      result;
    result.add(static_cast<std::uint64_t>(original.index()));
    if (const auto *plane = std::get_if<PlaneWall>(&original))
      result.add(plane->point).add(plane->normal);
    if (const auto *tube = std::get_if<TubeWall>(&original))
      result.add(tube->radius);
    if (const auto *surface = std::get_if<SurfaceWall>(&original))
      for (unsigned int t = 0; t < surface->mesh.n_triangles(); ++t)
        for (const auto &corner : surface->mesh.triangle(t))
          result.add(triple(corner));
    return result.value;
  }

  const Wall *
  first_refusing_wall(const std::vector<Wall> &walls,
                      const dealii::Point<3>  &x,
                      const double             distance,
                      const unsigned int       first)
  {
    for (std::size_t w = first; w < walls.size(); ++w)
      if (!walls[w].is_admissible(x, distance))
        return &walls[w];
    return nullptr;
  }

  std::vector<Wall>
  vessel_walls(const Cylinder &cylinder)
  {
    const Triple<double> bottom, top{0., 0., cylinder.height};
    const Triple<double> up{0., 0., 1.};

    std::vector<Wall> walls(3);
    walls[lateral_wall] = {"wall", TubeWall{cylinder.diameter / 2.}};
    walls[bottom_wall]  = {"bottom", PlaneWall{bottom, -up}};
    walls[top_wall]     = {"top", PlaneWall{top, up}};
    return walls;
  }
} // namespace graupel
