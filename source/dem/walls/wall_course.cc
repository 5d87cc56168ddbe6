// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/walls/wall_course.h>

#include <deal.II/base/function_parser.h>

namespace graupel
{
  namespace
  {
    std::shared_ptr<const dealii::Function<1>>
    read_expressions(const std::vector<std::string> &expressions)
    {
      auto function = std::make_shared<dealii::FunctionParser<1>>(expressions.size());
      try
        {
          function->initialize("t", expressions, {{"pi", dealii::numbers::PI}}, false);
          for (unsigned int c = 0; c < expressions.size(); ++c)
            function->value(dealii::Point<1>(0.), c);
        }
      catch (const std::exception &)
        {
          throw InputError("Walls/motion",
                           "an expression cannot be read; it may hold t, the time of "
                           "the flow [s], and pi");
        }
      return function;
    }
  } // namespace

  void
  WallCourse::set_constant_velocity(const Triple<double> &value)
  {
    constant = value;
  }

  void
  WallCourse::set_velocity(const std::vector<std::string> &expressions)
  {
    velocity = read_expressions(expressions);
  }

  void
  WallCourse::set_rotation(const Triple<double> &center,
                           const Triple<double> &axis,
                           const std::string    &expression)
  {
    point         = center;
    direction     = axis;
    angular_speed = read_expressions({expression});
  }

  RigidVelocity
  WallCourse::velocity_at(const Clock &clock, const WallPose &pose) const
  {
    RigidVelocity result{constant, {}, point + pose.shift};
    if (!clock)
      return result;
    const dealii::Point<1> t(*clock);
    if (velocity)
      result.velocity +=
        {velocity->value(t, 0), velocity->value(t, 1), velocity->value(t, 2)};
    if (angular_speed)
      result.spin = angular_speed->value(t) * direction;
    return result;
  }

  WallStep
  WallCourse::step(const double dt, const Clock &clock, WallPose &pose) const
  {
    const auto later = [&](const double by) {
      return clock ? Clock(*clock + by) : clock;
    };
    WallStep result;
    result.middle       = velocity_at(later(0.5 * dt), pose);
    const auto   way    = dt * result.middle.velocity;
    const double turned = dt * (result.middle.spin * direction);
    result.middle.center += 0.5 * way;
    pose.shift += way;
    pose.angle += turned;
    result.end   = velocity_at(later(dt), pose);
    result.turn  = Rotation::by(turned, direction);
    result.turns = angular_speed && clock;
    return result;
  }

  Placement
  WallCourse::placement(const WallPose &pose) const
  {
    const Rotation turn = Rotation::by(pose.angle, direction);
    return {turn, (point - turn(point)) + pose.shift};
  }
} // namespace graupel
