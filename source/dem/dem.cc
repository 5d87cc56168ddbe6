#include <graupel/dem/dem.h>
#include <graupel/dem/dem_error.h>
#include <graupel/dem/exact_sum.h>

#include <limits>

namespace graupel
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    constexpr double infinity = std::numeric_limits<double>::infinity();

    // One particle's half kick and drift. Not inlined, so that every particle
    // passes through the same machine code, whatever its row: see ContactSweep.
    [[gnu::noinline]] void
    drift_particle(ParticleArrays    &p,
                   const unsigned int i,
                   const double       gravity,
                   const double       dt)
    {
      Vector half_kick = (p.force[i] + p.external_force[i]) / p.mass[i];
      half_kick[2] -= gravity;
      half_kick *= 0.5 * dt;
      const Vector half_turn = (0.5 * dt / p.inertia[i]) * p.torque[i];

      p.drift[i]      = p.velocity[i] + half_kick;
      p.spin_drift[i] = p.spin[i] + half_turn;
      p.position[i] += dt * p.drift[i];
      p.velocity[i] = p.drift[i] + half_kick;
      p.spin[i]     = p.spin_drift[i] + half_turn;
    }

    [[gnu::noinline]] void
    kick_particle(ParticleArrays    &p,
                  const unsigned int i,
                  const double       gravity,
                  const double       dt)
    {
      Vector half_kick = (p.force[i] + p.external_force[i]) / p.mass[i];
      half_kick[2] -= gravity;
      p.velocity[i] = p.drift[i] + (0.5 * dt) * half_kick;
      p.spin[i]     = p.spin_drift[i] + (0.5 * dt / p.inertia[i]) * p.torque[i];
    }

    [[gnu::noinline]] double
    kinetic_energy(const ParticleArrays &p, const unsigned int i)
    {
      return 0.5 * (p.mass[i] * p.velocity[i].norm_square() +
                    p.inertia[i] * p.spin[i].norm_square());
    }
  } // namespace

  Dem::Dem(const DemParameters &parameters, const CylinderMesh &mesh, CostSheet &costs)
    : input(parameters)
    , mesh(mesh)
    , costs(costs)
    , smallest_edge(mesh.smallest_edge())
    , longest_substep(input.substep())
    , skin(input.contact.skin * 2. * input.particles.simulated_radius())
    , materials{input.particle_pair(false), input.wall_pair(false)}
    , gravity(input.particles.gravity)
    , particle_store(mesh, input.particles.density)
    , walls(vessel_walls(mesh.cylinder()))
    , halo(mesh.cylinder(),
           2. * input.particles.simulated_radius() + skin,
           mesh.communicator())
    , list(skin)
    , contacts(input.normal_law(),
               input.rolling_law(),
               walls,
               input.reference_force(),
               input.particles.simulated_radius())
    , wall_loads(walls.size())
  {
  }

  void
  Dem::insert(const std::vector<dealii::Point<3>> &positions, const Vector &velocity)
  {
    save_springs();
    particle_store.scatter(arrays, spring_table);
    particle_store.insert(positions, input.particles.simulated_radius(), velocity);
    particle_store.migrate();
    particle_store.gather(arrays, spring_table);
    move_since_migration = 0.;
    list_is_valid        = false;
  }

  void
  Dem::synchronise()
  {
    save_springs();
    particle_store.scatter(arrays, spring_table);
    particle_store.migrate();
    particle_store.gather(arrays, spring_table);
    move_since_migration = 0.;
    list_is_valid        = false;
  }

  void
  Dem::save_springs()
  {
    // Without a valid list the table, as gathered, is what is current.
    if (list_is_valid)
      throw_together(contacts.store(arrays, list, spring_table), communicator());
  }

  void
  Dem::use_packing_materials(const bool packing)
  {
    materials = {input.particle_pair(packing), input.wall_pair(packing)};
  }

  void
  Dem::set_friction(const double particles, const double walls)
  {
    materials.particles.friction = particles;
    materials.walls.friction     = walls;
  }

  void
  Dem::advance(const double duration)
  {
    // A duration that is a whole number of substeps but for rounding must not
    // cost one more.
    const auto n =
      static_cast<unsigned int>(std::ceil(duration / longest_substep - 1e-9));
    const auto dt = duration / std::max(1u, n);

    contacts.reset_wall_loads();
    for (unsigned int s = 0; s < n; ++s)
      substep_by(dt);

    wall_loads = contacts.wall_loads(communicator());
    for (auto &load : wall_loads)
      load /= std::max(1u, n);
    // A failure in the last substep was not yet told to the other ranks.
    throw_together(contacts.failure(arrays), communicator());
  }

  void
  Dem::substep_by(const double dt)
  {
    // deal.II loses particles that cross more than one layer of cells between
    // two migrations, unless there is one rank only.
    if (dealii::Utilities::MPI::n_mpi_processes(communicator()) > 1 &&
        move_since_migration + move_since_list > 0.5 * smallest_edge)
      synchronise();

    drift(dt);
    update_neighbors();
    {
      CostSheet::Scope scope(costs, CostSheet::halo);
      halo.refresh(arrays);
    }
    CostSheet::Scope scope(costs, CostSheet::contact);
    contacts.sweep(arrays, list, materials, dt);
    kick(dt);
    costs.particle_steps += arrays.n_owned;
    costs.contact_steps += contacts.n_evaluated();
  }

  void
  Dem::drift(const double dt)
  {
    CostSheet::Scope scope(costs, CostSheet::contact);
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      drift_particle(arrays, i, gravity, dt);
  }

  void
  Dem::kick(const double dt)
  {
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      kick_particle(arrays, i, gravity, dt);
  }

  void
  Dem::update_neighbors()
  {
    // One number tells all ranks both how far particles went and whether some
    // rank must stop.
    const std::string problem  = first_problem();
    double            farthest = problem.empty() ? 0. : infinity;
    if (list_is_valid)
      for (unsigned int i = 0; i < arrays.n_owned; ++i)
        farthest =
          std::max(farthest, (arrays.position[i] - listed_position[i]).norm_square());
    {
      CostSheet::Scope scope(costs, CostSheet::halo);
      farthest = dealii::Utilities::MPI::max(farthest, communicator());
    }
    if (farthest == infinity)
      throw_together(problem, communicator());

    move_since_list = std::sqrt(farthest);
    if (!list_is_valid || move_since_list >= 0.4999 * skin)
      rebuild_list();
  }

  std::string
  Dem::first_problem() const
  {
    if (contacts.failed())
      return contacts.failure(arrays);
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      if (!std::isfinite(arrays.position[i].norm_square()))
        return "particle " + std::to_string(arrays.id[i]) +
               " has no finite position any more; is the force from outside finite?";
    return {};
  }

  void
  Dem::rebuild_list()
  {
    save_springs();
    move_since_migration += move_since_list;
    move_since_list = 0.;
    {
      CostSheet::Scope scope(costs, CostSheet::halo);
      halo.rebuild(arrays, input.particles.density);
    }
    CostSheet::Scope scope(costs, CostSheet::neighbor);
    list.build(arrays, walls);
    contacts.load(arrays, list, spring_table);
    listed_position.assign(arrays.position.begin(),
                           arrays.position.begin() + arrays.n_owned);
    list_is_valid = true;
    ++list_builds;
  }

  double
  Dem::solid_volume() const
  {
    return n_global() * sphere_volume(input.particles.simulated_radius());
  }

  double
  Dem::weight() const
  {
    return n_global() * input.particles.simulated_mass() * input.particles.gravity;
  }

  double
  Dem::maximum_speed() const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      largest = std::max(largest, arrays.velocity[i].norm_square());
    return std::sqrt(dealii::Utilities::MPI::max(largest, communicator()));
  }

  double
  Dem::mean_kinetic_energy() const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      largest = std::max(largest, kinetic_energy(arrays, i));
    ExactSum sum(dealii::Utilities::MPI::max(largest, communicator()));
    for (unsigned int i = 0; i < arrays.n_owned; ++i)
      sum.add(kinetic_energy(arrays, i));
    return sum.total(communicator()) / std::max(1u, n_global());
  }

  double
  Dem::coordination_number() const
  {
    // Each pair counts for both of its partners, on the rank of its lower id or
    // in the tables of both.
    unsigned int contacts_of_particles = 0;
    if (list_is_valid)
      contacts_of_particles = 2 * contacts.n_touching_pairs(arrays, list);
    else
      for (unsigned int i = 0; i < arrays.n_owned; ++i)
        contacts_of_particles += spring_table.n_particle_contacts(i);
    return dealii::Utilities::MPI::sum(contacts_of_particles, communicator()) /
           std::max(1., 1. * n_global());
  }
} // namespace graupel
