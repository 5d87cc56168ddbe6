#include <graupel/dem/dem.h>
#include <graupel/dem/numbers/exact_sum.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/vessel/mesh_planes.h>

#include <limits>
#include <numeric>

namespace graupel
{
  namespace
  {
    using Vector              = dealii::Tensor<1, 3>;
    namespace mpi             = dealii::Utilities::MPI;
    constexpr double infinity = std::numeric_limits<double>::infinity();

    // Skin of the near pairs, over the radius of a particle.
    constexpr double relative_near_skin = 0.25;

    // Ranks may differ by this much in their particles.
    constexpr double tolerated_imbalance = 0.1;
    // Of a particle in the division of the mesh among the ranks.
    constexpr unsigned int particle_weight = 1000;

    std::vector<std::uint32_t>
    same_rows(const unsigned int n)
    {
      std::vector<std::uint32_t> rows(n);
      std::iota(rows.begin(), rows.end(), 0u);
      return rows;
    }

    // Whether some vector is not zero; one that is no number is none.
    bool
    any(const std::vector<Vector> &vectors)
    {
      return std::any_of(vectors.begin(), vectors.end(), [](const Vector &x) {
        return !(x.norm_square() == 0.);
      });
    }

    double
    translational_energy(const ParticleArrays &p, const unsigned int i)
    {
      return 0.5 * p.mass[i] * p.body[i].velocity.norm_square();
    }

    double
    kinetic_energy(const ParticleArrays &p, const unsigned int i)
    {
      const double r = p.body[i].radius;
      return translational_energy(p, i) +
             0.2 * p.mass[i] * r * r * p.body[i].spin.norm_square();
    }

    // Mean over the particles of all ranks, the same on any number of ranks.
    template <class Quantity>
    double
    mean(const ParticleArrays &p, const Quantity &quantity, const MPI_Comm communicator)
    {
      double largest = 0.;
      for (unsigned int i = 0; i < p.n_owned; ++i)
        largest = std::max(largest, quantity(p, i));
      ExactSum sum(mpi::max(largest, communicator));
      for (unsigned int i = 0; i < p.n_owned; ++i)
        sum.add(quantity(p, i));
      return sum.total(communicator) / std::max(1u, mpi::sum(p.n_owned, communicator));
    }
  } // namespace

  Dem::Dem(const DemParameters &parameters, VesselMesh &mesh, CostSheet &costs)
    : input(parameters)
    , mesh(mesh)
    , costs(costs)
    , longest_substep(input.substep())
    , skin(input.contact.skin * 2. * input.largest_radius())
    , near_skin(std::min(0.5 * skin, relative_near_skin * input.largest_radius()))
    , walls(all_walls(input.walls, mesh))
    , shape(mesh, walls)
    , materials(input.materials(false, walls))
    , gravity(input.gravity())
    , particle_store(mesh)
    , halo(mesh.cylinder(),
           2. * (1. + ParticleType::size_tolerance) * input.largest_radius() + skin,
           input.walls.is_periodic(),
           mesh.communicator())
    , list(skin, near_skin)
    , contacts(input.normal_law(),
               input.rolling_law(),
               materials.n_types(),
               walls.size(),
               input.reference_force(),
               input.largest_radius())
    , wall_loads(walls.size())
    , number_by_type(materials.n_types(), 0)
    , departed_by_type(materials.n_types(), 0)
    , volume_by_type(materials.n_types(), 0.)
    , departed_volume(materials.n_types(), 0.)
  {
  }

  void
  Dem::insert(const std::vector<dealii::Point<3>> &positions, const Vector &velocity)
  {
    const auto   type   = input.types().front();
    const double radius = 0.5 * type.scale * type.sizes.sauter_diameter(type.diameter);
    std::vector<NewParticle> added;
    for (const auto &position : positions)
      added.push_back({position, radius, velocity, Vector(), 0});
    insert(added);
  }

  void
  Dem::check_sizes(const std::vector<NewParticle> &added) const
  {
    const auto types = input.types();
    for (std::size_t k = 0; k < added.size(); ++k)
      if (const auto problem = problem_of_size(added[k], types); !problem.empty())
        throw DemError("particle " + std::to_string(added[k].id < 0 ? k : added[k].id) +
                       (added[k].id < 0 ? " of those to be inserted: " : ": ") + problem);
  }

