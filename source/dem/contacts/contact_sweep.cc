// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/contact_sweep.h>

namespace graupel
{
  namespace
  {
    // A contact beyond this many reference forces is a failure; 16 of them
    // still fit into the sum.
    constexpr double largest_relative_force = 500.;
  } // namespace

  ContactSweep::ContactSweep(const NormalLaws  &normal_law,
                             const RollingLaws &rolling_law,
                             const unsigned int n_types,
                             const unsigned int n_walls,
                             const double       reference_force,
                             const double       reference_radius)
    : normal_law(normal_law)
    , rolling_law(rolling_law)
    , n_types(n_types)
    , n_walls(n_walls)
    , largest_force(largest_relative_force * reference_force)
    , quantum(reference_force, reference_radius)
    , pair_lists(n_types * n_types)
    , wall_lists(n_walls * n_types)
    , idle_rows(n_walls)
    , loads(n_walls)
  {
  }

  void
  ContactSweep::begin_pairs(const ParticleArrays &particles, VerletList &list)
  {
    auto             &near   = list.near;
    const Body       *bodies = particles.body.data();
    const std::size_t n      = near.size();
    std::size_t       kept   = 0;
    for (std::size_t k = 0; k < n; k += n_lanes)
      {
        // The last pair fills up the last lanes.
        std::uint32_t first[n_lanes], second[n_lanes];
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const NeighborPair &pair = near[std::min(k + l, n - 1)];
            first[l]                 = pair.first;
            second[l]                = pair.second;
            __builtin_prefetch(bodies +
                               near[std::min(k + 4 * n_lanes + l, n - 1)].second);
          }
        Lanes i[8], j[8];
        load_records<8>(bodies, first, 0, i);
        load_records<8>(bodies, second, 0, j);
        const Triple<Lanes> between{j[0] - i[0], j[1] - i[1], j[2] - i[2]};
        const auto          touches = i[3] + j[3] - between.norm() > Lanes(0.);
        if (!some(touches) && kept == k)
          {
            kept = std::min(k + n_lanes, n);
            continue;
          }
        for (unsigned int l = 0; l < n_lanes && k + l < n; ++l)
          if (touches[l])
            pair_list(particles, {first[l], second[l]}).begin(first[l], second[l]);
          else
            near[kept++] = {first[l], second[l]};
      }
    near.resize(kept);
  }

  void
  ContactSweep::begin_walls(const ParticleArrays    &particles,
                            const std::vector<Wall> &walls)
  {
    for (unsigned int w = 0; w < n_walls; ++w)
      std::visit(
        [&](const auto &surface) {
          if constexpr (std::is_same_v<std::decay_t<decltype(surface)>, SurfaceWall>)
            return;
          else
            begin_wall(particles, surface, w);
        },
        walls[w].shape);
  }

  template <class Surface>
  void
  ContactSweep::begin_wall(const ParticleArrays &particles,
                           const Surface        &surface,
                           const unsigned int    w)
  {
    auto       &rows = idle_rows[w];
    std::size_t kept = 0;
    for (const std::uint32_t i : rows)
      {
        const Body &body = particles.body[i];
        if (body.radius - surface.at(triple(body.position)).distance > 0.)
          wall_lists[w * n_types + particles.type[i]].begin(i, 0);
        else
          rows[kept++] = i;
      }
    rows.resize(kept);
  }

  void
  ContactSweep::sweep(ParticleArrays          &particles,
                      VerletList              &list,
                      const std::vector<Wall> &walls,
                      const Materials         &materials,
                      const double             dt)
  {
    failed_overlap = 0.;
    begin_pairs(particles, list);
    begin_walls(particles, walls);
    std::visit(
      [&](const auto law) {
        sweep_by<std::decay_t<decltype(law)>>(particles, list, walls, materials, dt);
      },
      normal_law);
    sweep_surfaces(particles, walls, materials, dt);
  }

  void
  ContactSweep::reset_wall_loads()
  {
    std::fill(loads.begin(), loads.end(), std::array<std::int64_t, 4>{});
  }

  std::vector<std::int64_t>
  ContactSweep::load_quanta() const
  {
    std::vector<std::int64_t> all;
    for (const auto &load : loads)
      all.insert(all.end(), load.begin(), load.end());
    return all;
  }

  std::vector<WallLoad>
  ContactSweep::wall_loads(const std::vector<std::int64_t> &quanta,
                           const unsigned int               n_sweeps) const
  {
    std::vector<WallLoad> result(loads.size());
    for (unsigned int w = 0; w < loads.size(); ++w)
      {
        for (unsigned int d = 0; d < 3; ++d)
          result[w].force[d] =
            quantum.wall * static_cast<double>(quanta[4 * w + d]) / n_sweeps;
        result[w].torque =
          quantum.wall_torque * static_cast<double>(quanta[4 * w + 3]) / n_sweeps;
      }
    return result;
  }
} // namespace graupel
