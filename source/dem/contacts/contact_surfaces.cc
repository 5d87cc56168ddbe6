// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/contact_geometry.h>
#include <graupel/dem/contacts/contact_sweep.h>

namespace graupel
{
  template <class NormalLaw, class RollingLaw>
  void
  ContactSweep::sweep_surface(ParticleArrays    &particles,
                              const unsigned int wall,
                              const SurfaceWall &surface,
                              const Wall        &motion,
                              const Materials   &materials,
                              const double       dt)
  {
    // Both in the order of the rows.
    std::sort(idle_rows[wall].begin(), idle_rows[wall].end());
    for (unsigned int type = 0; type < n_types; ++type)
      {
        const PairMaterial &material = materials.with_wall(wall, type);
        ContactList         before   = std::move(wall_lists[wall * n_types + type]);
        ContactList        &after    = wall_lists[wall * n_types + type];
        before.sort();
        after.clear();
        std::size_t next = 0;
        for (const std::uint32_t row : idle_rows[wall])
          {
            if (particles.type[row] != type)
              continue;
            const Body  &body    = particles.body[row];
            const double release = NormalLaw::release_overlap(material, body.radius);
            while (next < before.size() && before.first(next) < row)
              ++next;
            touches.clear();
            surface.touches(body.position, body.radius - release, touches);
            for (const auto &touch : touches)
              {
                std::size_t k = next;
                while (k < before.size() && before.first(k) == row &&
                       before.second(k) != touch.facet)
                  ++k;
                const bool is_old = k < before.size() && before.first(k) == row;
                if (!is_old && touch.distance >= body.radius)
                  continue;
                Springs<double> springs = is_old ? before.springs(k) : Springs<double>{};
                sweep_surface_contact<NormalLaw, RollingLaw>(
                  particles, row, touch, wall, motion, material, dt, !is_old, springs);
                after.add(row, touch.facet, springs);
              }
          }
      }
  }

  template <class NormalLaw, class RollingLaw>
  void
  ContactSweep::sweep_surface_contact(ParticleArrays           &particles,
                                      const std::uint32_t       row,
                                      const SurfaceMesh::Touch &touch,
                                      const unsigned int        wall,
                                      const Wall               &motion,
                                      const PairMaterial       &material,
                                      const double              dt,
                                      const bool                is_fresh,
                                      Springs<double>          &springs)
  {
    const Body     &body    = particles.body[row];
    const auto     &step    = motion.step;
    Contact<double> contact = contact_of_wall(
      body, particles.mass[row], {touch.distance, triple(touch.normal)}, {});
    contact.velocity -= step.end.velocity;
    contact.drift = triple(body.drift) - step.middle.velocity +
                    touch.distance * cross(triple(body.spin_drift), contact.normal);
    contact.spin_drift = triple(body.spin_drift);
    const auto place   = triple(body.position) + touch.distance * contact.normal;
    if (step.turns)
      turn_with_wall(step, place, triple(body.drift), dt, contact, springs);
    contact.step      = is_fresh ? step_in_contact(contact, dt) : dt;
    const auto action = contact_action<NormalLaw, RollingLaw>(material, contact, springs);
    if (!(contact.overlap < largest_overlap * body.radius &&
          action.force.norm_square() < largest_force * largest_force))
      {
        failed_first   = row;
        failed_partner = wall_id(wall, touch.facet);
        failed_overlap = contact.overlap;
        return;
      }
    const auto torque =
      touch.distance * cross(contact.normal, action.force) + action.rolling_torque;
    const double force[3] = {action.force.x, action.force.y, action.force.z};
    const double turn[3]  = {torque.x, torque.y, torque.z};
    for (unsigned int d = 0; d < 3; ++d)
      {
        auto &quanta = particles.load[row].quanta;
        quanta[d] += static_cast<std::int64_t>((1. / quantum.force) * force[d]);
        quanta[3 + d] += static_cast<std::int64_t>((1. / quantum.torque) * turn[d]);
        loads[wall][d] -= static_cast<std::int64_t>((1. / quantum.wall) * force[d]);
      }
    const auto on_wall =
      cross(place - step.end.center, action.force) + action.rolling_torque;
    loads[wall][3] -= static_cast<std::int64_t>((1. / quantum.wall_torque) *
                                                (on_wall * motion.course.axis()));
  }

  void
  ContactSweep::sweep_surfaces(ParticleArrays          &particles,
                               const std::vector<Wall> &walls,
                               const Materials         &materials,
                               const double             dt)
  {
    for (unsigned int w = 0; w < n_walls; ++w)
      if (const auto *surface = std::get_if<SurfaceWall>(&walls[w].shape))
        std::visit(
          [&](const auto normal, const auto rolling) {
            sweep_surface<std::decay_t<decltype(normal)>,
                          std::decay_t<decltype(rolling)>>(
              particles, w, *surface, walls[w], materials, dt);
          },
          normal_law,
          rolling_law);
  }
} // namespace graupel
