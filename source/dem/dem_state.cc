// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/dem.h>
#include <graupel/dem/numbers/exact_sum.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/particles/same_rows.h>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    // A load that was counted in the quanta of a bed with other contacts.
    void
    recount(Load &load, const DemState::Common &state, const ForceQuanta &here)
    {
      if (state.force_quantum == 0. ||
          (state.force_quantum == here.force && state.torque_quantum == here.torque))
        return;
      for (unsigned int k = 0; k < 6; ++k)
        load.quanta[k] = std::llround(static_cast<double>(load.quanta[k]) *
                                      (k < 3 ? state.force_quantum / here.force
                                             : state.torque_quantum / here.torque));
    }
  } // namespace

  DemState
  Dem::state() const
  {
    DemState   result;
    const auto all = contacts.contacts_of(arrays, same_rows(arrays.n_owned));
    // The places in it of what each particle takes part in.
    std::vector<std::pair<std::int64_t, std::size_t>> of_id;
    for (std::size_t k = 0; k < all.size(); ++k)
      for (const std::int64_t id : {all[k].first, all[k].second})
        of_id.emplace_back(id, k);
    std::sort(of_id.begin(), of_id.end());
    for (unsigned int row = 0; row < arrays.n_owned; ++row)
      {
        const auto id    = arrays.id[row];
        const auto first = static_cast<std::int64_t>(result.contacts.size());
        result.particles.push_back({id, first, pack(arrays, row)});
        for (auto at = std::lower_bound(
               of_id.begin(), of_id.end(), std::make_pair(id, std::size_t(0)));
             at != of_id.end() && at->first == id;
             ++at)
          result.contacts.push_back(all[at->second]);
      }
    auto &common             = result.common;
    common.walls             = state_of_walls();
    common.clock_runs        = time.has_value();
    common.clock             = clock();
    common.departed          = departed_by_type;
    common.departed_volume   = departed_volume;
    common.solid_volume      = volume_by_type;
    common.next_id           = particle_store.next_number();
    common.packing_materials = packing;
    common.force_quantum     = contacts.quanta().force;
    common.torque_quantum    = contacts.quanta().torque;
    return result;
  }

  std::string
  Dem::problem_of(const DemState &state) const
  {
    std::vector<NewParticle> added;
    for (const auto &particle : state.particles)
      {
        const Parcel &parcel = particle.parcel;
        if (parcel.type >= materials.n_types())
          return "the checkpoint has particles of type " +
                 std::to_string(parcel.type + 1) + ", which the parameters do not have";
        const Body body = body_of(parcel);
        added.push_back({body.position,
                         body.radius,
                         body.velocity,
                         body.spin,
                         parcel.type,
                         particle.id});
      }
    return problem_of(added);
  }

  void
  Dem::restore(const DemState &state)
  {
    arrays = {};
    contacts.clear();
    list.clear();
    loose.clear();
    particle_store.clear();
    halo.reset();
    const auto number_here = restore_walls(state.common);
    throw_together(problem_of(state), communicator());
    take_rows(state);

    // Of some of the rows as they are now. Those with walls that are not here are left
    // out.
    const auto contacts_of_rows = [&](const std::vector<std::uint32_t> &rows) {
      std::vector<LooseContact> result;
      for (const auto row : rows)
        {
          const auto end = row + 1 < state.particles.size()
                             ? state.particles[row + 1].first_contact
                             : static_cast<std::int64_t>(state.contacts.size());
          for (auto k = state.particles[row].first_contact; k < end; ++k)
            {
              LooseContact contact = state.contacts[k];
              if (contact.second < 0)
                {
                  const auto wall = number_here.at(wall_of(contact.second));
                  if (wall < 0)
                    continue;
                  contact.second = wall_id(wall, facet_of(contact.second));
                }
              result.push_back(contact);
            }
        }
      return result;
    };
    const auto moves = particle_store.migrate(arrays, contacts_of_rows, {}, 0);
    std::vector<std::uint32_t> staying;
    for (std::uint32_t row = 0; row < moves.new_row.size(); ++row)
      if (moves.new_row[row] != ParticleStore::no_row)
        staying.push_back(row);
    loose = contacts_of_rows(staying);
    loose.insert(loose.end(), moves.arrived.begin(), moves.arrived.end());
    find_ghosts();
    shape.follow(walls);
    use_packing_materials(state.common.packing_materials);
  }

  void
  Dem::take_rows(const DemState &state)
  {
    std::vector<ParticleStore::Passenger> passengers;
    for (const auto &particle : state.particles)
      passengers.push_back({particle.id, particle.parcel});
    particle_store.begin_with(arrays, passengers, state.common.next_id);

    const unsigned int n_types = materials.n_types();
    number_by_type.assign(n_types, 0);
    std::vector<ExactSum> volumes(n_types,
                                  ExactSum(sphere_volume(input.largest_radius())));
    for (unsigned int row = 0; row < arrays.n_owned; ++row)
      {
        Body               &body   = arrays.body[row];
        const unsigned char type   = arrays.type[row];
        const double        volume = sphere_volume(body.radius);
        arrays.mass[row] = materials.density[type] * volume; // the present density
        body.position[2] = ends.rounded(body.position[2]);
        recount(arrays.load[row], state.common, contacts.quanta());
        ++number_by_type[type];
        volumes[type].add(volume);
      }
    mpi::sum(number_by_type, communicator(), number_by_type);
    volume_by_type = ExactSum::totals(volumes, communicator());
    departed_by_type.assign(n_types, 0);
    departed_volume.assign(n_types, 0.);
    restore_counts(state.common);
  }

  void
  Dem::restore_counts(const DemState::Common &state)
  {
    // Of fewer types than here, what is not told is zero.
    std::copy(state.departed.begin(),
              state.departed.begin() +
                std::min(state.departed.size(), departed_by_type.size()),
              departed_by_type.begin());
    std::copy(state.departed_volume.begin(),
              state.departed_volume.begin() +
                std::min(state.departed_volume.size(), departed_volume.size()),
              departed_volume.begin());
    std::copy(state.solid_volume.begin(),
              state.solid_volume.begin() +
                std::min(state.solid_volume.size(), volume_by_type.size()),
              volume_by_type.begin());
  }
} // namespace graupel
