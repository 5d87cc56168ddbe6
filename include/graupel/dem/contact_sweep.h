#ifndef graupel_dem_contact_sweep_h
#define graupel_dem_contact_sweep_h

#include <graupel/dem/particle_arrays.h>
#include <graupel/dem/spring_table.h>
#include <graupel/dem/verlet_list.h>
#include <graupel/dem/walls.h>

#include <string>
#include <vector>

namespace graupel
{
  /** The materials in force: between particles, and of particles with walls. */
  struct Materials
  {
    PairMaterial particles;
    PairMaterial walls;
  };

  /**
   * The hot loop: forces and torques of all contacts in a Verlet list, and the
   * springs of those contacts.
   *
   * Forces are summed as whole numbers of a quantum, 2^-50 of a reference
   * force, so the sum does not depend on the order of the pairs; and a pair is
   * always computed from its lower id to its higher, by one piece of machine
   * code, on each rank that needs it. So the motion is the same bit by bit on
   * any number of ranks, and whenever lists are rebuilt. The sums hold up to
   * 8192 reference forces; a contact beyond 500, or with an overlap of 30 % of
   * a radius or more, ends the sweep as a failure().
   */
  class ContactSweep
  {
  public:
    /** Overlap relative to the radius from which on a contact is a failure [-]. */
    static constexpr double largest_overlap = 0.3;

    /**
     * @p reference_force: size of a large contact force, that of an overlap of
     * 10 % of the radius [N]; @p reference_radius: of a particle [m].
     */
    ContactSweep(const NormalLaws        &normal_law,
                 const RollingLaws       &rolling_law,
                 const std::vector<Wall> &walls,
                 const double             reference_force,
                 const double             reference_radius);

    /** Takes over a new list, with the springs of its contacts from @p table. */
    void load(const ParticleArrays &particles,
              const VerletList     &list,
              const SpringTable    &table);

    /**
     * Writes the springs of all touching contacts to @p table, a row for each
     * own particle. Returns a message if a particle has too many contacts.
     */
    std::string store(const ParticleArrays &particles,
                      const VerletList     &list,
                      SpringTable          &table) const;

    /**
     * Computes all contacts: moves the springs through the substep @p dt [s]
     * that led to the present positions, sets force and torque of the own rows,
     * adds to the loads of the walls.
     */
    void sweep(ParticleArrays   &particles,
               const VerletList &list,
               const Materials  &materials,
               const double      dt);

    /** Why the last sweep failed, empty if it did not. */
    std::string failure(const ParticleArrays &particles) const;

    bool
    failed() const
    {
      return failed_overlap != 0.;
    }

    /** Touching pairs of particles whose lower id is this rank's own. */
    unsigned int n_touching_pairs(const ParticleArrays &particles,
                                  const VerletList     &list) const;

    /** Touching contacts of own particles with walls. */
    unsigned int n_touching_walls() const;

    /** Contacts evaluated as touching in the last sweep, on this rank. */
    unsigned int
    n_evaluated() const
    {
      return evaluated;
    }

    /** Sets the sums of wall_load() to zero. */
    void reset_wall_loads();

    /**
     * Force on each wall summed over all sweeps since the last reset and over
     * all ranks of @p communicator [N]. Collective.
     */
    std::vector<dealii::Tensor<1, 3>> wall_loads(MPI_Comm communicator) const;

  private:
    using Quanta = std::array<std::int64_t, 6>;

    // One contact's memory: its springs, and whether it touched last time.
    struct Memory
    {
      Springs springs;
      bool    touching = false;
    };

    template <class NormalLaw, class RollingLaw>
    void sweep_pairs(const ParticleArrays            &particles,
                     const std::vector<NeighborPair> &pairs,
                     const PairMaterial              &material,
                     const double                     dt);

    template <class NormalLaw, class RollingLaw>
    void evaluate_pair(const ParticleArrays &particles,
                       const NeighborPair    pair,
                       const PairMaterial   &material,
                       const double          dt,
                       Memory               &memory);

    template <class NormalLaw, class RollingLaw, class Surface>
    void evaluate_wall(const ParticleArrays &particles,
                       const unsigned int    row,
                       const unsigned int    wall,
                       const Surface        &surface,
                       const PairMaterial   &material,
                       const double          dt,
                       Memory               &memory);

    bool in_range(const ContactAction &action,
                  const double         overlap,
                  const double         radius) const;
    void add(Quanta                     &sum,
             const dealii::Tensor<1, 3> &force,
             const dealii::Tensor<1, 3> &torque,
             const double                sign) const;
    void fail(const unsigned int row, const std::int64_t partner, const double overlap);

    NormalLaws        normal_law;
    RollingLaws       rolling_law;
    std::vector<Wall> walls;
    double            largest_force;
    double            force_quantum, torque_quantum, load_quantum;
    double            inverse_force_quantum, inverse_torque_quantum, inverse_load_quantum;

    std::vector<Memory>                      pair_memory;
    std::vector<std::vector<Memory>>         wall_memory;
    std::vector<Quanta>                      sums;
    std::vector<std::array<std::int64_t, 3>> loads;
    unsigned int                             evaluated = 0;

    unsigned int failed_row     = 0;
    std::int64_t failed_partner = 0;
    double       failed_overlap = 0.;
  };
} // namespace graupel

#endif
