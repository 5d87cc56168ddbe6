// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_contacts_contact_sweep_h
#define graupel_dem_contacts_contact_sweep_h

#include <graupel/dem/contacts/contact_list.h>
#include <graupel/dem/contacts/verlet_list.h>
#include <graupel/dem/laws/materials.h>
#include <graupel/dem/particles/loose_contact.h>
#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/walls/walls.h>

#include <string>
#include <vector>

namespace graupel
{
  /** The units in which forces, torques and loads of walls are counted. */
  struct ForceQuanta
  {
    /** @p reference_force: see ContactSweep. */
    ForceQuanta(const double reference_force, const double reference_radius)
      : force(reference_force * 0x1p-50)
      , torque(force * reference_radius)
      // Loads are summed over many sweeps and whole beds: more room, coarser.
      , wall(reference_force * 0x1p-36)
      // The arms may be many radii long.
      , wall_torque(64. * wall * reference_radius)
    {
    }

    /** Quantum of a force [N]. */
    double force;
    /** Quantum of a torque [N m]. */
    double torque;
    /** Quantum of a wall's load [N]. */
    double wall;
    /** Quantum of a wall's torque [N m]. */
    double wall_torque;

    dealii::Tensor<1, 3>
    force_of(const Load &load) const
    {
      return dealii::Tensor<1, 3>({force * static_cast<double>(load.quanta[0]),
                                   force * static_cast<double>(load.quanta[1]),
                                   force * static_cast<double>(load.quanta[2])});
    }

    dealii::Tensor<1, 3>
    torque_of(const Load &load) const
    {
      return dealii::Tensor<1, 3>({torque * static_cast<double>(load.quanta[3]),
                                   torque * static_cast<double>(load.quanta[4]),
                                   torque * static_cast<double>(load.quanta[5])});
    }
  };

  /** What the particles do to a wall. */
  struct WallLoad
  {
    /** [N] */
    dealii::Tensor<1, 3> force;
    /** About the axis of its course [N m]. */
    double torque = 0.;
  };

  /** One contact, for output. */
  struct ContactState
  {
    /** Ids; the second is a negative wall_id() for a wall. */
    std::int64_t first;
    std::int64_t second;
    /** Centers of the particles; the second is the contact point for a wall [m]. */
    dealii::Point<3> first_center, second_center;
    /** Overlap [m]. */
    double overlap;
    /** Unit normal from the first to the second. */
    dealii::Tensor<1, 3> normal;
    /** Force on the first [N]. */
    dealii::Tensor<1, 3> force;
  };

  /**
   * The hot loop: forces and torques of all contacts, and the springs of those
   * contacts, as many contacts at a time as the processor has lanes.
   *
   * Forces are summed as whole numbers of a quantum, 2^-50 of a reference
   * force, so the sum does not depend on the order of the pairs; and a pair is
   * always computed from its lower id to its higher, by the same operations in
   * each lane, on each rank that needs it. So the motion is the same bit by bit on
   * any number of ranks, and whenever lists are rebuilt. The sums hold up to
   * 8192 reference forces; a contact beyond 500, or with an overlap of 30 % of
   * a radius or more, ends the sweep as a failure().
   */
  class ContactSweep
  {
  public:
    /** Overlap relative to the radius from which on a contact is a failure [-]. */
    static constexpr double largest_overlap = 0.3;

    /** The new number of a row that has gone. */
    static constexpr std::uint32_t no_row = -1;

    /**
     * @p reference_force: size of a large contact force, that of an overlap of
     * 10 % of the radius of the largest particle [N]; @p reference_radius: its
     * radius [m].
     */
    ContactSweep(const NormalLaws  &normal_law,
                 const RollingLaws &rolling_law,
                 const unsigned int n_types,
                 const unsigned int n_walls,
                 const double       reference_force,
                 const double       reference_radius);

    /** Puts the contacts into the order of the rows, if many have begun. */
    void sort();

    /** The contacts in which at least one of some own rows takes part. */
    std::vector<LooseContact> contacts_of(const ParticleArrays             &particles,
                                          const std::vector<std::uint32_t> &rows) const;

    /** Forgets all contacts. */
    void clear();

    /**
     * Follows a new numbering of the rows: @p new_row of an old own row, or no_row
     * if it has gone; ghosts have no number any more. Returns the contacts between
     * an own row that stays and a ghost or one that goes; they are to be given back
     * by add(). @p old_ids are the ids of the old rows.
     */
    std::vector<LooseContact> renumber(const std::vector<std::int64_t>  &old_ids,
                                       const std::vector<std::uint32_t> &new_row);

    /**
     * Adds contacts of own particles, and leaves out others; rows of ghosts must be
     * there. What is given twice counts once.
     */
    void add(const ParticleArrays &particles, std::vector<LooseContact> contacts);

    /** The contacts between particles as a table of rows. */
    TouchingRows touching_rows(const unsigned int n_rows) const;

    /** Takes over from a new list which rows are near walls. */
    void watch_walls(const VerletList &list, const std::vector<Wall> &walls);

    /**
     * Computes all contacts: those of the last sweep and the pairs of @p list
     * that touch now. Moves the springs through the substep @p dt [s] that led to
     * the present positions, adds to the loads of the particles, which must be
     * zero, and to those of the walls. Contacts that end go back to the list.
     */
    void sweep(ParticleArrays          &particles,
               VerletList              &list,
               const std::vector<Wall> &walls,
               const Materials         &materials,
               const double             dt);

