// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_contacts_contact_loops_h
#define graupel_dem_contacts_contact_loops_h

#include <graupel/dem/contacts/contact_geometry.h>
#include <graupel/dem/contacts/contact_sweep.h>

/**
 * The loops of ContactSweep over its contacts, templates over the laws. Each normal
 * law has a unit of its own, contact_loops_*.cc, so that the compiler does not
 * make all of them in one, which takes it minutes with sanitizers.
 */
namespace graupel
{
  namespace internal
  {
    // Bodies of as many particles as there are lanes.
    struct BodyLanes
    {
      Triple<Lanes> position;
      Lanes         radius;
      Triple<Lanes> velocity, spin, drift, spin_drift;
    };

    [[gnu::always_inline]] inline BodyLanes
    load_bodies(const Body *bodies, const std::uint32_t *rows)
    {
      Lanes n[16];
      load_records<16>(bodies, rows, 0, n);
      return {{n[0], n[1], n[2]},
              n[3],
              {n[4], n[5], n[6]},
              {n[7], n[8], n[9]},
              {n[10], n[11], n[12]},
              {n[13], n[14], n[15]}};
    }

    // Up to here the particles stay in the cache; beyond, memory is asked in advance.
    constexpr unsigned int most_cached_rows = 30000;
    // How many blocks in advance.
    constexpr std::size_t blocks_ahead = 4;

    [[gnu::always_inline]] inline void
    prefetch(const ContactList::Block &block, const Body *bodies, const Load *sums)
    {
      for (const auto *rows : {block.first, block.second})
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const char *body = reinterpret_cast<const char *>(bodies + rows[l]);
            __builtin_prefetch(body);
            __builtin_prefetch(body + 64);
            __builtin_prefetch(sums + rows[l], 1);
          }
    }

    [[gnu::always_inline]] inline Springs<Lanes>
    load_springs(const ContactList::Block &block)
    {
      const auto get = [&](const unsigned int c) {
        return Lanes(block.springs[c], std::experimental::vector_aligned);
      };
      return {{get(0), get(1), get(2)}, {get(3), get(4), get(5)}};
    }

    [[gnu::always_inline]] inline void
    store_springs(const Springs<Lanes> &s, ContactList::Block &block)
    {
      const auto put = [&](const unsigned int c, const Lanes &x) {
        x.copy_to(block.springs[c], std::experimental::vector_aligned);
      };
      put(0, s.tangential.x);
      put(1, s.tangential.y);
      put(2, s.tangential.z);
      put(3, s.rolling.x);
      put(4, s.rolling.y);
      put(5, s.rolling.z);
    }

    [[gnu::always_inline]] inline WholeLanes
    whole(const LaneMask &alive, const Lanes &quanta)
    {
      return std::experimental::static_simd_cast<WholeLanes>(
        select(alive, quanta, Lanes(0.)));
    }

