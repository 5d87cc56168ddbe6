// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/vessel/vessel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Part of a unit normal below which a plane counts as level or upright.
    constexpr double direction_tolerance = 1e-9;
    // Slabs into which the height of a vessel is cut whose section changes.
    constexpr unsigned int n_slabs = 400;
    // Of the circle's area: no section.
    constexpr double no_area = 1e-12;
    // Of the vessel's height: beside a step of its section.
    constexpr double beside = 1e-9;
    // Sections of fluid and particles that differ by more are told [-].
    constexpr double equal_sections = 0.01;
    // Heights at which they are compared.
    constexpr unsigned int n_compared = 100;

    bool
    is_level(const HalfSpace &space)
    {
      return std::hypot(space.normal[0], space.normal[1]) < direction_tolerance;
    }

    bool
    is_upright(const HalfSpace &space)
    {
      return std::abs(space.normal[2]) < direction_tolerance;
    }

    std::vector<HalfSpace>
    that_cut(const Cylinder &tube, const std::vector<HalfSpace> &spaces)
    {
      std::vector<HalfSpace> result;
      for (const HalfSpace &space : spaces)
        {
          // The farthest point of the cylinder along the normal.
          const double across = std::hypot(space.normal[0], space.normal[1]);
          const double farthest =
            across * tube.diameter / 2. + std::max(0., space.normal[2] * tube.height);
          if (farthest > space.normal * space.point)
            result.push_back(space);
        }
      return result;
    }

    dealii::Point<3>
    point(const Triple<double> &x)
    {
      return dealii::Point<3>(x.x, x.y, x.z);
    }

    // The triangles where they are now.
    std::vector<std::array<dealii::Point<3>, 3>>
    placed_triangles(const SurfaceWall &wall)
    {
      std::vector<std::array<dealii::Point<3>, 3>> result;
      for (unsigned int t = 0; t < wall.mesh.n_triangles(); ++t)
        {
          result.push_back(wall.mesh.triangle(t));
          if (wall.has_moved)
            for (auto &corner : result.back())
              corner = point(wall.placement.place_of(triple(corner)));
        }
      return result;
    }

    // Numbers that change if the wall moves, comes or goes.
    std::vector<double>
    place_of(const Wall &wall)
    {
      if (const auto *plane = std::get_if<PlaneWall>(&wall.shape))
        return {plane->point.x,
                plane->point.y,
                plane->point.z,
                plane->normal.x,
                plane->normal.y,
                plane->normal.z};
      std::vector<double> numbers{static_cast<double>(wall.shape.index())};
      if (const auto *surface = std::get_if<SurfaceWall>(&wall.shape))
        for (const Triple<double> &built :
             {Triple<double>{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}})
          {
            const auto now =
              surface->has_moved ? surface->placement.place_of(built) : built;
            numbers.insert(numbers.end(), {now.x, now.y, now.z});
          }
      return numbers;
    }
  } // namespace

  Vessel::Vessel(const Cylinder &cylinder)
    : Vessel(cylinder, std::vector<HalfSpace>())
  {
  }

  Vessel::Vessel(const Cylinder                &cylinder,
                 const std::vector<HalfSpace>  &spaces,
                 const std::vector<ClosedBody> &bodies)
    : tube(cylinder)
    , spaces(that_cut(cylinder, spaces))
    , bodies(bodies)
  {
  }

  Vessel::Vessel(const Cylinder &cylinder, const std::vector<Wall> &walls)
    : tube(cylinder)
  {
    follow(walls);
  }

  Vessel::Vessel(const VesselMesh &mesh, const std::vector<Wall> &walls)
    : Vessel(mesh.cylinder(), walls)
  {
    outline = mesh.outline();
    for (const auto &boundary : mesh.boundaries())
      boundary_names.push_back(boundary.first);
  }

  void
  Vessel::follow(const std::vector<Wall> &walls)
  {
    std::vector<double> places;
    for (const Wall &wall : walls)
      for (const double number : place_of(wall))
        places.push_back(number);
    if (places == wall_places && walls.size() == wall_names.size())
      return;
    wall_places = places;
    take(walls);
  }

  void
  Vessel::take(const std::vector<Wall> &walls)
  {
    known_shape.reset();
    spaces.clear();
    bodies.clear();
    wall_names.clear();
    floors.clear();
    for (const Wall &wall : walls)
      {
        wall_names.push_back(wall.name);
        floors.push_back(false);
        if (const auto *plane = std::get_if<PlaneWall>(&wall.shape))
          {
            spaces.push_back({point(plane->point), tensor(plane->normal)});
            floors.back() = is_level(spaces.back()) && spaces.back().normal[2] < 0.;
          }
        else if (const auto *surface = std::get_if<SurfaceWall>(&wall.shape))
          if (surface->mesh.is_closed())
            bodies.push_back({placed_triangles(*surface), surface->is_container});
      }
    spaces = that_cut(tube, spaces);
  }

  bool
  Vessel::is_floor(const unsigned int wall) const
  {
    return wall < floors.size() && floors[wall];
  }

  bool
  Vessel::is_straight() const
  {
    return bodies.empty() &&
           std::all_of(spaces.begin(), spaces.end(), [](const HalfSpace &space) {
             return is_level(space) || is_upright(space);
           });
  }

  bool
  Vessel::is_tube() const
  {
    return bodies.empty() && std::all_of(spaces.begin(), spaces.end(), is_level);
  }

  double
  Vessel::area_at(const double z) const
  {
    if (!bodies.empty())
      return section_area(tube.diameter / 2., spaces, bodies, z);
    // Not by its formula: this is the area to the last bit.
    return is_tube() ? tube.cross_section()
                     : disc_section(tube.diameter / 2., spaces, z).area;
  }

  std::vector<double>
  Vessel::heights_of_steps(const double lower, const double upper) const
  {
    std::vector<double> heights{lower, upper};
    for (const ClosedBody &body : bodies)
      for (const auto &t : body.triangles)
        if (t[0][2] == t[1][2] && t[0][2] == t[2][2] && t[0][2] > lower &&
            t[0][2] < upper)
          heights.push_back(t[0][2]);
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    return heights;
  }

  double
  Vessel::end_of_space(const AreaProfile &profile, const bool lower) const
  {
    const auto       &borders = profile.borders();
    const std::size_t n       = borders.size() - 1;
    const auto        slab   = [&](const std::size_t k) { return lower ? k : n - 1 - k; };
    const double      way    = (lower ? 1. : -1.) * beside * tube.height;
    const auto        is_any = [&](const double z) {
      return area_at(z) > no_area * tube.cross_section();
    };
    std::size_t k = 0;
    while (k < n && profile.is_empty(slab(k)))
      ++k;
    if (k == n)
      return borders[lower ? n : 0]; // no space at all
    const std::size_t found  = slab(k);
    const double      border = borders[lower ? found : found + 1];
    if (is_any(border + way) && (k == 0 || !is_any(border - way)))
      return border;
    // Between the slab before and the middle of this one.
    double without = k == 0 ? border : borders[lower ? found - 1 : found + 2];
    double with    = 0.5 * (borders[found] + borders[found + 1]);
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9})
      if (const double z = border + part * 2. * (with - border); is_any(z))
        {
          with = z;
          break;
        }
    for (unsigned int n_halved = 0; n_halved < 60; ++n_halved)
      {
        const double middle               = 0.5 * (without + with);
        (is_any(middle) ? with : without) = middle;
      }
    return with;
  }

  Vessel::Shape
  Vessel::find_shape() const
  {
    Shape  found;
    double lower = 0., upper = tube.height;
    for (const HalfSpace &space : spaces)
      if (is_level(space) && space.normal[2] < 0.)
        lower = std::max(lower, space.point[2]);
      else if (is_level(space))
        upper = std::min(upper, space.point[2]);
    found.floor   = lower;
    found.ceiling = std::max(lower, upper);
    if (!(upper > lower))
      return found;
    if (is_straight())
      {
        found.area = area_at(0.5 * (lower + upper));
        return found;
      }
    found.profile = AreaProfile([&](const double z) { return area_at(z); },
                                heights_of_steps(lower, upper),
                                tube.height / n_slabs);
    found.floor   = end_of_space(found.profile, true);
    found.ceiling = std::max(found.floor, end_of_space(found.profile, false));
    return found;
  }

  const Vessel::Shape &
  Vessel::shape() const
  {
    if (!known_shape)
      known_shape = std::make_shared<const Shape>(find_shape());
    return *known_shape;
  }

  double
  Vessel::floor() const
  {
    return shape().floor;
  }

  double
  Vessel::ceiling() const
  {
    return shape().ceiling;
  }

  double
  Vessel::cross_section(const double z) const
  {
    if (z < floor() || z > ceiling())
      return 0.;
    if (is_straight())
      return shape().area;
    return bodies.empty() ? area_at(z) : shape().profile.area(z);
  }

  double
  Vessel::volume(const double lower, const double upper) const
  {
    const double from = std::max(lower, floor()), to = std::min(upper, ceiling());
    if (!(to > from))
      return 0.;
    return is_straight() ? shape().area * (to - from) : shape().profile.volume(from, to);
  }

  double
  Vessel::depth_of(const double solid, const double part) const
  {
    if (is_straight())
      return solid / (part * shape().area);
    const double wanted = solid / part, all = volume(floor(), ceiling());
    if (wanted <= all)
      return shape().profile.level(wanted) - floor();
    // As if it went on above.
    return ceiling() - floor() + (wanted - all) / tube.cross_section();
  }

  std::optional<double>
  Vessel::hydraulic_diameter() const
  {
    if (is_tube())
      return tube.diameter;
    if (!is_straight() || !(shape().area > 0.))
      return {};
    const auto size =
      disc_section(tube.diameter / 2., spaces, 0.5 * (floor() + ceiling()));
    return 4. * size.area / size.perimeter;
  }

  double
  Vessel::fluid_cross_section(const double z) const
  {
    if (outline)
      return outline->cross_section(z);
    return z < 0. || z > tube.height ? 0. : tube.cross_section();
  }

  std::string
  Vessel::difference() const
  {
    if (!outline)
      return "";
    double       worst = equal_sections, where = 0.;
    unsigned int n_different = 0;
    for (unsigned int k = 0; k < n_compared; ++k)
      {
        const double z     = (k + 0.5) / n_compared * tube.height;
        const double fluid = fluid_cross_section(z), particles = cross_section(z);
        if (!(particles > 0.))
          continue; // below a floor, above a lid
        const double difference = std::abs(particles / fluid - 1.);
        n_different += difference > equal_sections;
        if (difference > worst * (1. + 1e-6))
          {
            worst = difference;
            where = z;
          }
      }
    if (n_different == 0)
      return "";
    const double fluid = fluid_cross_section(where), particles = cross_section(where);
    std::ostringstream text;
    text.precision(4);
    text
      << "the section of the mesh is " << fluid * 1e6 << " mm2, but particles may be in "
      << particles * 1e6 << " mm2 (at z = " << where * 1e3 << " mm; "
      << 100. * n_different / n_compared << " % of the height differ): "
      << (particles > fluid
            ? "particles leave the fluid; add planes or a container (section Walls), or "
              "set Walls/from mesh = true"
            : "fluid flows where no particle can be; take walls away, or mesh the "
              "vessel as the particles have it, unless this is meant");
    return text.str();
  }
} // namespace graupel
