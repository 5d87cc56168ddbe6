// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_contacts_contact_geometry_h
#define graupel_dem_contacts_contact_geometry_h

#include <graupel/dem/laws/contact_laws.h>
#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/walls/walls.h>

namespace graupel
{
  /** The part of a substep for which a contact that began in it has lasted [s]. */
  template <class Real>
  [[gnu::always_inline]] inline Real
  step_in_contact(const Contact<Real> &contact, const double dt)
  {
    const Real approached = contact.drift * contact.normal * dt;
    return select(
      approached > contact.overlap, dt * contact.overlap / approached, Real(dt));
  }

  /** Contact of two particles of masses @p m_i and @p m_j [kg]; step and drift are 0. */
  inline Contact<double>
  contact_of_pair(const Body &i, const Body &j, const double m_i, const double m_j)
  {
    Contact<double> contact;
    const auto      between  = triple(j.position) - triple(i.position);
    const double    distance = between.norm();
    contact.overlap          = i.radius + j.radius - distance;
    contact.normal           = (1. / distance) * between;
    contact.radius           = i.radius * j.radius / (i.radius + j.radius);
    contact.mass             = m_i * m_j / (m_i + m_j);
    const double a_i         = i.radius - 0.5 * contact.overlap;
    const double a_j         = j.radius - 0.5 * contact.overlap;
    contact.velocity         = triple(i.velocity) - triple(j.velocity) +
                       cross(a_i * triple(i.spin) + a_j * triple(j.spin), contact.normal);
    contact.step = 0.;
    return contact;
  }

  /** Contact of a particle of this mass [kg] with a wall; step and drift are 0. */
  inline Contact<double>
  contact_of_wall(const Body                 &i,
                  const double                mass,
                  const WallGeometry<double> &geometry,
                  const WallStep             &wall)
  {
    const auto      place = triple(i.position) + geometry.distance * geometry.normal;
    Contact<double> contact;
    contact.overlap  = i.radius - geometry.distance;
    contact.normal   = geometry.normal;
    contact.radius   = i.radius;
    contact.mass     = mass;
    contact.velocity = triple(i.velocity) - wall.end.at(place) +
                       geometry.distance * cross(triple(i.spin), contact.normal);
    contact.step = 0.;
    return contact;
  }

  /**
   * Takes the rotation of a wall from the motion of a particle against its translation,
   * and turns the springs with the wall: a wall and a sphere that turn together rest
   * against each other. @p place of the contact [m]; @p particle_drift: of the center
   * through the substep @p dt [s].
   */
  template <class Real>
  [[gnu::always_inline]] inline void
  turn_with_wall(const WallStep     &wall,
                 const Triple<Real> &place,
                 const Triple<Real> &particle_drift,
                 const double        dt,
                 Contact<Real>      &contact,
                 Springs<Real>      &springs)
  {
    const auto half_way = place - Real(0.5 * dt) * particle_drift;
    const auto spin     = lift<Real>(wall.middle.spin);
    contact.velocity -=
      cross(lift<Real>(wall.end.spin), place - lift<Real>(wall.end.center));
    contact.drift -= cross(spin, half_way - lift<Real>(wall.middle.center));
    contact.spin_drift -= spin;
    springs.tangential = wall.turn(springs.tangential);
    springs.rolling    = wall.turn(springs.rolling);
  }

  /** Whether a wall is made of triangles. */
  inline bool
  is_surface(const Wall &wall)
  {
    return std::holds_alternative<SurfaceWall>(wall.shape);
  }
} // namespace graupel

#endif
