#include <graupel/dem/dem.h>
#include <graupel/dem/dem_error.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <cstring>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    DemState::Particle
    packed(const ParticleArrays &p, const unsigned int row)
    {
      DemState::Particle particle;
      particle.id   = p.id[row];
      particle.type = p.type[row];
      std::memcpy(particle.body.data(), &p.body[row], sizeof(Body));
      particle.load = p.load[row].quanta;
      for (unsigned int d = 0; d < 3; ++d)
        particle.external_force[d] = p.external_force[row][d];
      return particle;
    }

    Body
    body_of(const DemState::Particle &particle)
    {
      Body body;
      std::memcpy(static_cast<void *>(&body), particle.body.data(), sizeof(Body));
      return body;
    }

    template <class Element>
    std::vector<Element>
    from_all_ranks(const std::vector<Element> &mine, MPI_Comm communicator)
    {
      std::vector<Element> all;
      for (const auto &of_rank : mpi::all_gather(communicator, mine))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      return all;
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
        mine.push_back(packed(arrays, row));
        rows.push_back(row);
      }
    result.particles = from_all_ranks(mine, communicator());
    std::sort(result.particles.begin(),
              result.particles.end(),
              [](const auto &a, const auto &b) { return a.id < b.id; });
    result.contacts = from_all_ranks(contacts.contacts_of(arrays, rows), communicator());
    for (const Wall &wall : walls)
      if (const auto *plane = std::get_if<PlaneWall>(&wall.shape))
        result.planes.push_back({plane->point.x, plane->point.y, plane->point.z});
    result.n_departed = n_departed_so_far;
    return result;
  }

  void
  Dem::restore(const DemState &state)
  {
    arrays = {};
    contacts.clear();
    list.clear();
    particle_store.clear();
    total_mass = total_volume = 0.;

    std::vector<NewParticle> added;
    for (const auto &particle : state.particles)
      {
        if (particle.type >= materials.n_types())
          throw DemError("the checkpoint has particles of type " +
                         std::to_string(particle.type + 1) +
                         ", which the parameters do not have");
        const Body body = body_of(particle);
        added.push_back({body.position,
                         body.radius,
                         body.velocity,
                         body.spin,
                         particle.type,
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
    std::vector<std::int64_t> own;
    for (unsigned int row = 0; row < arrays.n_owned; ++row)
      {
        const auto &particle    = *of(arrays.id[row]);
        arrays.body[row]        = body_of(particle);
        arrays.load[row].quanta = particle.load;
        for (unsigned int d = 0; d < 3; ++d)
          arrays.external_force[row][d] = particle.external_force[d];
        own.push_back(particle.id);
      }
    halo.rebuild(arrays);
    // Those with walls know one particle only, which must be here.
    std::sort(own.begin(), own.end());
    std::vector<LooseContact> mine;
    for (const LooseContact &contact : state.contacts)
      if (contact.second >= 0 ||
          std::binary_search(own.begin(), own.end(), contact.first))
        mine.push_back(contact);
    contacts.add(arrays, std::move(mine));

    auto point = state.planes.begin();
    for (Wall &wall : walls)
      if (auto *plane = std::get_if<PlaneWall>(&wall.shape);
          plane != nullptr && point != state.planes.end())
        {
          plane->point = {(*point)[0], (*point)[1], (*point)[2]};
          ++point;
        }
    n_departed_so_far = state.n_departed;
    list_is_valid     = false;
  }
} // namespace graupel
