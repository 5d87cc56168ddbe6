#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/particles/parcel.h>
#include <graupel/dem/particles/particle_store.h>

#include <deal.II/grid/grid_tools.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <limits>
#include <sstream>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    // A particle's label: who has the rest of it.
    enum Label : unsigned int
    {
      holder        = 0,
      holders_row   = 1,
      n_label_parts = 2
    };

    // How far outside of the unit cell a point may lie by the rounding of the
    // mapping's inverse [-].
    constexpr double unit_cell_tolerance = 1e-7;

    // How far a particle may go between two sorts of deal.II, in smallest edges.
    constexpr double longest_way = 0.5;

    // All that one rank sends another.
    struct Delivery
    {
      std::vector<Parcel>       parcels;
      std::vector<LooseContact> contacts;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &parcels &contacts;
      }
    };

    // One array at a time, so that little is there twice. Rows that come from
    // elsewhere are left to be filled in.
    template <class Column>
    void
    rearrange(Column &column, const std::vector<std::uint32_t> &old_row)
    {
      Column rearranged(old_row.size());
      for (std::size_t row = 0; row < old_row.size(); ++row)
        if (old_row[row] != ParticleStore::no_row)
          rearranged[row] = column[old_row[row]];
      column = std::move(rearranged);
    }
  } // namespace

  ParticleStore::ParticleStore(VesselMesh &mesh)
    : mesh(mesh)
    , cache(mesh.triangulation(), mesh.mapping())
    , handler(mesh.triangulation(), mesh.mapping(), n_label_parts)
  {
    handler.signals.particle_lost.connect(
      [this](const dealii::Particles::ParticleIterator<3> &particle,
             const CellIterator &) {
        const auto properties = particle->get_properties();
        strays.push_back({particle->get_id(),
                          particle->get_location(),
                          std::vector<double>(properties.begin(), properties.end())});
      });
  }

  ParticleStore::Location
  ParticleStore::locate(const dealii::Point<3> &point, const double reach) const
  {
    // The boxes are those of the vertices, and a curved cell bulges out of its
    // own, so look in the boxes of the surroundings too.
    namespace bgi                = boost::geometry::index;
    const auto            &boxes = cache.get_locally_owned_cell_bounding_boxes_rtree();
    dealii::BoundingBox<3> around(std::make_pair(point, point));
    around.extend(reach);

    Location location;
    for (auto box = boxes.qbegin(bgi::intersects(around)); box != boxes.qend(); ++box)
      try
        {
          location.cell = box->second;
          location.reference =
            mesh.mapping().transform_real_to_unit_cell(location.cell, point);
          if (dealii::GeometryInfo<3>::is_inside_unit_cell(location.reference,
                                                           unit_cell_tolerance))
            {
              location.found = true;
              return location;
            }
        }
      catch (const dealii::Mapping<3>::ExcTransformationFailed &)
        {
          // Far outside of this cell the mapping has no inverse: not here.
        }
    return location;
  }

  std::vector<unsigned int>
  ParticleStore::place(const std::vector<Traveller> &travellers)
  {
    const unsigned int me     = mpi::this_mpi_process(communicator());
    const unsigned int nobody = mpi::n_mpi_processes(communicator());
    const double       reach  = 0.5 * mesh.smallest_edge();
    const std::size_t  n      = travellers.size();

    std::vector<Location>     locations(n);
    std::vector<unsigned int> claims(n), owners(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        locations[k] = locate(travellers[k].position, reach);
        claims[k]    = locations[k].found ? me : nobody;
      }
    mpi::min(claims, communicator(), owners);

    for (std::size_t k = 0; k < n; ++k)
      if (owners[k] == me)
        handler.insert_particle(travellers[k].position,
                                locations[k].reference,
                                travellers[k].id,
                                locations[k].cell,
                                dealii::make_array_view(travellers[k].label));
    return owners;
  }

  void
  ParticleStore::insert(const std::vector<NewParticle> &added, ParticleArrays &p)
  {
    const unsigned int me     = mpi::this_mpi_process(communicator());
    const unsigned int nobody = mpi::n_mpi_processes(communicator());
    const double       reach  = 0.5 * mesh.smallest_edge();

    std::vector<Location>     locations;
    std::vector<unsigned int> claims, owners(added.size());
    for (const auto &particle : added)
      {
        locations.push_back(locate(particle.position, reach));
        claims.push_back(locations.back().found ? me : nobody);
      }
    mpi::min(claims, communicator(), owners);

    for (std::size_t k = 0; k < added.size(); ++k)
      if (owners[k] == nobody)
        {
          std::ostringstream text;
          text << "no cell of the mesh holds the point (" << added[k].position
               << ") m where a particle was to be inserted; it must lie in the "
                  "cylinder";
          throw DemError(text.str());
        }

    unsigned int row = p.n_owned;
    p.n_owned += std::count(owners.begin(), owners.end(), me);
    p.resize(p.n_owned);
    for (std::size_t k = 0; k < added.size(); ++k)
      {
        const unsigned int id = added[k].id < 0 ? next_id : added[k].id;
        next_id               = std::max(next_id, id + 1);
        if (owners[k] != me)
          continue;
        p.id[row]            = id;
        p.type[row]          = added[k].type;
        p.body[row].position = added[k].position;
        p.body[row].radius   = added[k].radius;
        p.body[row].velocity = added[k].velocity;
        p.body[row].spin     = added[k].spin;

        std::vector<double> label{1. * me, 1. * row};
        handler.insert_particle(added[k].position,
                                locations[k].reference,
                                id,
                                locations[k].cell,
                                dealii::make_array_view(label));
        ++row;
      }
    n_expected += added.size();
  }

  void
  ParticleStore::clear()
  {
    handler.clear_particles();
    cells.clear();
    n_expected = next_id = 0;
  }

  ParticleStore::Moves
  ParticleStore::migrate(ParticleArrays                   &particles,
                         const ContactsOf                 &contacts_of,
                         const std::vector<std::uint32_t> &departed)
  {
    strays.clear();
    set_places(particles, departed);
    handler.sort_particles_into_subdomains_and_cells();
    bring_home_strays();
    check_count();
    return collect(particles, contacts_of);
  }

  ParticleStore::Moves
  ParticleStore::repartition(ParticleArrays    &particles,
                             const ContactsOf  &contacts_of,
                             const unsigned int cell_weight,
                             const unsigned int particle_weight)
  {
    handler.prepare_for_coarsening_and_refinement();
    mesh.repartition([&](const CellIterator &cell) {
      return cell_weight + particle_weight * handler.n_particles_in_cell(cell);
    });
    handler.unpack_after_coarsening_and_refinement();
    check_count();
    return collect(particles, contacts_of);
  }

  void
  ParticleStore::set_places(const ParticleArrays             &particles,
                            const std::vector<std::uint32_t> &departed)
  {
    std::vector<unsigned char> gone(particles.n_owned, 0);
    for (const auto row : departed)
      gone[row] = 1;
    n_expected -= mpi::sum(static_cast<unsigned int>(departed.size()), communicator());

    // deal.II loses, without a signal, a particle that has crossed more than one
    // layer of cells on its way to another rank: those that went far are strays.
    const double reach = mpi::n_mpi_processes(communicator()) > 1
                           ? longest_way * mesh.smallest_edge()
                           : std::numeric_limits<double>::infinity();
    std::vector<dealii::Particles::ParticleIterator<3>> to_remove;
    for (auto particle = handler.begin(); particle != handler.end(); ++particle)
      {
        const auto label = particle->get_properties();
        const auto row   = static_cast<unsigned int>(label[holders_row]);
        const auto place = particles.body[row].position;
        const bool far   = place.distance(particle->get_location()) > reach;
        if (far && !gone[row])
          strays.push_back(
            {particle->get_id(), place, std::vector<double>(label.begin(), label.end())});
        if (far || gone[row])
          to_remove.push_back(particle);
        else
          particle->set_location(place);
      }
    // Collective, in that it counts anew.
    handler.remove_particles(to_remove);
  }

  ParticleStore::Moves
  ParticleStore::collect(ParticleArrays &particles, const ContactsOf &contacts_of)
  {
    const unsigned int me = mpi::this_mpi_process(communicator());
    const unsigned int n  = handler.n_locally_owned_particles();

    // For each new row the old one, and what is to be fetched from which rank.
    std::vector<std::uint32_t>                         old_row(n, no_row);
    std::vector<std::int64_t>                          ids(n);
    std::map<unsigned int, std::vector<std::uint32_t>> wanted, awaited;
    std::vector<std::pair<std::int64_t, dealii::Particles::ParticleIterator<3>>> by_id;
    cells.clear();
    std::uint32_t row = 0;
    for (const auto &cell : mesh.owned_cells())
      {
        if (handler.n_particles_in_cell(cell) == 0)
          continue;
        cells.push_back({cell, row, {}});
        // By id, so that sums over rows do not depend on how the particles came here.
        by_id.clear();
        const auto in_cell = handler.particles_in_cell(cell);
        for (auto particle = in_cell.begin(); particle != in_cell.end(); ++particle)
          by_id.push_back({particle->get_id(), particle});
        std::sort(by_id.begin(), by_id.end(), [](const auto &a, const auto &b) {
          return a.first < b.first;
        });
        for (auto &[id, particle] : by_id)
          {
            const auto label = particle->get_properties();
            const auto rank  = static_cast<unsigned int>(label[holder]);
            const auto from  = static_cast<std::uint32_t>(label[holders_row]);
            if (rank == me)
              old_row[row] = from;
            else
              {
                wanted[rank].push_back(from);
                awaited[rank].push_back(row);
              }
            ids[row]           = id;
            label[holder]      = me;
            label[holders_row] = row;
            cells.back().reference_locations.push_back(
              particle->get_reference_location());
            ++row;
          }
      }

    std::map<unsigned int, Delivery> sent, received;
    if (mpi::n_mpi_processes(communicator()) > 1)
      {
        for (const auto &[rank, rows] : mpi::some_to_some(communicator(), wanted))
          {
            for (const auto leaving : rows)
              sent[rank].parcels.push_back(pack(particles, leaving));
            sent[rank].contacts = contacts_of(rows);
          }
        received = mpi::some_to_some(communicator(), sent);
      }

    Moves moves;
    moves.new_row.assign(particles.n_owned, no_row);
    for (row = 0; row < n; ++row)
      if (old_row[row] != no_row)
        moves.new_row[old_row[row]] = row;

    particles.id = std::move(ids);
    rearrange(particles.type, old_row);
    rearrange(particles.body, old_row);
    rearrange(particles.mass, old_row);
    rearrange(particles.load, old_row);
    rearrange(particles.external_force, old_row);
    rearrange(particles.external_torque, old_row);
    particles.n_owned = n;
    for (const auto &[rank, delivery] : received)
      {
        for (std::size_t k = 0; k < delivery.parcels.size(); ++k)
          unpack(delivery.parcels[k], particles, awaited[rank][k]);
        moves.arrived.insert(
          moves.arrived.end(), delivery.contacts.begin(), delivery.contacts.end());
      }
    return moves;
  }

  void
  ParticleStore::bring_home_strays()
  {
    // deal.II gives up a particle that lies, within rounding, on the face of two
    // cells, or that went further than the cells next to its own.
    if (mpi::sum(static_cast<unsigned int>(strays.size()), communicator()) == 0)
      return;

    std::vector<Traveller> all;
    for (const auto &of_rank : mpi::all_gather(communicator(), strays))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    const auto owners = place(all);
    for (std::size_t k = 0; k < all.size(); ++k)
      if (owners[k] == mpi::n_mpi_processes(communicator()))
        {
          std::ostringstream text;
          text << "particle " << all[k].id << " was lost at (" << all[k].position
               << ") m, outside of the cylinder; a smaller substep or a stiffer wall "
                  "keeps it in";
          throw DemError(text.str());
        }
  }

  void
  ParticleStore::check_count()
  {
    // It forgets to count what was inserted or removed one by one.
    handler.update_cached_numbers();
    if (mpi::sum(static_cast<unsigned int>(handler.n_locally_owned_particles()),
                 communicator()) == n_expected)
      return;

    std::vector<unsigned int> ids;
    for (const auto &particle : handler)
      ids.push_back(particle.get_id());
    std::vector<unsigned int> copies(next_id, 0);
    for (const auto &of_rank : mpi::all_gather(communicator(), ids))
      for (const auto id : of_rank)
        ++copies[id];
    const auto n_lost    = std::count(copies.begin(), copies.end(), 0u);
    const auto n_doubled = std::count_if(
      copies.begin(), copies.end(), [](const unsigned int n) { return n > 1; });
    throw DemError("particles were lost or doubled on their way between ranks: of " +
                   std::to_string(next_id) + " ever inserted " + std::to_string(n_lost) +
                   " are missing and " + std::to_string(n_doubled) +
                   " are double, where " + std::to_string(n_expected) +
                   " should be in the vessel");
  }

  void
  ParticleStore::visit_cells(const CellVisitor &visit) const
  {
    for (const auto &cell_rows : cells)
      visit(cell_rows.cell, cell_rows.first_row, cell_rows.reference_locations);
  }
} // namespace graupel
