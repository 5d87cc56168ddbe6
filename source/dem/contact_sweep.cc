#include <graupel/dem/contact_sweep.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    // A contact beyond this many reference forces is a failure; 16 of them
    // still fit into the sum.
    constexpr double largest_relative_force = 500.;

    // The list's own test may round differently from the contact's; what it
    // lets through must be a superset.
    constexpr double test_margin = 1. + 1e-12;

    // A contact that began within the substep has moved only since then.
    double
    step_in_contact(const Contact &contact, const double dt)
    {
      const double approached = contact.drift * contact.normal * dt;
      return approached > contact.overlap ? dt * contact.overlap / approached : dt;
    }
  } // namespace

  ContactSweep::ContactSweep(const NormalLaws        &normal_law,
                             const RollingLaws       &rolling_law,
                             const std::vector<Wall> &walls,
                             const double             reference_force,
                             const double             reference_radius)
    : normal_law(normal_law)
    , rolling_law(rolling_law)
    , walls(walls)
    , largest_force(largest_relative_force * reference_force)
    , force_quantum(reference_force * 0x1p-50)
    , torque_quantum(force_quantum * reference_radius)
    // Loads are summed over many sweeps and whole beds: more room, coarser.
    , load_quantum(reference_force * 0x1p-36)
    , inverse_force_quantum(1. / force_quantum)
    , inverse_torque_quantum(1. / torque_quantum)
    , inverse_load_quantum(1. / load_quantum)
    , wall_memory(walls.size())
    , loads(walls.size())
  {
  }

  void
  ContactSweep::load(const ParticleArrays &particles,
                     const VerletList     &list,
                     const SpringTable    &table)
  {
    const auto fetch = [&](const unsigned int row, const std::int64_t partner) {
      const Springs *springs = table.find(row, partner);
      return springs ? Memory{*springs, true} : Memory{};
    };

    pair_memory.resize(list.pairs.size());
    for (std::size_t k = 0; k < list.pairs.size(); ++k)
      {
        const auto [i, j] = list.pairs[k];
        pair_memory[k] =
          i < particles.n_owned ? fetch(i, particles.id[j]) : fetch(j, particles.id[i]);
      }

    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        wall_memory[w].clear();
        for (const unsigned int i : list.wall_rows[w])
          wall_memory[w].push_back(fetch(i, wall_id(w)));
      }
    sums.resize(particles.n_rows());
  }

  std::string
  ContactSweep::store(const ParticleArrays &particles,
                      const VerletList     &list,
                      SpringTable          &table) const
  {
    table.reset(particles.n_owned);
    std::int64_t overfull = -1;
    const auto   write =
      [&](const unsigned int row, const std::int64_t partner, const Memory &m) {
        if (row < particles.n_owned && m.touching && !table.add(row, partner, m.springs))
          overfull = particles.id[row];
      };

    for (std::size_t k = 0; k < pair_memory.size(); ++k)
      {
        const auto [i, j] = list.pairs[k];
        write(i, particles.id[j], pair_memory[k]);
        write(j, particles.id[i], pair_memory[k]);
      }
    for (unsigned int w = 0; w < wall_memory.size(); ++w)
      for (std::size_t k = 0; k < wall_memory[w].size(); ++k)
        write(list.wall_rows[w][k], wall_id(w), wall_memory[w][k]);

    if (overfull < 0)
      return {};
    return "particle " + std::to_string(overfull) + " touches more than " +
           std::to_string(SpringTable::n_slots) +
           " others, more than spheres of similar size can: are the radii too different?";
  }

  bool
  ContactSweep::in_range(const ContactAction &action,
                         const double         overlap,
                         const double         radius) const
  {
    return overlap < largest_overlap * radius &&
           action.force.norm_square() < largest_force * largest_force;
  }

  void
  ContactSweep::add(Quanta       &sum,
                    const Vector &force,
                    const Vector &torque,
                    const double  sign) const
  {
    for (unsigned int d = 0; d < 3; ++d)
      {
        sum[d] += static_cast<std::int64_t>(sign * force[d] * inverse_force_quantum);
        sum[3 + d] += static_cast<std::int64_t>(torque[d] * inverse_torque_quantum);
      }
  }

  void
  ContactSweep::fail(const unsigned int row,
                     const std::int64_t partner,
                     const double       overlap)
  {
    failed_row     = row;
    failed_partner = partner;
    failed_overlap = overlap;
  }

  // Not inlined, so that there is one piece of machine code for every pair:
  // copies of an inlined body could contract products and sums differently.
  template <class NormalLaw, class RollingLaw>
  [[gnu::noinline]] void
  ContactSweep::evaluate_pair(const ParticleArrays &p,
                              const NeighborPair    pair,
                              const PairMaterial   &material,
                              const double          dt,
                              Memory               &memory)
  {
    const auto [i, j]     = pair;
    const Vector between  = p.position[j] - p.position[i];
    const double distance = between.norm();
    const double r_i = p.radius[i], r_j = p.radius[j];

    Contact contact;
    contact.overlap = r_i + r_j - distance;
    if (!(contact.overlap > 0.))
      {
        memory = Memory{};
        return;
      }
    contact.normal = between / distance;
    contact.radius = r_i * r_j / (r_i + r_j);
    contact.mass   = p.mass[i] * p.mass[j] / (p.mass[i] + p.mass[j]);

    // Arms to the middle of the overlap: they add up to the distance, so
    // angular momentum is conserved.
    const double a_i = r_i - 0.5 * contact.overlap, a_j = r_j - 0.5 * contact.overlap;
    contact.velocity =
      p.velocity[i] - p.velocity[j] +
      cross_product_3d(a_i * p.spin[i] + a_j * p.spin[j], contact.normal);
    contact.drift =
      p.drift[i] - p.drift[j] +
      cross_product_3d(a_i * p.spin_drift[i] + a_j * p.spin_drift[j], contact.normal);
    contact.spin_drift = p.spin_drift[i] - p.spin_drift[j];
    contact.step       = memory.touching ? dt : step_in_contact(contact, dt);
    memory.touching    = true;
    ++evaluated;

    const ContactAction action =
      contact_action<NormalLaw, RollingLaw>(material, contact, memory.springs);
    if (!in_range(action, contact.overlap, std::min(r_i, r_j)))
      return fail(i, p.id[j], contact.overlap);

    const Vector turning = cross_product_3d(contact.normal, action.force);
    add(sums[i], action.force, a_i * turning + action.rolling_torque, 1.);
    add(sums[j], action.force, a_j * turning - action.rolling_torque, -1.);
  }

  template <class NormalLaw, class RollingLaw, class Surface>
  [[gnu::noinline]] void
  ContactSweep::evaluate_wall(const ParticleArrays &p,
                              const unsigned int    i,
                              const unsigned int    wall,
                              const Surface        &surface,
                              const PairMaterial   &material,
                              const double          dt,
                              Memory               &memory)
  {
    const WallGeometry geometry = surface.at(p.position[i]);

    Contact contact;
    contact.overlap = p.radius[i] - geometry.distance;
    if (!(contact.overlap > 0.))
      {
        memory = Memory{};
        return;
      }
    // The curvature of the tube is small against that of the sphere and left
    // out of R*; the mass of the wall is infinite.
    contact.normal   = geometry.normal;
    contact.radius   = p.radius[i];
    contact.mass     = p.mass[i];
    const double arm = geometry.distance;
    contact.velocity = p.velocity[i] + arm * cross_product_3d(p.spin[i], contact.normal);
    contact.drift = p.drift[i] + arm * cross_product_3d(p.spin_drift[i], contact.normal);
    contact.spin_drift = p.spin_drift[i];
    contact.step       = memory.touching ? dt : step_in_contact(contact, dt);
    memory.touching    = true;
    ++evaluated;

    const ContactAction action =
      contact_action<NormalLaw, RollingLaw>(material, contact, memory.springs);
    if (!in_range(action, contact.overlap, p.radius[i]))
      return fail(i, wall_id(wall), contact.overlap);

    add(sums[i],
        action.force,
        arm * cross_product_3d(contact.normal, action.force) + action.rolling_torque,
        1.);
    for (unsigned int d = 0; d < 3; ++d)
      loads[wall][d] -= static_cast<std::int64_t>(action.force[d] * inverse_load_quantum);
  }

  template <class NormalLaw, class RollingLaw>
  void
  ContactSweep::sweep_pairs(const ParticleArrays            &particles,
                            const std::vector<NeighborPair> &pairs,
                            const PairMaterial              &material,
                            const double                     dt)
  {
    for (std::size_t k = 0; k < pairs.size(); ++k)
      {
        const auto [i, j]  = pairs[k];
        const double reach = particles.radius[i] + particles.radius[j];
        const double gap = (particles.position[j] - particles.position[i]).norm_square();
        if (gap < reach * reach * test_margin || pair_memory[k].touching)
          evaluate_pair<NormalLaw, RollingLaw>(
            particles, pairs[k], material, dt, pair_memory[k]);
      }
  }

  void
  ContactSweep::sweep(ParticleArrays   &particles,
                      const VerletList &list,
                      const Materials  &materials,
                      const double      dt)
  {
    std::fill(sums.begin(), sums.end(), Quanta{});
    evaluated      = 0;
    failed_overlap = 0.;

    std::visit(
      [&](const auto normal, const auto rolling) {
        using NormalLaw  = std::decay_t<decltype(normal)>;
        using RollingLaw = std::decay_t<decltype(rolling)>;
        sweep_pairs<NormalLaw, RollingLaw>(
          particles, list.pairs, materials.particles, dt);

        for (unsigned int w = 0; w < walls.size(); ++w)
          std::visit(
            [&](const auto &surface) {
              for (std::size_t k = 0; k < list.wall_rows[w].size(); ++k)
                evaluate_wall<NormalLaw, RollingLaw>(particles,
                                                     list.wall_rows[w][k],
                                                     w,
                                                     surface,
                                                     materials.walls,
                                                     dt,
                                                     wall_memory[w][k]);
            },
            walls[w].shape);
      },
      normal_law,
      rolling_law);

    for (unsigned int i = 0; i < particles.n_owned; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          particles.force[i][d]  = force_quantum * static_cast<double>(sums[i][d]);
          particles.torque[i][d] = torque_quantum * static_cast<double>(sums[i][3 + d]);
        }
  }

  std::string
  ContactSweep::failure(const ParticleArrays &particles) const
  {
    if (!failed())
      return {};
    std::ostringstream text;
    text << "particle " << particles.id[failed_row] << " at ("
         << particles.position[failed_row] << ") m overlaps "
         << (failed_partner < 0 ? "the " + walls[-1 - failed_partner].name
                                : "particle " + std::to_string(failed_partner))
         << " by " << failed_overlap << " m, "
         << 100. * failed_overlap / particles.radius[failed_row]
         << " % of its radius; the contact law ends at " << 100. * largest_overlap
         << " %. Try a smaller substep, a larger Young's modulus or normal stiffness, or "
            "a slower "
            "drop.";
    return text.str();
  }

  unsigned int
  ContactSweep::n_touching_pairs(const ParticleArrays &particles,
                                 const VerletList     &list) const
  {
    unsigned int n = 0;
    for (std::size_t k = 0; k < pair_memory.size(); ++k)
      if (pair_memory[k].touching && list.pairs[k].first < particles.n_owned)
        ++n;
    return n;
  }

  unsigned int
  ContactSweep::n_touching_walls() const
  {
    unsigned int n = 0;
    for (const auto &memories : wall_memory)
      n += std::count_if(
        memories.begin(), memories.end(), [](const Memory &m) { return m.touching; });
    return n;
  }

  void
  ContactSweep::reset_wall_loads()
  {
    std::fill(loads.begin(), loads.end(), std::array<std::int64_t, 3>{});
  }

  std::vector<dealii::Tensor<1, 3>>
  ContactSweep::wall_loads(MPI_Comm communicator) const
  {
    std::vector<std::array<std::int64_t, 3>> all(loads.size());
    const int                                ierr = MPI_Allreduce(
      loads.data(), all.data(), 3 * loads.size(), MPI_INT64_T, MPI_SUM, communicator);
    AssertThrowMPI(ierr);

    std::vector<dealii::Tensor<1, 3>> forces(loads.size());
    for (unsigned int w = 0; w < all.size(); ++w)
      for (unsigned int d = 0; d < 3; ++d)
        forces[w][d] = load_quantum * static_cast<double>(all[w][d]);
    return forces;
  }
} // namespace graupel
