#include <graupel/dem/dem.h>
#include <graupel/dem/particles/dem_error.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    template <class Element>
    std::vector<Element>
    from_all_ranks(const std::vector<Element> &mine, MPI_Comm communicator)
    {
      std::vector<Element> all;
      for (const auto &of_rank : mpi::all_gather(communicator, mine))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      return all;
    }

    // A load that was counted in the quanta of a bed with other contacts.
    void
    recount(Load &load, const DemState &state, const ForceQuanta &here)
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
    DemState                        result;
    std::vector<DemState::Particle> mine;
    std::vector<std::uint32_t>      rows;
    for (unsigned int row = 0; row < arrays.n_owned; ++row)
      {
        mine.push_back({arrays.id[row], pack(arrays, row)});
        rows.push_back(row);
      }
    result.particles = from_all_ranks(mine, communicator());
    std::sort(result.particles.begin(),
              result.particles.end(),
              [](const auto &a, const auto &b) { return a.id < b.id; });
    result.contacts = from_all_ranks(contacts.contacts_of(arrays, rows), communicator());
    result.walls    = state_of_walls();
    result.clock_runs        = time.has_value();
    result.clock             = clock();
    result.departed          = departed_by_type;
    result.departed_volume   = departed_volume;
    result.solid_volume      = volume_by_type;
    result.next_id           = particle_store.next_number();
    result.packing_materials = packing;
    result.force_quantum     = contacts.quanta().force;
    result.torque_quantum    = contacts.quanta().torque;
    return result;
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
    const unsigned int n_types = materials.n_types();
    volume_by_type.assign(n_types, 0.);
    number_by_type.assign(n_types, 0);
    departed_by_type.assign(n_types, 0);
    departed_volume.assign(n_types, 0.);

    const auto               number_here = restore_walls(state);
    std::vector<NewParticle> added;
    for (const auto &particle : state.particles)
      {
        const Parcel &parcel = particle.parcel;
        if (parcel.type >= materials.n_types())
          throw DemError("the checkpoint has particles of type " +
                         std::to_string(parcel.type + 1) +
                         ", which the parameters do not have");
        const Body body = body_of(parcel);
        added.push_back({body.position,
                         body.radius,
                         body.velocity,
                         body.spin,
                         parcel.type,
                         particle.id});
      }
    insert(added);

    const auto of = [&](const std::int64_t id) {
      return std::lower_bound(
        state.particles.begin(),
        state.particles.end(),
        id,
        [](const auto &particle, const std::int64_t i) { return particle.id < i; });
    };
    for (unsigned int row = 0; row < arrays.n_owned; ++row)
      {
        const double mass = arrays.mass[row]; // of the present density
        unpack(of(arrays.id[row])->parcel, arrays, row);
        arrays.mass[row]             = mass;
        arrays.body[row].position[2] = ends.rounded(arrays.body[row].position[2]);
        recount(arrays.load[row], state, contacts.quanta());
      }
    for (LooseContact contact : state.contacts)
      {
        if (contact.second < 0)
          {
            const auto wall = number_here.at(wall_of(contact.second));
            if (wall < 0)
              continue;
            contact.second = wall_id(wall, facet_of(contact.second));
          }
        loose.push_back(contact);
      }
    find_ghosts();
    restore_counts(state);
    shape.follow(walls);
    use_packing_materials(state.packing_materials);
  }

  void
  Dem::restore_counts(const DemState &state)
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
    particle_store.number_from(state.next_id);
  }
} // namespace graupel
