// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_walls_rigid_motion_h
#define graupel_dem_walls_rigid_motion_h

#include <graupel/dem/numbers/lanes.h>
#include <graupel/dem/numbers/triple.h>

#include <cmath>

namespace graupel
{
  /** A vector of numbers as one of this kind of number, the same in each lane. */
  template <class Real>
  Triple<Real>
  lift(const Triple<double> &v)
  {
    return {Real(v.x), Real(v.y), Real(v.z)};
  }

  /**
   * A turn of vectors about an axis. No turn leaves a vector as it is, bit by bit.
   * Source: Rodrigues' formula.
   */
  struct Rotation
  {
    /** Unit vector along the axis. */
    Triple<double> axis   = {0., 0., 1.};
    double         cosine = 1., sine = 0.;

    /** By @p angle [rad] about the unit vector @p axis, counterclockwise around it. */
    static Rotation
    by(const double angle, const Triple<double> &axis)
    {
      return {axis, std::cos(angle), std::sin(angle)};
    }

    Rotation
    inverse() const
    {
      return {axis, cosine, -sine};
    }

    template <class Real>
    Triple<Real>
    operator()(const Triple<Real> &v) const
    {
      const Triple<Real> a     = lift<Real>(axis);
      const Real         along = (1. - cosine) * (a * v);
      return Real(cosine) * v + Real(sine) * cross(a, v) + along * a;
    }
  };

  /** Where a rigid body is: a point x of it as it was built is at offset + turn(x). */
  struct Placement
  {
    Rotation       turn;
    Triple<double> offset = {};

    Triple<double>
    place_of(const Triple<double> &built) const
    {
      return offset + turn(built);
    }

    /** The point of the body, as built, that is at @p place now. */
    Triple<double>
    built_from(const Triple<double> &place) const
    {
      return turn.inverse()(place - offset);
    }
  };

  /** Velocities of the points of a rigid body. */
  struct RigidVelocity
  {
    /** Of the center [m/s]. */
    Triple<double> velocity = {};
    /** Angular velocity [rad/s]. */
    Triple<double> spin = {};
    /** A point on the axis [m]. */
    Triple<double> center = {};

    Triple<double>
    at(const Triple<double> &place) const
    {
      return velocity + cross(spin, place - center);
    }
  };

  /** How a wall moves through a substep. */
  struct WallStep
  {
    /** In the middle of the substep, which moves springs, and at its end. */
    RigidVelocity middle, end;
    /** What the wall turns by. */
    Rotation turn;
    bool     turns = false;
  };
} // namespace graupel

#endif
