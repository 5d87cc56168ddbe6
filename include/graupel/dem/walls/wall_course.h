// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_walls_wall_course_h
#define graupel_dem_walls_wall_course_h

#include <graupel/dem/walls/rigid_motion.h>

#include <deal.II/base/function.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace graupel
{
  /** The time of the flow [s]; nothing before it has begun. */
  using Clock = std::optional<double>;

  /** Where a wall is, seen from where it was built. */
  struct WallPose
  {
    /** [m] */
    Triple<double> shift = {};
    /** About the axis of its course [rad]. */
    double angle = 0.;

    bool
    is_as_built() const
    {
      return shift.norm_square() == 0. && angle == 0.;
    }
  };

  /**
   * What a wall does over time: how it moves, and when it is there. Before the clock
   * runs, it stands still, but for a constant velocity.
   */
  class WallCourse
  {
  public:
    /** Moves it at @p velocity [m/s] from the start, clock or not. */
    void set_constant_velocity(const Triple<double> &velocity);

    /**
     * Moves it by three expressions of t [s] and pi [m/s]. Throws InputError for what
     * cannot be read.
     */
    void set_velocity(const std::vector<std::string> &expressions);

    /**
     * Turns it about the axis through @p center [m] along the unit vector @p axis, at
     * an angular speed by an expression of t [s] and pi [rad/s]. The axis moves with
     * the wall. Throws InputError as above.
     */
    void set_rotation(const Triple<double> &center,
                      const Triple<double> &axis,
                      const std::string    &expression);

    /** Whether it ever moves. */
    bool
    moves() const
    {
      return constant.norm_square() > 0. || velocity || angular_speed;
    }

    bool
    has_velocity() const
    {
      return constant.norm_square() > 0. || velocity;
    }

    bool
    has_rotation() const
    {
      return static_cast<bool>(angular_speed);
    }

    /**
     * How it moves through @p dt [s] from @p clock on and from @p pose, which is moved
     * along. A number of an expression that is not finite stays so.
     */
    WallStep step(const double dt, const Clock &clock, WallPose &pose) const;

    /** How it moves at this time and place. */
    RigidVelocity velocity_at(const Clock &clock, const WallPose &pose) const;

    Placement placement(const WallPose &pose) const;

    /** Unit vector along its axis; that of the vessel if it does not turn. */
    const Triple<double> &
    axis() const
    {
      return direction;
    }

    /** A point on its axis, as built [m]. */
    const Triple<double> &
    center() const
    {
      return point;
    }

    /**
     * When it comes and when it goes, by the clock [s]; if it goes first, it is there
     * before.
     */
    double from  = -std::numeric_limits<double>::infinity();
    double until = std::numeric_limits<double>::infinity();

    bool
    is_there(const Clock &clock) const
    {
      const double t = clock.value_or(-std::numeric_limits<double>::infinity());
      return from < until ? t >= from && t < until : t < until || t >= from;
    }

  private:
    using Expressions = std::shared_ptr<const dealii::Function<1>>;

    Triple<double> constant, point, direction = {0., 0., 1.};
    Expressions    velocity, angular_speed;
  };
} // namespace graupel

#endif
