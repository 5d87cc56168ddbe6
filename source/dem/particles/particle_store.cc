// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/rank_messages.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/particles/particle_store.h>
#include <graupel/dem/particles/same_rows.h>

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

    constexpr int fetch_tag   = 4104;
    constexpr int deliver_tag = 4105;

    using Coordinates = std::array<double, 3>;

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

  ParticleStore::ParticleStore(VesselMesh &mesh, Subdomains &subdomains)
    : mesh(mesh)
    , subdomains(subdomains)
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
  ParticleStore::find_owners(const std::vector<dealii::Point<3>> &points) const
  {
    const unsigned int            me    = mpi::this_mpi_process(communicator());
    const double                  reach = 0.5 * mesh.smallest_edge();
    std::vector<unsigned int>     owners(points.size(), me);
    std::vector<std::size_t>      away;
    std::vector<dealii::Point<3>> places;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!locate(points[k], reach).found)
        {
          owners[k] = Subdomains::nobody;
          away.push_back(k);
          places.push_back(points[k]);
        }
    if (mpi::n_mpi_processes(communicator()) == 1)
      return owners;

    ByRank<std::vector<Coordinates>> asked;
    ByRank<std::vector<std::size_t>> asked_of;
    const auto                       candidates = subdomains.ranks_at(places);
    for (std::size_t k = 0; k < away.size(); ++k)
      for (const unsigned int rank : candidates[k])
        {
          asked[rank].push_back({{places[k][0], places[k][1], places[k][2]}});
          asked_of[rank].push_back(away[k]);
        }
    using Answer       = std::vector<unsigned char>;
    const auto answers = ask_ranks<Answer, std::vector<Coordinates>>(
      asked,
      [&](const std::vector<Coordinates> &of_points) {
        Answer found;
        for (const Coordinates &x : of_points)
          found.push_back(locate({x[0], x[1], x[2]}, reach).found);
        return found;
      },
      communicator());
    for (const auto &[rank, found] : answers)
      for (std::size_t k = 0; k < found.size(); ++k)
        if (found[k])
          owners[asked_of[rank][k]] = std::min(owners[asked_of[rank][k]], rank);
    return owners;
  }

  void
  ParticleStore::put_down(const Traveller &traveller)
  {
    const Location at = locate(traveller.position, 0.5 * mesh.smallest_edge());
    handler.insert_particle(traveller.position,
                            at.reference,
                            traveller.id,
                            at.cell,
                            dealii::make_array_view(traveller.label));
  }

  void
  ParticleStore::insert(const std::vector<NewParticle> &added, ParticleArrays &p)
  {
    const unsigned int            me = mpi::this_mpi_process(communicator());
    std::vector<dealii::Point<3>> places;
    for (const auto &particle : added)
      places.push_back(particle.position);
    const auto         owners = find_owners(places);
    std::ostringstream text;
    for (std::size_t k = 0; k < added.size() && text.tellp() == 0; ++k)
      if (owners[k] == Subdomains::nobody)
        text << "no cell of the mesh holds the point (" << places[k]
             << ") m where a particle was to be inserted; it must lie in the cylinder";
    throw_together(text.str(), communicator());

    ByRank<std::vector<NewParticle>> parts;
    for (std::size_t k = 0; k < added.size(); ++k)
      parts[owners[k]].push_back(added[k]);
    if (mpi::n_mpi_processes(communicator()) > 1)
      parts = send_parts(parts, communicator());
    for (const auto &[rank, part] : parts)
      for (const NewParticle &particle : part)
        {
          const unsigned int row = p.n_owned++;
          p.resize(p.n_owned);
          p.id[row]   = particle.id;
          p.type[row] = particle.type;
          p.body[row] = {
            particle.position, particle.radius, particle.velocity, particle.spin, {}, {}};
          put_down({static_cast<unsigned int>(particle.id),
                    particle.position,
                    {1. * me, 1. * row_of_label.size()}});
          label_of_row.push_back(row_of_label.size());
          row_of_label.push_back(row);
        }
    std::int64_t number = next_id;
    for (const NewParticle &particle : added)
      number = std::max(number, particle.id + 1);
    number_from(number);
    n_expected += mpi::sum(static_cast<unsigned int>(added.size()), communicator());
  }

  std::vector<std::uint32_t>
  ParticleStore::release(ParticleArrays &p, const std::vector<std::uint32_t> &rows)
  {
    auto new_row = same_rows(p.n_owned);
    // From the last one on, so that what fills a gap stays.
    for (auto row = rows.rbegin(); row != rows.rend(); ++row)
      {
        const std::uint32_t last = --p.n_owned;
        if (label_of_row[*row] != no_row)
          row_of_label[label_of_row[*row]] = no_row;
        if (*row != last)
          {
            p.id[*row]              = p.id[last];
            p.type[*row]            = p.type[last];
            p.body[*row]            = p.body[last];
            p.mass[*row]            = p.mass[last];
            p.load[*row]            = p.load[last];
            p.external_force[*row]  = p.external_force[last];
            p.external_torque[*row] = p.external_torque[last];
            p.solid_fraction[*row]  = p.solid_fraction[last];
            label_of_row[*row]      = label_of_row[last];
            if (label_of_row[*row] != no_row)
              row_of_label[label_of_row[*row]] = *row;
            new_row[last] = *row;
          }
        new_row[*row] = no_row;
        label_of_row.pop_back();
      }
    p.resize(p.n_owned);
    return new_row;
  }

  void
  ParticleStore::accept(ParticleArrays &p, const std::vector<Passenger> &passengers)
  {
    const unsigned int first = p.n_owned;
    p.n_owned += passengers.size();
    p.resize(p.n_owned);
    for (std::size_t k = 0; k < passengers.size(); ++k)
      {
        p.id[first + k] = passengers[k].id;
        unpack(passengers[k].parcel, p, first + k);
      }
    label_of_row.resize(p.n_owned, no_row);
  }

  void
  ParticleStore::begin_with(ParticleArrays               &particles,
                            const std::vector<Passenger> &passengers,
                            const std::int64_t            next_number)
  {
    accept(particles, passengers);
    std::int64_t number = next_number;
    for (const Passenger &passenger : passengers)
      number = std::max(number, passenger.id + 1);
    number_from(number);
    n_expected = mpi::sum(particles.n_owned, communicator());
  }

  void
  ParticleStore::number_from(const std::int64_t number)
  {
    next_id = static_cast<unsigned int>(
      mpi::max(std::max(number, next_number()), communicator()));
  }

  void
  ParticleStore::clear()
  {
    handler.clear_particles();
    cells.clear();
    row_of_label.clear();
    label_of_row.clear();
    n_expected = next_id = 0;
    subdomains.update();
  }

  ParticleStore::Moves
  ParticleStore::migrate(ParticleArrays                   &particles,
                         const ContactsOf                 &contacts_of,
                         const std::vector<std::uint32_t> &departed,
                         const unsigned int                n_departed)
  {
    strays.clear();
    n_expected -= n_departed;
    set_places(particles, departed);
    handler.sort_particles_into_subdomains_and_cells();
    // It has counted all of them on the way.
    if (handler.n_global_particles() == n_expected)
      return collect(particles, contacts_of, true);
    bring_home_strays();
    return collect(particles, contacts_of, false);
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
    subdomains.update();
    check_count();
    return collect(particles, contacts_of, false);
  }

  void
  ParticleStore::set_places(const ParticleArrays             &particles,
                            const std::vector<std::uint32_t> &departed)
  {
    const unsigned int         me = mpi::this_mpi_process(communicator());
    std::vector<unsigned char> gone(particles.n_owned, 0);
    for (const auto row : departed)
      gone[row] = 1;

    // deal.II loses, without a signal, a particle that has crossed more than one
    // layer of cells on its way to another rank: those that went far, and those that
    // came here without the handler, are searched for.
    const double           reach = mpi::n_mpi_processes(communicator()) > 1
                                     ? longest_way * mesh.smallest_edge()
                                     : std::numeric_limits<double>::infinity();
    std::vector<Traveller> travellers;
    const auto             sets_out = [&](const auto row) {
      travellers.push_back({static_cast<unsigned int>(particles.id[row]),
                            particles.body[row].position,
                            {1. * me, 1. * row}});
    };
    std::vector<dealii::Particles::ParticleIterator<3>> to_remove;
    for (auto particle = handler.begin(); particle != handler.end(); ++particle)
      {
        const auto          label = particle->get_properties();
        const std::uint32_t row =
          row_of_label[static_cast<std::uint32_t>(label[holders_row])];
        if (row == no_row || gone[row])
          {
            to_remove.push_back(particle);
            continue;
          }
        const auto place   = particles.body[row].position;
        label[holders_row] = row;
        if (place.distance(particle->get_location()) > reach)
          {
            to_remove.push_back(particle);
            sets_out(row);
          }
        else
          particle->set_location(place);
      }
    // They come in ascending order within a cell: the last of them first.
    for (auto particle = to_remove.rbegin(); particle != to_remove.rend(); ++particle)
      handler.remove_particle(*particle);

    for (std::uint32_t row = 0; row < particles.n_owned; ++row)
      if (label_of_row[row] == no_row && !gone[row])
        sets_out(row);
    for (const Traveller &traveller : travellers)
      if (locate(traveller.position, 0.5 * mesh.smallest_edge()).found)
        put_down(traveller);
      else
        strays.push_back(traveller);
  }

  ParticleStore::Moves
  ParticleStore::collect(ParticleArrays   &particles,
                         const ContactsOf &contacts_of,
                         const bool        from_neighbors)
  {
    const unsigned int me = mpi::this_mpi_process(communicator());
    const unsigned int n  = handler.n_locally_owned_particles();

    // For each new row the old one, and what is to be fetched from which rank.
    std::vector<std::uint32_t>         old_row(n, no_row);
    std::vector<std::int64_t>          ids(n);
    ByRank<std::vector<std::uint32_t>> wanted, awaited;
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

    const auto deliver = [&](const std::vector<std::uint32_t> &rows) {
      Delivery delivery;
      for (const auto leaving : rows)
        delivery.parcels.push_back(pack(particles, leaving));
      delivery.contacts = contacts_of(rows);
      return delivery;
    };
    ByRank<Delivery> received;
    if (from_neighbors)
      {
        const auto       neighbors = mesh.triangulation().ghost_owners();
        ByRank<Delivery> sent;
        for (const auto &[rank, rows] :
             send_to_neighbors(neighbors, wanted, fetch_tag, communicator()))
          sent[rank] = deliver(rows);
        received = send_to_neighbors(neighbors, sent, deliver_tag, communicator());
      }
    else if (mpi::n_mpi_processes(communicator()) > 1)
      received =
        ask_ranks<Delivery, std::vector<std::uint32_t>>(wanted, deliver, communicator());

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
    rearrange(particles.solid_fraction, old_row);
    particles.n_owned = n;
    row_of_label = label_of_row = same_rows(n);
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
    std::vector<dealii::Point<3>> places;
    for (const Traveller &stray : strays)
      places.push_back(stray.position);
    const auto                     owners = find_owners(places);
    ByRank<std::vector<Traveller>> parts;
    std::ostringstream             text;
    for (std::size_t k = 0; k < strays.size() && text.tellp() == 0; ++k)
      if (owners[k] == Subdomains::nobody)
        text << "particle " << strays[k].id << " was lost at (" << places[k]
             << ") m, outside of the cylinder; a smaller substep or a stiffer wall "
                "keeps it in";
      else
        parts[owners[k]].push_back(strays[k]);
    throw_together(text.str(), communicator());
    strays.clear();
    if (mpi::n_mpi_processes(communicator()) > 1)
      parts = send_parts(parts, communicator());
    for (const auto &[rank, part] : parts)
      for (const Traveller &traveller : part)
        put_down(traveller);
    check_count();
  }

  void
  ParticleStore::check_count()
  {
    // It forgets to count what was inserted or removed one by one.
    handler.update_cached_numbers();
    if (handler.n_global_particles() == n_expected)
      return;

    // Each rank counts the copies of an even share of the ids.
    const unsigned int n_ranks = mpi::n_mpi_processes(communicator());
    const unsigned int share   = next_id / n_ranks + 1;
    const unsigned int first   = share * mpi::this_mpi_process(communicator());
    ByRank<std::vector<unsigned int>> ids;
    for (const auto &particle : handler)
      ids[particle.get_id() / share].push_back(particle.get_id());
    std::vector<unsigned char> copies(std::min(share, next_id - std::min(first, next_id)),
                                      0);
    for (const auto &[rank, of_rank] : send_parts(ids, communicator()))
      for (const auto id : of_rank)
        copies[id - first] = std::min(2, copies[id - first] + 1);
    const auto n_with = [&](const unsigned char n) {
      return mpi::sum(
        static_cast<unsigned int>(std::count(copies.begin(), copies.end(), n)),
        communicator());
    };
    throw DemError("particles were lost or doubled on their way between ranks: of " +
                   std::to_string(next_id) + " ever inserted " +
                   std::to_string(n_with(0)) + " are missing and " +
                   std::to_string(n_with(2)) + " are double, where " +
                   std::to_string(n_expected) + " should be in the vessel");
  }

  void
  ParticleStore::visit_cells(const CellVisitor &visit) const
  {
    for (const auto &cell_rows : cells)
      visit(cell_rows.cell, cell_rows.first_row, cell_rows.reference_locations);
  }
} // namespace graupel