    /** Why the last sweep failed, empty if it did not. */
    std::string failure(const ParticleArrays    &particles,
                        const std::vector<Wall> &walls) const;

    bool
    failed() const
    {
      return failed_overlap != 0.;
    }

    /** Touching pairs of particles whose lower id is this rank's own. */
    std::size_t n_touching_pairs(const ParticleArrays &particles) const;

    /** Touching contacts of own particles with walls. */
    std::size_t n_touching_walls() const;

    /** Contacts on this rank. */
    std::size_t n_contacts() const;

    /**
     * All contacts whose first particle is own, with their present forces; with
     * @p of_ghosts also those of ghosts with own particles.
     */
    std::vector<ContactState> states(const ParticleArrays    &particles,
                                     const std::vector<Wall> &walls,
                                     const Materials         &materials,
                                     const bool               of_ghosts = false) const;

    const ForceQuanta &
    quanta() const
    {
      return quantum;
    }

    /** Sets the sums of load_quanta() to zero. */
    void reset_wall_loads();

    /** Force and torque on each wall in their quanta, four numbers a wall, of this rank's
     * particles, summed over all sweeps since the last reset. */
    std::vector<std::int64_t> load_quanta() const;

    /** Force on each wall [N] and torque about its axis [N m], mean of @p n_sweeps
     * sweeps, from the sum of all ranks' load_quanta(), which @p quanta begin with. */
    std::vector<WallLoad> wall_loads(const std::vector<std::int64_t> &quanta,
                                     const unsigned int               n_sweeps) const;

    /** Forgets all contacts with a wall that has gone. */
    void leave_wall(const unsigned int wall);

  private:
    void begin_pairs(const ParticleArrays &particles, VerletList &list);
    void begin_walls(const ParticleArrays &particles, const std::vector<Wall> &walls);

    // All but surfaces; a unit of its own for each law, see contact_loops.h.
    template <class NormalLaw>
    void sweep_by(ParticleArrays          &particles,
                  VerletList              &list,
                  const std::vector<Wall> &walls,
                  const Materials         &materials,
                  const double             dt);

    template <class NormalLaw, class RollingLaw>
    void sweep_pairs(ContactList        &contacts,
                     ParticleArrays     &particles,
                     const PairMaterial &material,
                     const double        first_density,
                     const double        second_density,
                     const double        dt);

    template <class Surface>
    void begin_wall(const ParticleArrays &particles,
                    const Surface        &surface,
                    const unsigned int    wall);

    template <class NormalLaw, class RollingLaw, class Surface>
    void sweep_wall(ParticleArrays    &particles,
                    const unsigned int wall,
                    const Surface     &surface,
                    const Wall        &motion,
                    const Materials   &materials,
                    const double       dt);

    template <class NormalLaw, class RollingLaw, class Surface>
    void sweep_wall_contacts(ContactList        &contacts,
                             ParticleArrays     &particles,
                             const unsigned int  wall,
                             const Surface      &surface,
                             const Wall         &motion,
                             const PairMaterial &material,
                             const double        density,
                             const double        dt);

    void sweep_surfaces(ParticleArrays          &particles,
                        const std::vector<Wall> &walls,
                        const Materials         &materials,
                        const double             dt);

    // A wall of triangles, one contact after the other: contacts are found anew,
    // and those that were there before keep their springs.
    template <class NormalLaw, class RollingLaw>
    void sweep_surface(ParticleArrays    &particles,
                       const unsigned int wall,
                       const SurfaceWall &surface,
                       const Wall        &motion,
                       const Materials   &materials,
                       const double       dt);

    template <class NormalLaw, class RollingLaw>
    void sweep_surface_contact(ParticleArrays           &particles,
                               const std::uint32_t       row,
                               const SurfaceMesh::Touch &touch,
                               const unsigned int        wall,
                               const Wall               &motion,
                               const PairMaterial       &material,
                               const double              dt,
                               const bool                is_fresh,
                               Springs<double>          &springs);

    // Sets aside the contacts that ended, and the first that fails.
    void examine(const LaneMask    &ended,
                 const LaneMask    &broken,
                 const Lanes       &overlap,
                 const std::size_t  first_of_block,
                 const ContactList &contacts,
                 const bool         with_wall,
                 const unsigned int wall);

    ContactList &
    pair_list(const ParticleArrays &particles, const NeighborPair pair)
    {
      return pair_lists[particles.type[pair.first] * n_types +
                        particles.type[pair.second]];
    }

    NormalLaws   normal_law;
    RollingLaws  rolling_law;
    unsigned int n_types;
    unsigned int n_walls;
    double       largest_force;
    ForceQuanta  quantum;

    // By types, first * n_types + second; and wall * n_types + type.
    std::vector<ContactList> pair_lists;
    std::vector<ContactList> wall_lists;
    // For each wall the rows near it that do not touch it; all for a surface.
    std::vector<std::vector<std::uint32_t>> idle_rows;
    // Of each wall: force, and torque about its axis.
    std::vector<std::array<std::int64_t, 4>> loads;
    // Contacts of the list at work that have ended, in ascending order.
    std::vector<std::uint32_t>      ended;
    std::vector<SurfaceMesh::Touch> touches;

    std::int64_t failed_first   = 0;
    std::int64_t failed_partner = 0;
    double       failed_overlap = 0.;
  };
} // namespace graupel

#endif
