// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/dem.h>
#include <graupel/dem/numbers/exact_sum.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/particles/same_rows.h>
#include <graupel/dem/vessel/mesh_planes.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

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

    // All that one rank hands over to another between two migrations.
    struct HandOver
    {
      std::vector<ParticleStore::Passenger> passengers;
      std::vector<LooseContact>             contacts;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &passengers &contacts;
      }
    };

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
    , ends(input.walls.is_periodic() ? Period(mesh.cylinder().height) : Period())
    , subdomains(mesh,
                 2. * (1. + ParticleType::size_tolerance) * input.largest_radius() +
                   (1. + 2. * VerletList::moving_part) * skin,
                 ends)
    , particle_store(mesh, subdomains)
    , halo(subdomains, ends, mesh.communicator())
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

  std::string
  Dem::problem_of(const std::vector<NewParticle> &added) const
  {
    const auto types = input.types();
    for (std::size_t k = 0; k < added.size(); ++k)
      if (const auto problem = problem_of_size(added[k], types); !problem.empty())
        return "particle " + std::to_string(added[k].id < 0 ? k : added[k].id) +
               (added[k].id < 0 ? " of those to be inserted: " : ": ") + problem;
    return problem_of_places(added);
  }

  Dem::Batch::Batch(const Dem &dem)
    : dem(&dem)
    , next_id(dem.particle_store.next_number())
    , number(dem.number_by_type)
    , volume(dem.volume_by_type)
  {
  }

  void
  Dem::Batch::add(const NewParticle &particle)
  {
    const std::int64_t id = particle.id < 0 ? next_id : particle.id;
    next_id               = std::max(next_id, id + 1);
    volume[particle.type] += sphere_volume(particle.radius);
    ++number[particle.type];
    if (dem->subdomains.keeper(particle.position) !=
        mpi::this_mpi_process(dem->communicator()))
      return;
    share.push_back(particle);
    share.back().id          = id;
    share.back().position[2] = dem->ends.rounded(particle.position[2]);
  }

  void
  Dem::insert(const std::vector<NewParticle> &added)
  {
    if (const auto problem = problem_of(added); !problem.empty())
      throw DemError(problem);
    Batch batch(*this);
    for (const NewParticle &particle : added)
      batch.add(particle);
    insert(batch);
  }

  void
  Dem::insert(const Batch &batch)
  {
    // The ghosts make room; the contacts with them find them again by their ids.
    const unsigned int old_n_owned = arrays.n_owned;
    loosen_contacts(arrays.id, same_rows(old_n_owned));
    arrays.resize(arrays.n_owned);
    particle_store.insert(batch.share, arrays);
    for (unsigned int row = old_n_owned; row < arrays.n_owned; ++row)
      arrays.mass[row] =
        materials.density[arrays.type[row]] * sphere_volume(arrays.body[row].radius);
    number_by_type = batch.number;
    volume_by_type = batch.volume;
    find_ghosts();
  }

  void
  Dem::synchronise()
  {
    migrate({}, 0);
  }

  void
  Dem::migrate(const std::vector<std::uint32_t> &departed, const unsigned int n_departed)
  {
    CostSheet::Scope scope(costs, CostSheet::neighbor);
    const bool       jumps   = bring_within(true);
    const auto       old_ids = arrays.id;
    auto moves = particle_store.migrate(arrays, contacts_of(), departed, n_departed);
    if (jumps)
      contacts.clear();
    follow(old_ids, std::move(moves));
  }

  bool
  Dem::bring_within(const bool all)
  {
    if (!ends.exists())
      return false;
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < arrays.n_owned; ++i)
      {
        auto inside = arrays.body[i].position;
        inside[2]   = ends.within(inside[2]);
        if (inside[2] == arrays.body[i].position[2])
          continue;
        const auto *at = subdomains.surroundings(inside);
        if (all || (at != nullptr && at->is_home))
          rows.push_back(i);
      }
    if (rows.empty())
      return false;
    // Pairs become neighbours through the end, or no more: all partners are found anew.
    const auto of_own = contacts.contacts_of(arrays, same_rows(arrays.n_owned));
    loose.insert(loose.end(), of_own.begin(), of_own.end());
    for (const auto i : rows)
      arrays.body[i].position[2] = ends.within(arrays.body[i].position[2]);
    halo.expect_jumps();
    return true;
  }

  std::vector<std::uint32_t>
  Dem::departed_rows() const
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
    return departed;
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
    auto       moves   = particle_store.repartition(
      arrays, contacts_of(), cell_weight(cell_share), particle_weight);
    halo.reset();
    follow(old_ids, std::move(moves));
    return true;
  }

  void
  Dem::adapt_mesh(const double cell_share)
  {
    CostSheet::Scope scope(costs, CostSheet::mesh);
    synchronise();
    const auto old_ids = arrays.id;
    auto       moves   = particle_store.adapt(
      arrays, contacts_of(), cell_weight(cell_share), particle_weight);
    halo.reset();
    follow(old_ids, std::move(moves));
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
    loosen_contacts(old_ids, moves.new_row);
    loose.insert(loose.end(), moves.arrived.begin(), moves.arrived.end());
    list.clear();
    find_ghosts();
  }

  void
  Dem::loosen_contacts(const std::vector<std::int64_t>  &old_ids,
                       const std::vector<std::uint32_t> &new_row)
  {
    const auto added = contacts.renumber(old_ids, new_row);
    loose.insert(loose.end(), added.begin(), added.end());
  }

  void
  Dem::find_ghosts()
  {
    list_is_valid = false;
    if (halo.is_needed())
      {
        const std::string problem = halo.select(arrays);
        AssertThrow(problem.empty(), dealii::ExcMessage(problem));
        // They are where they belong, or about to be brought there.
        halo.leaving.clear();
        halo.exchange(arrays, {});
      }
    place_ghosts();
  }

  void
  Dem::place_ghosts()
  {
    loosen_contacts(arrays.id, same_rows(arrays.n_owned));
    halo.place_ghosts(arrays);
    contacts.add(arrays, std::move(loose));
    loose.clear();
    ghosts_are_placed = true;
    list_is_valid     = false;
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
    return {contacts.quanta(), gravity, dt, external_forces, external_torques, ends};
  }

  void
  Dem::advance(const double duration)
  {
    // A duration that is a whole number of substeps but for rounding must not
    // cost one more.
    const auto n =
      static_cast<unsigned int>(std::ceil(duration / longest_substep - 1e-9));
    const auto dt = duration / std::max(1u, n);

    look_at_external_forces();
    contacts.reset_wall_loads();
    stopped.reset();
    const Clock begin = time;
    for (substep_number = 0; substep_number < n; ++substep_number)
      {
        substep_by(dt);
        if (begin)
          time =
            *begin + (substep_number + 1 == n ? duration : (substep_number + 1) * dt);
        // Neighbours wait for a rank that has stopped.
        if (stopped && !halo.is_needed())
          break;
      }
    if (n > 0 && !stopped)
      {
        CostSheet::Scope scope(costs, CostSheet::contact);
        kick(arrays, integration(dt));
      }
    // Between two advances nobody is beyond a periodic end: those that belong to another
    // rank there are given to it, and then all find their ghosts.
    for (unsigned int pass = 0; pass < 2 && ends.exists(); ++pass)
      {
        take_over();
        list_is_valid = false;
        meet_neighbors(0.);
      }
    shape.follow(walls);
    add_up(n);
  }

  void
  Dem::add_up(const unsigned int n)
  {
    // Whole numbers, all in one sum over the ranks: loads of the walls; what has left,
    // by type, its number and its volume in an order of sum that no number of ranks
    // changes; ranks that have stopped.
    std::vector<std::int64_t> sums     = contacts.load_quanta();
    const std::size_t         n_loads  = sums.size();
    const std::size_t         n_types  = number_by_type.size();
    const auto                departed = departed_rows();
    std::vector<std::int64_t> n_gone(n_types, 0);
    std::vector<ExactSum> gone(n_types, ExactSum(sphere_volume(input.largest_radius())));
    for (const auto i : departed)
      {
        ++n_gone[arrays.type[i]];
        gone[arrays.type[i]].add(sphere_volume(arrays.body[i].radius));
      }
    sums.insert(sums.end(), n_gone.begin(), n_gone.end());
    for (const auto &volume : gone)
      sums.push_back(volume.whole());
    sums.push_back(stopped.has_value());
    mpi::sum(sums, communicator(), sums);

    if (sums.back() > 0)
      throw_first_problem();
    wall_loads       = contacts.wall_loads(sums, std::max(1u, n));
    const auto begin = sums.begin() + n_loads;
    const auto n_all = std::accumulate(begin, begin + n_types, std::int64_t(0));
    if (n_all == 0)
      return;
    for (unsigned int type = 0; type < n_types; ++type)
      {
        const double volume = gone[type].value_of(begin[n_types + type]);
        departed_by_type[type] += begin[type];
        number_by_type[type] -= begin[type];
        departed_volume[type] += volume;
        volume_by_type[type] =
          number_by_type[type] > 0 ? volume_by_type[type] - volume : 0.;
      }
    migrate(departed, n_all);
  }

  void
  Dem::stop(const std::string &problem)
  {
    if (!stopped)
      stopped = Stop{substep_number, problem};
  }

  void
  Dem::throw_first_problem() const
  {
    // Of the earliest substep, and of the lowest rank that had a problem in it.
    const std::int64_t n_ranks = mpi::n_mpi_processes(communicator());
    const std::int64_t mine =
      stopped && !stopped->problem.empty()
        ? stopped->substep * n_ranks + mpi::this_mpi_process(communicator())
        : std::numeric_limits<std::int64_t>::max();
    const unsigned int culprit = mpi::min(mine, communicator()) % n_ranks;
    throw DemError(mpi::broadcast(
      communicator(), stopped ? stopped->problem : std::string(), culprit));
  }

  void
  Dem::substep_by(const double dt)
  {
    take_over();
    double speed_square = 0.;
    if (!stopped)
      {
        CostSheet::Scope scope(costs, CostSheet::contact);
        speed_square = substep_number == 0 ? drift(arrays, integration(dt))
                                           : kick_and_drift(arrays, integration(dt));
        if (speed_square == infinity)
          stop(infinite_position());
      }
    moved_since_list += dt * std::sqrt(speed_square);
    move_walls(dt);
    update_neighbors(dt, speed_square);
    if (stopped)
      return;
    CostSheet::Scope scope(costs, CostSheet::contact);
    contacts.sweep(arrays, list, walls, materials, dt);
    costs.particle_steps += arrays.n_owned;
    costs.contact_steps += contacts.n_contacts();
    if (contacts.failed())
      stop(contacts.failure(arrays, walls));
  }

  void
  Dem::take_over()
  {
    if (halo.leaving.empty() && halo.giving().empty())
      return;
    CostSheet::Scope           scope(costs, CostSheet::halo);
    std::vector<std::uint32_t> rows;
    ByRank<std::vector<char>>  parts;
    for (const auto &[rank, of_rank] : halo.leaving)
      {
        HandOver hand_over;
        for (const auto row : of_rank)
          hand_over.passengers.push_back({arrays.id[row], pack(arrays, row)});
        hand_over.contacts = contacts.contacts_of(arrays, of_rank);
        parts[rank]        = dealii::Utilities::pack(hand_over, false);
        rows.insert(rows.end(), of_rank.begin(), of_rank.end());
      }
    std::sort(rows.begin(), rows.end());
    const auto old_ids = arrays.id;
    arrays.resize(arrays.n_owned);
    const auto new_row = particle_store.release(arrays, rows);
    loosen_contacts(old_ids, new_row);
    list.renumber(new_row);
    for (const auto &[rank, part] : halo.hand_over(parts))
      {
        auto       hand_over = dealii::Utilities::unpack<HandOver>(part, false);
        const auto first     = arrays.n_owned;
        particle_store.accept(arrays, hand_over.passengers);
        for (unsigned int row = first; row < arrays.n_owned; ++row)
          arrays.body[row].position[2] = ends.within(arrays.body[row].position[2]);
        loose.insert(loose.end(), hand_over.contacts.begin(), hand_over.contacts.end());
      }
    look_at_external_forces();
    ghosts_are_placed = false;
    list_is_valid     = false;
  }

  void
  Dem::look_at_external_forces()
  {
    external_forces  = any(arrays.external_force);
    external_torques = any(arrays.external_torque);
  }

  void
  Dem::update_neighbors(const double dt, const double speed_square)
  {
    // Rounding must not let a pair slip through.
    const double half_skin = 0.4999 * skin, half_near_skin = 0.4999 * near_skin;
    if (list_is_valid && moved_since_list >= half_skin)
      {
        // The bound adds up the fastest particle of each substep.
        CostSheet::Scope scope(costs, CostSheet::neighbor);
        moved_since_list = list.largest_move(arrays) + walls_moved_since_list;
        list_is_valid    = moved_since_list < 0.8 * half_skin;
      }
    const bool   chooses = !list_is_valid;
    const double fastest = halo.is_needed() ? meet_neighbors(speed_square) : speed_square;
    if (stopped)
      return;
    ghosts_moved_since_list += dt * std::sqrt(fastest);
    moved_since_sort += dt * std::sqrt(fastest);
    if (list_is_valid && ghosts_moved_since_list >= half_skin)
      {
        CostSheet::Scope scope(costs, CostSheet::neighbor);
        ghosts_moved_since_list = list.largest_move_of_ghosts(arrays);
        list_is_valid           = ghosts_moved_since_list < 0.8 * half_skin;
      }
    if (!list_is_valid)
      return list_neighbors(!chooses);
    if (moved_since_sort >= half_near_skin)
      {
        CostSheet::Scope scope(costs, CostSheet::neighbor);
        list.sort_by_distance(arrays);
        moved_since_sort = 0.;
      }
  }

  double
  Dem::meet_neighbors(const double speed_square)
  {
    CostSheet::Scope scope(costs, CostSheet::halo);
    if (!list_is_valid && !stopped)
      {
        if (bring_within(false))
          {
            contacts.clear();
            ghosts_are_placed = false;
          }
        if (const auto problem = halo.select(arrays); !problem.empty())
          stop(problem);
      }
    const auto news = halo.exchange(arrays, {speed_square, stopped.has_value()});
    if (news.has_stopped)
      stop({});
    else if (halo.has_other_ghosts() || !ghosts_are_placed)
      place_ghosts();
    else
      halo.refresh(arrays);
    return news.speed_square;
  }

  std::string
  Dem::infinite_position() const
  {
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      if (!std::isfinite(arrays.body[i].position.norm_square()))
        return "particle " + std::to_string(arrays.id[i]) +
               " has no finite position any more; is the force from outside finite?";
    return "a particle is too fast to be told its position; is the force from outside "
           "finite?";
  }

  void
  Dem::list_neighbors(const bool only_ghosts)
  {
    CostSheet::Scope scope(costs, CostSheet::neighbor);
    contacts.sort();
    list.build(arrays, walls, contacts.touching_rows(arrays.n_rows()), only_ghosts);
    contacts.watch_walls(list, walls);
    if (!only_ghosts)
      {
        moved_since_list       = list.largest_move(arrays);
        walls_moved_since_list = 0.;
      }
    ghosts_moved_since_list = 0.;
    moved_since_sort        = 0.;
    list_is_valid           = true;
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
