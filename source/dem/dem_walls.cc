// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/dem.h>
#include <graupel/dem/particles/dem_error.h>

#include <sstream>

// What walls do over time, and where they let particles be.

namespace graupel
{
  namespace
  {
    std::array<double, 6>
    axis_of(const Wall &wall)
    {
      const auto &point = wall.course.center(), &axis = wall.course.axis();
      return {{point.x, point.y, point.z, axis.x, axis.y, axis.z}};
    }
  } // namespace

  void
  Dem::start_clock(const double t)
  {
    time = t;
    throw_together(open_and_close_gates(), communicator());
  }

  void
  Dem::move_walls(const double dt)
  {
    if (const auto problem = open_and_close_gates(); !problem.empty())
      stop(problem);
    const Cylinder &cylinder = mesh.cylinder();
    const double    size =
      std::hypot(0.5 * cylinder.diameter, cylinder.height) + 2. * input.largest_radius();
    double speed = 0.;
    for (Wall &wall : walls)
      if (wall.course.moves())
        {
          wall.move(dt, time);
          const double own = wall.approach_speed(size);
          if (!std::isfinite(own + wall.step.end.at({}).norm_square()))
            return stop("the wall \"" + wall.name + "\" has no finite velocity at t = " +
                        std::to_string(clock()) + " s (Walls/motion)");
          speed = std::max(speed, own);
        }
    walls_moved_since_list += dt * speed;
    moved_since_list += dt * speed;
  }

  std::string
  Dem::open_and_close_gates()
  {
    std::string problem;
    bool        some_wall_changes = false;
    for (unsigned int w = 0; w < walls.size(); ++w)
      if (walls[w].look_at(time))
        {
          // Whoever is near it must be found anew.
          contacts.leave_wall(w);
          list.clear();
          list_is_valid     = false;
          some_wall_changes = true;
          if (walls[w].is_there)
            problem += in_the_way_of(walls[w]);
        }
    if (some_wall_changes)
      shape.follow(walls);
    return problem;
  }

  std::string
  Dem::in_the_way_of(const Wall &wall) const
  {
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      {
        const Body &body = arrays.body[i];
        if (!wall.is_admissible(body.position,
                                (1. - ContactSweep::largest_overlap) * body.radius))
          {
            std::ostringstream text;
            text << "particle " << arrays.id[i] << " at (" << body.position
                 << ") m is in the way of the wall \"" << wall.name
                 << "\", which comes at t = " << clock() << " s (Walls/gates). ";
            return text.str();
          }
      }
    return {};
  }

  std::string
  Dem::problem_of_places(const std::vector<NewParticle> &added) const
  {
    for (std::size_t k = 0; k < added.size(); ++k)
      if (const Wall *wall =
            first_refusing_wall(walls, added[k].position, 0., top_wall + 1))
        {
          const auto        *surface = std::get_if<SurfaceWall>(&wall->shape);
          std::ostringstream text;
          text << "particle " << (added[k].id < 0 ? k : added[k].id) << " at ("
               << added[k].position << ") m would be "
               << (surface == nullptr      ? "beyond"
                   : surface->is_container ? "outside of"
                                           : "inside of")
               << " the wall \"" << wall->name << '"';
          return text.str();
        }
    return {};
  }

  std::vector<DemState::Wall>
  Dem::state_of_walls() const
  {
    std::vector<DemState::Wall> result;
    for (const Wall &wall : walls)
      {
        const auto &shift = wall.pose.shift;
        result.push_back({wall.name,
                          wall.fingerprint(),
                          {{shift.x, shift.y, shift.z}},
                          wall.pose.angle,
                          axis_of(wall)});
      }
    return result;
  }

  std::vector<std::int64_t>
  Dem::restore_walls(const DemState::Common &state)
  {
    time = state.clock_runs ? Clock(state.clock) : Clock();
    std::vector<std::int64_t> number_here(state.walls.size(), -1);
    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        Wall      &wall = walls[w];
        const auto of_old =
          std::find_if(state.walls.begin(), state.walls.end(), [&](const auto &old) {
            return old.name == wall.name && old.shape == wall.fingerprint();
          });
        WallPose pose;
        if (of_old != state.walls.end())
          {
            pose = {{of_old->shift[0], of_old->shift[1], of_old->shift[2]},
                    of_old->angle};
            if (pose.angle != 0. && of_old->axis != axis_of(wall))
              throw DemError("the wall \"" + wall.name +
                             "\" has turned about another axis than it has here; give it "
                             "the same one in Walls/motion, if only with speed 0");
          }
        wall.place(pose, time);
        wall.look_at(time);
        if (of_old != state.walls.end() && wall.is_there)
          number_here[of_old - state.walls.begin()] = w;
      }
    return number_here;
  }

  unsigned int
  Dem::wall_number(const std::string &name) const
  {
    const auto wall = std::find_if(
      walls.begin(), walls.end(), [&](const Wall &w) { return w.name == name; });
    require(wall != walls.end(), "", "the vessel has no wall \"" + name + "\"");
    return wall - walls.begin();
  }

  double
  Dem::supported_weight() const
  {
    double sum = 0.;
    for (unsigned int w = 0; w < walls.size(); ++w)
      sum += along_gravity(w);
    return sum;
  }
} // namespace graupel