    // The time step, and of contacts that began within it only the part since then.
    [[gnu::always_inline]] inline Lanes
    steps_in_contact(const Contact<Lanes> &contact,
                     const ContactList    &contacts,
                     const std::size_t     first_of_block,
                     const double          dt)
    {
      const auto fresh = lane_numbers() + static_cast<double>(first_of_block) >=
                         Lanes(1. * contacts.first_fresh());
      return some(fresh) ? select(fresh, step_in_contact(contact, dt), Lanes(dt))
                         : Lanes(dt);
    }
  } // namespace internal

  // For the few contacts that end or fail; the loops need their registers themselves.
  [[gnu::noinline]] inline void
  ContactSweep::examine(const LaneMask    &ends,
                        const LaneMask    &broken,
                        const Lanes       &overlap,
                        const std::size_t  first_of_block,
                        const ContactList &contacts,
                        const bool         with_wall,
                        const unsigned int wall)
  {
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        const std::size_t k = first_of_block + l;
        if (ends[l])
          ended.push_back(k);
        else if (broken[l])
          {
            failed_first   = contacts.first(k);
            failed_partner = with_wall ? wall_id(wall) : contacts.second(k);
            failed_overlap = overlap[l];
          }
      }
  }

  template <class NormalLaw, class RollingLaw>
  [[gnu::noinline]] void
  ContactSweep::sweep_pairs(ContactList        &contacts,
                            ParticleArrays     &particles,
                            const PairMaterial &material,
                            const double        first_density,
                            const double        second_density,
                            const double        dt)
  {
    using namespace internal;
    using dealii::numbers::PI;
    using std::min;
    const double first_mass  = 4. / 3. * PI * first_density;
    const double second_mass = 4. / 3. * PI * second_density;
    const double to_force = 1. / quantum.force, to_torque = 1. / quantum.torque;
    const Body  *bodies      = particles.body.data();
    Load        *sums        = particles.load.data();
    const bool   fetch_ahead = particles.n_rows() > most_cached_rows;

    for (std::size_t b = 0; b < contacts.blocks.size(); ++b)
      {
        ContactList::Block &block = contacts.blocks[b];
        if (fetch_ahead && b + blocks_ahead < contacts.blocks.size())
          prefetch(contacts.blocks[b + blocks_ahead], bodies, sums);
        const BodyLanes i = load_bodies(bodies, block.first);
        const BodyLanes j = load_bodies(bodies, block.second);
        const auto here   = lane_numbers() < Lanes(1. * (contacts.size() - b * n_lanes));

        Contact<Lanes>      contact;
        const Triple<Lanes> between  = j.position - i.position;
        const Lanes         distance = between.norm();
        contact.overlap              = i.radius + j.radius - distance;
        contact.normal               = (1. / distance) * between;
        contact.radius               = i.radius * j.radius / (i.radius + j.radius);
        const Lanes m_i              = first_mass * i.radius * i.radius * i.radius;
        const Lanes m_j              = second_mass * j.radius * j.radius * j.radius;
        contact.mass                 = m_i * m_j / (m_i + m_j);

        // Arms to the middle of the overlap: they add up to the distance, so
        // angular momentum is conserved.
        const Lanes a_i = i.radius - 0.5 * contact.overlap;
        const Lanes a_j = j.radius - 0.5 * contact.overlap;
        contact.velocity =
          i.velocity - j.velocity + cross(a_i * i.spin + a_j * j.spin, contact.normal);
        contact.drift = i.drift - j.drift +
                        cross(a_i * i.spin_drift + a_j * j.spin_drift, contact.normal);
        contact.spin_drift = i.spin_drift - j.spin_drift;
        contact.step       = steps_in_contact(contact, contacts, b * n_lanes, dt);

        Springs<Lanes> springs = load_springs(block);
        const auto     alive =
          here && contact.overlap > NormalLaw::release_overlap(material, contact.radius);
        const auto action =
          contact_action<NormalLaw, RollingLaw>(material, contact, springs);
        store_springs(springs, block);

        const auto broken =
          alive && !(contact.overlap < largest_overlap * min(i.radius, j.radius) &&
                     action.force.norm_square() < largest_force * largest_force);
        if (some(here && !alive) || some(broken))
          examine(
            here && !alive, broken, contact.overlap, b * n_lanes, contacts, false, 0);
        const auto counts = alive && !broken;

        const auto       turning     = cross(contact.normal, action.force);
        const auto       M           = action.rolling_torque;
        const WholeLanes zero        = 0;
        const WholeLanes F[3]        = {whole(counts, to_force * action.force.x),
                                        whole(counts, to_force * action.force.y),
                                        whole(counts, to_force * action.force.z)};
        const auto       T_i         = a_i * turning + M;
        const auto       T_j         = a_j * turning - M;
        const WholeLanes on_first[8] = {F[0],
                                        F[1],
                                        F[2],
                                        whole(counts, to_torque * T_i.x),
                                        whole(counts, to_torque * T_i.y),
                                        whole(counts, to_torque * T_i.z),
                                        zero,
                                        zero};
        add_to_records(sums, block.first, on_first);
        const WholeLanes on_second[8] = {-F[0],
                                         -F[1],
                                         -F[2],
                                         whole(counts, to_torque * T_j.x),
                                         whole(counts, to_torque * T_j.y),
                                         whole(counts, to_torque * T_j.z),
                                         zero,
                                         zero};
        add_to_records(sums, block.second, on_second);
      }
  }

  template <class NormalLaw, class RollingLaw, class Surface>
  [[gnu::noinline]] void
  ContactSweep::sweep_wall_contacts(ContactList        &contacts,
                                    ParticleArrays     &particles,
                                    const unsigned int  wall,
                                    const Surface      &surface,
                                    const Wall         &motion,
                                    const PairMaterial &material,
                                    const double        density,
                                    const double        dt)
  {
    using namespace internal;
    using dealii::numbers::PI;
    const double        to_mass  = 4. / 3. * PI * density;
    const double        to_force = 1. / quantum.force, to_torque = 1. / quantum.torque;
    const WallStep     &step     = motion.step;
    const Triple<Lanes> u        = lift<Lanes>(step.end.velocity);
    const Triple<Lanes> u_middle = lift<Lanes>(step.middle.velocity);
    const Triple<Lanes> center   = lift<Lanes>(step.end.center);
    const Triple<Lanes> axis     = lift<Lanes>(motion.course.axis());
    WholeLanes          sum[4]   = {0, 0, 0, 0};

    for (std::size_t b = 0; b < contacts.blocks.size(); ++b)
      {
        ContactList::Block &block    = contacts.blocks[b];
        const BodyLanes     i        = load_bodies(particles.body.data(), block.first);
        const auto          geometry = surface.at(i.position);
        const auto here = lane_numbers() < Lanes(1. * (contacts.size() - b * n_lanes));

        // The curvature of the tube is small against that of the sphere and left
        // out of R*; the mass of the wall is infinite.
        Contact<Lanes> contact;
        const Lanes    arm = geometry.distance;
        contact.overlap    = i.radius - geometry.distance;
        contact.normal     = geometry.normal;
        contact.radius     = i.radius;
        contact.mass       = to_mass * i.radius * i.radius * i.radius;
        contact.velocity   = i.velocity - u + arm * cross(i.spin, contact.normal);
        contact.drift = i.drift - u_middle + arm * cross(i.spin_drift, contact.normal);
        contact.spin_drift          = i.spin_drift;
        const Triple<Lanes> place   = i.position + arm * contact.normal;
        Springs<Lanes>      springs = load_springs(block);
        if (step.turns)
          turn_with_wall(step, place, i.drift, dt, contact, springs);
        contact.step = steps_in_contact(contact, contacts, b * n_lanes, dt);

        const auto alive =
          here && contact.overlap > NormalLaw::release_overlap(material, contact.radius);
        const auto action =
          contact_action<NormalLaw, RollingLaw>(material, contact, springs);
        store_springs(springs, block);

        const auto broken =
          alive && !(contact.overlap < largest_overlap * i.radius &&
                     action.force.norm_square() < largest_force * largest_force);
        if (some(here && !alive) || some(broken))
          examine(
            here && !alive, broken, contact.overlap, b * n_lanes, contacts, true, wall);
        const auto counts = alive && !broken;

        const auto torque =
          arm * cross(contact.normal, action.force) + action.rolling_torque;
        const WholeLanes zero        = 0;
        const WholeLanes on_first[8] = {whole(counts, to_force * action.force.x),
                                        whole(counts, to_force * action.force.y),
                                        whole(counts, to_force * action.force.z),
                                        whole(counts, to_torque * torque.x),
                                        whole(counts, to_torque * torque.y),
                                        whole(counts, to_torque * torque.z),
                                        zero,
                                        zero};
        add_to_records(particles.load.data(), block.first, on_first);
        sum[0] -= whole(counts, (1. / quantum.wall) * action.force.x);
        sum[1] -= whole(counts, (1. / quantum.wall) * action.force.y);
        sum[2] -= whole(counts, (1. / quantum.wall) * action.force.z);
        const Lanes on_wall =
          (cross(place - center, action.force) + action.rolling_torque) * axis;
        sum[3] -= whole(counts, (1. / quantum.wall_torque) * on_wall);
      }
    for (unsigned int d = 0; d < 4; ++d)
      loads[wall][d] += std::experimental::reduce(sum[d]);
  }

  template <class NormalLaw, class RollingLaw, class Surface>
  void
  ContactSweep::sweep_wall(ParticleArrays    &particles,
                           const unsigned int wall,
                           const Surface     &surface,
                           const Wall        &motion,
                           const Materials   &materials,
                           const double       dt)
  {
    for (unsigned int type = 0; type < n_types; ++type)
      {
        ContactList &contacts = wall_lists[wall * n_types + type];
        ended.clear();
        sweep_wall_contacts<NormalLaw, RollingLaw>(contacts,
                                                   particles,
                                                   wall,
                                                   surface,
                                                   motion,
                                                   materials.with_wall(wall, type),
                                                   materials.density[type],
                                                   dt);
        contacts.age();
        for (auto k = ended.rbegin(); k != ended.rend(); ++k)
          {
            idle_rows[wall].push_back(contacts.first(*k));
            contacts.remove(*k);
          }
      }
  }

  template <class NormalLaw>
  void
  ContactSweep::sweep_by(ParticleArrays          &particles,
                         VerletList              &list,
                         const std::vector<Wall> &walls,
                         const Materials         &materials,
                         const double             dt)
  {
    std::visit(
      [&](const auto rolling) {
        using RollingLaw = std::decay_t<decltype(rolling)>;
        for (unsigned int first = 0; first < n_types; ++first)
          for (unsigned int second = 0; second < n_types; ++second)
            {
              ContactList &contacts = pair_lists[first * n_types + second];
              ended.clear();
              sweep_pairs<NormalLaw, RollingLaw>(contacts,
                                                 particles,
                                                 materials.between(first, second),
                                                 materials.density[first],
                                                 materials.density[second],
                                                 dt);
              contacts.age();
              for (auto k = ended.rbegin(); k != ended.rend(); ++k)
                {
                  list.near.push_back({contacts.first(*k), contacts.second(*k)});
                  contacts.remove(*k);
                }
            }

        for (unsigned int w = 0; w < n_walls; ++w)
          std::visit(
            [&](const auto &surface) {
              using Surface = std::decay_t<decltype(surface)>;
              if constexpr (!std::is_same_v<Surface, NoWall> &&
                            !std::is_same_v<Surface, SurfaceWall>)
                sweep_wall<NormalLaw, RollingLaw>(
                  particles, w, surface, walls[w], materials, dt);
            },
            walls[w].shape);
      },
      rolling_law);
  }
} // namespace graupel

#endif
