// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/contact_geometry.h>
#include <graupel/dem/contacts/contact_sweep.h>

#include <sstream>

namespace graupel
{
  std::string
  ContactSweep::failure(const ParticleArrays    &particles,
                        const std::vector<Wall> &walls) const
  {
    if (!failed())
      return {};
    std::ostringstream text;
    text << "particle " << particles.id[failed_first] << " at ("
         << particles.body[failed_first].position << ") m overlaps "
         << (failed_partner < 0
               ? "the " + walls[wall_of(failed_partner)].name
               : "particle " + std::to_string(particles.id[failed_partner]))
         << " by " << failed_overlap << " m, "
         << 100. * failed_overlap / particles.body[failed_first].radius
         << " % of its radius; the contact law ends at " << 100. * largest_overlap
         << " %. Try a smaller substep, a larger Young's modulus or normal stiffness, or "
            "a slower "
            "drop.";
    return text.str();
  }

  std::vector<ContactState>
  ContactSweep::states(const ParticleArrays    &p,
                       const std::vector<Wall> &walls,
                       const Materials         &materials,
                       const bool               of_ghosts) const
  {
    // A step of no length moves no spring, so the law gives the present force.
    std::vector<ContactState> states;
    const auto                evaluate = [&](const auto &action_of) {
      std::visit(
        [&](const auto normal, const auto rolling) { action_of(normal, rolling); },
        normal_law,
        rolling_law);
    };
    evaluate([&](const auto normal, const auto rolling) {
      using NormalLaw  = std::decay_t<decltype(normal)>;
      using RollingLaw = std::decay_t<decltype(rolling)>;
      for (const auto &list : pair_lists)
        for (std::size_t k = 0; k < list.size(); ++k)
          if (of_ghosts || list.first(k) < p.n_owned)
            {
              const auto i = list.first(k), j = list.second(k);
              const auto contact = contact_of_pair(
                p.body[i],
                p.body[j],
                materials.density[p.type[i]] * sphere_volume(p.body[i].radius),
                materials.density[p.type[j]] * sphere_volume(p.body[j].radius));
              auto       springs = list.springs(k);
              const auto action  = contact_action<NormalLaw, RollingLaw>(
                materials.between(p.type[i], p.type[j]), contact, springs);
              states.push_back({p.id[i],
                                p.id[j],
                                p.body[i].position,
                                p.body[j].position,
                                contact.overlap,
                                tensor(contact.normal),
                                tensor(action.force)});
            }
      for (unsigned int w = 0; w < wall_lists.size(); ++w)
        for (std::size_t k = 0; k < wall_lists[w].size(); ++k)
          {
            const auto  i       = wall_lists[w].first(k);
            const Wall &wall    = walls[w / n_types];
            const auto  contact = contact_of_wall(p.body[i],
                                                 p.mass[i],
                                                 wall.at(triple(p.body[i].position),
                                                         wall_lists[w].second(k),
                                                         2. * p.body[i].radius),
                                                 wall.step);
            auto        springs = wall_lists[w].springs(k);
            const auto  action  = contact_action<NormalLaw, RollingLaw>(
              materials.with_wall(w / n_types, w % n_types), contact, springs);
            const auto normal_vector = tensor(contact.normal);
            states.push_back(
              {p.id[i],
               wall_id(w / n_types, wall_lists[w].second(k)),
               p.body[i].position,
               p.body[i].position + (p.body[i].radius - contact.overlap) * normal_vector,
               contact.overlap,
               normal_vector,
               tensor(action.force)});
          }
    });
    return states;
  }
} // namespace graupel