  void
  Dem::insert(const std::vector<NewParticle> &added)
  {
    check_sizes(added);
    check_places(added);
    // The ghosts make room; the contacts with them find them again by their ids.
    const auto         old_ids     = arrays.id;
    const unsigned int old_n_owned = arrays.n_owned;
    arrays.resize(arrays.n_owned);
    particle_store.insert(added, arrays);
    for (unsigned int row = old_n_owned; row < arrays.n_owned; ++row)
      arrays.mass[row] =
        materials.density[arrays.type[row]] * sphere_volume(arrays.body[row].radius);
    for (const auto &particle : added)
      {
        volume_by_type[particle.type] += sphere_volume(particle.radius);
        ++number_by_type[particle.type];
      }
    if (halo.is_needed())
      {
        auto loose = contacts.renumber(old_ids, same_rows(old_n_owned));
        halo.rebuild(arrays);
        contacts.add(arrays, std::move(loose));
      }
    list_is_valid = false;
  }

  void
  Dem::synchronise()
  {
    CostSheet::Scope scope(costs, CostSheet::neighbor);
    wrap();
    const auto departed = departed_rows();
    const auto old_ids  = arrays.id;
    follow(old_ids, particle_store.migrate(arrays, contacts_of(), departed));
  }

  void
  Dem::wrap()
  {
    if (!input.walls.is_periodic())
      return;
    const double height  = mesh.cylinder().height;
    const auto   outside = [&](const unsigned int i) {
      const double z = arrays.body[i].position[2];
      return z < 0. || z >= height;
    };
    unsigned int n_outside = 0;
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      n_outside += outside(i);
    if (mpi::sum(n_outside, communicator()) == 0)
      return;

    // Pairs become neighbours through the end, or no more: find all partners anew.
    auto loose = contacts.contacts_of(arrays, same_rows(arrays.n_owned));
    contacts.clear();
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      if (outside(i))
        arrays.body[i].position[2] += arrays.body[i].position[2] < 0. ? height : -height;
    halo.rebuild(arrays);
    contacts.add(arrays, std::move(loose));
    list_is_valid = false;
  }

  std::vector<std::uint32_t>
  Dem::departed_rows()
  {
    std::vector<std::uint32_t> departed;
    if (!input.walls.is_open())
      return departed;
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      {
        const double z = arrays.body[i].position[2];
        if ((z < 0. && input.walls.bottom == "open") ||
            (z > mesh.cylinder().height && input.walls.top == "open"))
          departed.push_back(i);
      }
    count_departed(departed);
    return departed;
  }

  void
  Dem::count_departed(const std::vector<std::uint32_t> &departed)
  {
    std::vector<unsigned long> n_gone(number_by_type.size(), 0);
    // What is left, in an order of sum that no number of ranks changes.
    std::vector<ExactSum> gone(number_by_type.size(),
                               ExactSum(sphere_volume(input.largest_radius())));
    for (const auto i : departed)
      {
        ++n_gone[arrays.type[i]];
        gone[arrays.type[i]].add(sphere_volume(arrays.body[i].radius));
      }
    mpi::sum(n_gone, communicator(), n_gone);
    if (std::accumulate(n_gone.begin(), n_gone.end(), 0ul) == 0)
      return;

    const auto volume = ExactSum::totals(gone, communicator());
    for (unsigned int type = 0; type < n_gone.size(); ++type)
      {
        departed_by_type[type] += n_gone[type];
        number_by_type[type] -= n_gone[type];
        departed_volume[type] += volume[type];
        volume_by_type[type] =
          number_by_type[type] > 0 ? volume_by_type[type] - volume[type] : 0.;
      }
  }

  bool
  Dem::balance(const double cell_share)
  {
    CostSheet::Scope   scope(costs, CostSheet::neighbor);
    const unsigned int n_ranks = mpi::n_mpi_processes(communicator());
    const double cells = cell_share * mesh.triangulation().n_locally_owned_active_cells();
    const double mine  = arrays.n_owned + cells;
    const double most  = mpi::max(mine, communicator());
    const double mean  = mpi::sum(mine, communicator()) / n_ranks;
    if (most <= (1. + tolerated_imbalance) * mean)
      return false;
    synchronise();
    const auto old_ids = arrays.id;
    follow(old_ids,
           particle_store.repartition(
             arrays, contacts_of(), cell_weight(cell_share), particle_weight));
    return true;
  }

