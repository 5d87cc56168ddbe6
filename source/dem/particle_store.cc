#include <graupel/dem/dem_error.h>
#include <graupel/dem/particle_store.h>

#include <deal.II/grid/grid_tools.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // Where each quantity stands among the properties of a particle.
    enum Property : unsigned int
    {
      radius         = 0,
      velocity       = 1,
      spin           = 4,
      force          = 7,
      torque         = 10,
      external_force = 13,
      springs        = 16,
      n_properties   = springs + SpringTable::n_numbers
    };

    // How far outside of the unit cell a point may lie by the rounding of the
    // mapping's inverse [-].
    constexpr double unit_cell_tolerance = 1e-7;

    void
    put(double *numbers, const dealii::Tensor<1, 3> &vector)
    {
      for (unsigned int d = 0; d < 3; ++d)
        numbers[d] = vector[d];
    }

    dealii::Tensor<1, 3>
    get(const double *numbers)
    {
      return dealii::Tensor<1, 3>({numbers[0], numbers[1], numbers[2]});
    }
  } // namespace

  ParticleStore::ParticleStore(const CylinderMesh &mesh, const double density)
    : mesh(mesh)
    , density(density)
    , cache(mesh.triangulation(), mesh.mapping())
    , handler(mesh.triangulation(), mesh.mapping(), n_properties)
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

  std::vector<bool>
  ParticleStore::place(const std::vector<Traveller> &travellers)
  {
    namespace mpi             = dealii::Utilities::MPI;
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

    std::vector<bool> placed(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        placed[k] = owners[k] != nobody;
        if (owners[k] == me)
          handler.insert_particle(travellers[k].position,
                                  locations[k].reference,
                                  travellers[k].id,
                                  locations[k].cell,
                                  dealii::make_array_view(travellers[k].properties));
      }
    handler.update_cached_numbers();
    return placed;
  }

  void
  ParticleStore::insert(const std::vector<dealii::Point<3>> &positions,
                        const double                         sphere_radius,
                        const dealii::Tensor<1, 3>          &start_velocity)
  {
    std::vector<double> properties(n_properties, 0.);
    properties[radius] = sphere_radius;
    put(&properties[velocity], start_velocity);

    std::vector<Traveller> travellers;
    for (const auto &position : positions)
      travellers.push_back({next_id++, position, properties});
    const auto placed = place(travellers);
    for (std::size_t k = 0; k < placed.size(); ++k)
      if (!placed[k])
        {
          std::ostringstream text;
          text << "no cell of the mesh holds the point (" << positions[k]
               << ") m where a particle was to be inserted; it must lie in the cylinder";
          throw DemError(text.str());
        }
    n_expected += positions.size();
    check_count();
  }

  void
  ParticleStore::migrate()
  {
    strays.clear();
    handler.sort_particles_into_subdomains_and_cells();
    bring_home_strays();
    check_count();
  }

  void
  ParticleStore::bring_home_strays()
  {
    // deal.II gives up a particle that lies, within rounding, on the face of two
    // cells, or that went further than the cells next to its own.
    namespace mpi = dealii::Utilities::MPI;
    if (mpi::sum(static_cast<unsigned int>(strays.size()), communicator()) == 0)
      return;

    std::vector<Traveller> all;
    for (const auto &of_rank : mpi::all_gather(communicator(), strays))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    const auto placed = place(all);
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!placed[k])
        {
          std::ostringstream text;
          text << "particle " << all[k].id << " was lost at (" << all[k].position
               << ") m, outside of the cylinder; a smaller substep or a stiffer wall "
                  "keeps it in";
          throw DemError(text.str());
        }
  }

  void
  ParticleStore::check_count() const
  {
    namespace mpi = dealii::Utilities::MPI;
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
    const auto culprit = std::find_if(copies.begin(),
                                      copies.end(),
                                      [](const unsigned int n) { return n != 1; }) -
                         copies.begin();

    std::string message;
    for (const auto &[id, position] : last_places)
      if (id == culprit)
        {
          std::ostringstream text;
          text
            << "particle " << id << " was " << (copies[id] == 0 ? "lost" : "doubled")
            << " on its way to another rank; it came from (" << position
            << ") m. It moved too far between two migrations: try a smaller substep or "
               "larger cells";
          message = text.str();
        }
    throw_together(message, communicator());
    throw DemError("particles were lost: particle " + std::to_string(culprit) +
                   " is missing");
  }

  void
  ParticleStore::gather(ParticleArrays &p, SpringTable &table)
  {
    const unsigned int n = handler.n_locally_owned_particles();
    p.n_owned            = n;
    p.resize(n);
    table.reset(n);
    cells.clear();

    unsigned int row = 0;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      {
        if (!cell->is_locally_owned() || handler.n_particles_in_cell(cell) == 0)
          continue;
        cells.push_back({cell, row, {}});
        for (const auto &particle : handler.particles_in_cell(cell))
          {
            const auto properties = particle.get_properties();
            p.id[row]             = particle.get_id();
            p.position[row]       = particle.get_location();
            p.velocity[row]       = get(&properties[velocity]);
            p.spin[row]           = get(&properties[spin]);
            p.force[row]          = get(&properties[force]);
            p.torque[row]         = get(&properties[torque]);
            p.external_force[row] = get(&properties[external_force]);
            p.set_sphere(row, properties[radius], density);
            table.unpack(row, &properties[springs]);
            cells.back().reference_locations.push_back(particle.get_reference_location());
            ++row;
          }
      }
  }

  void
  ParticleStore::scatter(const ParticleArrays &p, const SpringTable &table)
  {
    last_places.clear();
    unsigned int row = 0;
    for (const auto &cell_rows : cells)
      for (auto &particle : handler.particles_in_cell(cell_rows.cell))
        {
          const auto properties = particle.get_properties();
          last_places.emplace_back(p.id[row], particle.get_location());
          particle.set_location(p.position[row]);
          properties[radius] = p.radius[row];
          put(&properties[velocity], p.velocity[row]);
          put(&properties[spin], p.spin[row]);
          put(&properties[force], p.force[row]);
          put(&properties[torque], p.torque[row]);
          put(&properties[external_force], p.external_force[row]);
          table.pack(row, &properties[springs]);
          ++row;
        }
  }

  void
  ParticleStore::visit_cells(const CellVisitor &visit) const
  {
    for (const auto &cell_rows : cells)
      visit(cell_rows.cell, cell_rows.first_row, cell_rows.reference_locations);
  }
} // namespace graupel