  void
  Dem::adapt_mesh(const double cell_share)
  {
    CostSheet::Scope scope(costs, CostSheet::mesh);
    synchronise();
    const auto old_ids = arrays.id;
    follow(old_ids,
           particle_store.adapt(
             arrays, contacts_of(), cell_weight(cell_share), particle_weight));
  }

  unsigned int
  Dem::cell_weight(const double cell_share) const
  {
    return std::max(1u, static_cast<unsigned int>(cell_share * particle_weight));
  }

  ParticleStore::ContactsOf
  Dem::contacts_of() const
  {
    return [this](const std::vector<std::uint32_t> &rows) {
      return contacts.contacts_of(arrays, rows);
    };
  }

  void
  Dem::follow(const std::vector<std::int64_t> &old_ids, ParticleStore::Moves moves)
  {
    auto loose = contacts.renumber(old_ids, moves.new_row);
    loose.insert(loose.end(), moves.arrived.begin(), moves.arrived.end());
    halo.rebuild(arrays);
    contacts.add(arrays, std::move(loose));
    list.clear();
    list_is_valid = false;
  }

  void
  Dem::use_packing_materials(const bool of_packing)
  {
    packing   = of_packing;
    materials = input.materials(packing, walls);
  }

  void
  Dem::set_friction(const double particles, const double with_walls)
  {
    for (auto &pair : materials.particles)
      pair.friction = particles;
    for (auto &pair : materials.walls)
      pair.friction = with_walls;
  }

  Integration
  Dem::integration(const double dt) const
  {
    return {contacts.quanta(), gravity, dt, external_forces, external_torques};
  }

  void
  Dem::advance(const double duration)
  {
    // A duration that is a whole number of substeps but for rounding must not
    // cost one more.
    const auto n =
      static_cast<unsigned int>(std::ceil(duration / longest_substep - 1e-9));
    const auto dt = duration / std::max(1u, n);

    external_forces  = any(arrays.external_force);
    external_torques = any(arrays.external_torque);
    contacts.reset_wall_loads();
    const Clock begin = time;
    for (unsigned int s = 0; s < n; ++s)
      {
        substep_by(dt, s == 0);
        if (begin)
          time = *begin + (s + 1 == n ? duration : (s + 1) * dt);
      }
    if (n > 0)
      {
        CostSheet::Scope scope(costs, CostSheet::contact);
        kick(arrays, integration(dt));
      }

    shape.follow(walls);
    wall_loads = contacts.wall_loads(communicator());
    for (auto &load : wall_loads)
      {
        load.force /= std::max(1u, n);
        load.torque /= std::max(1u, n);
      }
    if (input.walls.is_open())
      remove_departed();
    // A failure in the last substep was not yet told to the other ranks.
    throw_together(contacts.failure(arrays, walls), communicator());
  }

  void
  Dem::remove_departed()
  {
    unsigned int n_outside = 0;
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      {
        const double z = arrays.body[i].position[2];
        n_outside += z < 0. || z > mesh.cylinder().height;
      }
    if (mpi::sum(n_outside, communicator()) > 0)
      synchronise();
  }

  void
  Dem::substep_by(const double dt, const bool first)
  {
    // One number tells all ranks both how far particles go and whether some rank
    // must stop.
    double speed_square = infinity;
    if (!contacts.failed())
      {
        CostSheet::Scope scope(costs, CostSheet::contact);
        speed_square = first ? drift(arrays, integration(dt))
                             : kick_and_drift(arrays, integration(dt));
      }
    {
      CostSheet::Scope scope(costs, CostSheet::halo);
      speed_square = mpi::max(speed_square, communicator());
    }
    if (speed_square == infinity)
      throw_together(first_problem(), communicator());
    const double moved = dt * std::sqrt(speed_square);
    moved_since_list += moved;
    moved_since_sort += moved;

    move_walls(dt);
    update_neighbors();
    CostSheet::Scope scope(costs, CostSheet::contact);
    contacts.sweep(arrays, list, walls, materials, dt);
    costs.particle_steps += arrays.n_owned;
    costs.contact_steps += contacts.n_contacts();
  }

  void
  Dem::update_neighbors()
  {
    // Rounding must not let a pair slip through.
    const double half_skin = 0.4999 * skin, half_near_skin = 0.4999 * near_skin;
    if (list_is_valid && moved_since_list >= half_skin)
      {
        // The bound adds up the fastest particle of each substep.
        CostSheet::Scope scope(costs, CostSheet::neighbor);
        moved_since_list =
          mpi::max(list.largest_move(arrays), communicator()) + walls_moved_since_list;
        list_is_valid = moved_since_list < 0.8 * half_skin;
      }
    if (!list_is_valid)
      return list_neighbors();
    {
      CostSheet::Scope scope(costs, CostSheet::halo);
      halo.refresh(arrays);
    }
    if (moved_since_sort >= half_near_skin)
      {
        CostSheet::Scope scope(costs, CostSheet::neighbor);
        list.sort_by_distance(arrays);
        moved_since_sort = 0.;
      }
  }

  std::string
  Dem::first_problem() const
  {
    if (contacts.failed())
      return contacts.failure(arrays, walls);
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      if (!std::isfinite(arrays.body[i].position.norm_square()))
        return "particle " + std::to_string(arrays.id[i]) +
               " has no finite position any more; is the force from outside finite?";
    return {};
  }

  void
  Dem::list_neighbors()
  {
    wrap();
    if (halo.is_needed())
      {
        CostSheet::Scope scope(costs, CostSheet::halo);
        auto             loose = contacts.renumber(arrays.id, same_rows(arrays.n_owned));
        halo.rebuild(arrays);
        contacts.add(arrays, std::move(loose));
      }
    CostSheet::Scope scope(costs, CostSheet::neighbor);
    contacts.sort();
    list.build(arrays, walls, contacts.touching_rows(arrays.n_rows()));
    contacts.watch_walls(list, walls);
    moved_since_list       = mpi::max(list.largest_move(arrays), communicator());
    moved_since_sort       = 0.;
    walls_moved_since_list = 0.;
    list_is_valid          = true;
    ++list_builds;
  }

  double
  Dem::original_sauter_diameter() const
  {
    const auto types = input.types();
    // Exact sums, as the division among ranks must not show, with the same quantum: of
    // equal spheres the mean is exactly their diameter.
    double smallest = std::numeric_limits<double>::max();
    for (const auto &type : types)
      smallest = std::min(smallest, 2. * type.smallest_radius() / type.scale);
    ExactSum solid(sphere_volume(input.largest_radius())), in_smallest(solid);
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      {
        const double radius = arrays.body[i].radius, volume = sphere_volume(radius);
        const double original = 2. * radius / types[arrays.type[i]].scale;
        solid.add(volume);
        in_smallest.add(volume * std::min(1., smallest / original));
      }
    const auto sums = ExactSum::totals({solid, in_smallest}, communicator());
    return sums[1] > 0. ? smallest * (sums[0] / sums[1]) : input.mean_original_diameter();
  }

  double
  Dem::solid_volume() const
  {
    return std::accumulate(volume_by_type.begin(), volume_by_type.end(), 0.);
  }

  double
  Dem::solid_mass() const
  {
    return std::inner_product(
      volume_by_type.begin(), volume_by_type.end(), materials.density.begin(), 0.);
  }

  double
  Dem::mean_density() const
  {
    const double volume = solid_volume();
    return volume > 0. ? solid_mass() / volume : materials.density[0];
  }

  std::vector<double>
  Dem::departed_mass() const
  {
    auto mass = departed_volume;
    for (unsigned int type = 0; type < mass.size(); ++type)
      mass[type] *= materials.density[type];
    return mass;
  }

  unsigned long
  Dem::n_departed() const
  {
    return std::accumulate(departed_by_type.begin(), departed_by_type.end(), 0ul);
  }

  double
  Dem::weight() const
  {
    return solid_mass() * input.particles.gravity;
  }

  double
  Dem::maximum_speed() const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      largest = std::max(largest, arrays.body[i].velocity.norm_square());
    return std::sqrt(mpi::max(largest, communicator()));
  }

  double
  Dem::mean_kinetic_energy() const
  {
    return mean(arrays, kinetic_energy, communicator());
  }

  double
  Dem::mean_translational_energy() const
  {
    return mean(arrays, translational_energy, communicator());
  }

  double
  Dem::coordination_number() const
  {
    // Each pair counts for both of its partners, on the rank of its lower id.
    return 2. *
           mpi::sum(static_cast<double>(contacts.n_touching_pairs(arrays)),
                    communicator()) /
           std::max(1u, n_global());
  }
} // namespace graupel
