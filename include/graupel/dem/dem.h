// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_dem_h
#define graupel_dem_dem_h

#include <graupel/base/cost_sheet.h>
#include <graupel/dem/contacts/contact_sweep.h>
#include <graupel/dem/dem_parameters.h>
#include <graupel/dem/dem_state.h>
#include <graupel/dem/integration.h>
#include <graupel/dem/particles/halo.h>
#include <graupel/dem/particles/particle_store.h>
#include <graupel/dem/vessel/vessel.h>

namespace graupel
{
  /**
   * The motion of spheres that touch each other and the walls of a cylinder,
   * under gravity and a force from outside.
   *
   * Time integration is velocity Verlet. Dampers see the velocity predicted to
   * the end of the substep and springs move by that of its middle, so that the
   * scheme is symplectic where nothing is damped, and of second order where
   * contacts are. The state after any number of substeps is the same bit by
   * bit on any number of ranks.
   */
  class Dem
  {
  public:
    /** @p mesh and @p costs must outlive this object; @p parameters are checked. */
    Dem(const DemParameters &parameters, VesselMesh &mesh, CostSheet &costs);

    /**
     * Particles that are to be inserted, told by the same calls on every rank. No rank
     * holds all of them: each keeps those whose bins it is asked of (Subdomains).
     */
    class Batch
    {
    public:
      explicit Batch(const Dem &dem);

      /** One that has no id gets the next free one. */
      void add(const NewParticle &particle);

    private:
      friend Dem;

      const Dem               *dem;
      std::vector<NewParticle> share;
      std::int64_t             next_id;
      // Of all that will be in the vessel, by type.
      std::vector<unsigned long> number;
      std::vector<double>        volume;
    };

    /**
     * Adds simulated particles, of sizes that their types have and at places where they
     * may be. Own rows stay, new ones come behind them. Throws DemError, on all ranks,
     * for a place outside of the mesh. Collective.
     */
    void insert(const Batch &batch);

    /**
     * The same for a few particles. The same call on every rank. Throws DemError also for
     * a size that its type does not have (substep, halo and lists are made for those of
     * the types), and for a place beyond a wall or inside of a body.
     */
    void insert(const std::vector<NewParticle> &added);

    /**
     * Adds simulated particles of the first type and its mean size at @p positions [m],
     * moving with @p velocity [m/s].
     */
    void insert(const std::vector<dealii::Point<3>> &positions,
                const dealii::Tensor<1, 3>          &velocity = dealii::Tensor<1, 3>());

    /**
     * Moves all particles through @p duration [s], in the least whole number of
     * equal substeps that are not longer than substep(). Rows may change on
     * more than one rank. Collective. Throws DemError, on all ranks, if a
     * contact leaves the range of its law or a particle is lost.
     */
    void advance(const double duration);

    /**
     * Brings the store up to date: finds the cell and rank of every particle
     * and moves it there. Rows may change. Collective. Nothing of the motion
     * changes by it, not a bit.
     */
    void synchronise();

    /**
     * If particles are spread unevenly over the ranks, divides the mesh among them
     * anew, a cell counting as much as @p cell_share particles. Everything that
     * knows the partition of the mesh is void then, and true is returned.
     * Collective. Nothing of the motion changes by it.
     */
    bool balance(const double cell_share);

    /**
     * Refines and coarsens the mesh as it is marked (see mark_cells) and divides it among
     * the ranks as balance() does; particles, springs and forces go along. Everything
     * else that knows the mesh is void then. Collective. Nothing of the motion changes by
     * it.
     */
    void adapt_mesh(const double cell_share);

    /** All that the motion goes on from, of this rank's own particles. */
    DemState state() const;

    /**
     * Goes on from @p state, of which each rank has any part, instead of what is here;
     * the mesh may have changed since construction. The masses are those of these
     * parameters. A wall goes on from where one of the same name and shape was; contacts
     * with walls that are no more, or have another shape, end. Throws DemError for
     * particles that these parameters do not have. Collective. The motion goes on as it
     * would have, bit by bit.
     */
    void restore(const DemState &state);

    /** Uses the friction of packing (true) or that of the flow; springs stay. */
    void use_packing_materials(const bool of_packing);

    /** Whether the friction of packing is in force. */
    bool
    packing_materials() const
    {
      return packing;
    }

    /** Sets the friction between particles and that with walls [-]; springs stay. */
    void set_friction(const double particles, const double walls);

    /**
     * Lets the clock of walls that move and gates that open run from @p t on [s], the
     * time of the flow; it goes on with advance(), and may be set again. Before it runs
     * they stand still. Throws DemError where a wall comes and a particle is in its way.
     * Collective.
     */
    void start_clock(const double t);

    /** What the clock shows [s]; 0 before it runs. */
    double
    clock() const
    {
      return time.value_or(0.);
    }

    /** Sets the acceleration of gravity [m/s^2]. */
    void
    set_gravity(const dealii::Tensor<1, 3> &acceleration)
    {
      gravity = acceleration;
    }

    /** Sets the acceleration of gravity, along -z [m/s^2]. */
    void
    set_gravity(const double acceleration)
    {
      gravity = dealii::Tensor<1, 3>({0., 0., -acceleration});
    }

    /** Of the vessel's ends. */
    const Period &
    period() const
    {
      return ends;
    }

    /** Which ranks have cells where. */
    const Subdomains &
    ranks() const
    {
      return subdomains;
    }

    /** Where the particles are in the mesh, as of the last synchronise(). */
    const ParticleStore &
    store() const
    {
      return particle_store;
    }

    /**
     * The particles of this rank, at the present time. Velocities, spins and
     * external forces of own rows may be set; other members may not.
     */
    ParticleArrays &
    particles()
    {
      return arrays;
    }

    const ParticleArrays &
    particles() const
    {
      return arrays;
    }

    const DemParameters &
    parameters() const
    {
      return input;
    }

    const Cylinder &
    cylinder() const
    {
      return mesh.cylinder();
    }

    MPI_Comm
    communicator() const
    {
      return mesh.communicator();
    }

    /** Particles on all ranks. */
    unsigned int
    n_global() const
    {
      return particle_store.n_global();
    }

    /** Contact force on an own row at the present time [N]. */
    dealii::Tensor<1, 3>
    contact_force(const unsigned int row) const
    {
      return contacts.quanta().force_of(arrays.load[row]);
    }

    /** Contact torque on an own row at the present time [N m]. */
    dealii::Tensor<1, 3>
    contact_torque(const unsigned int row) const
    {
      return contacts.quanta().torque_of(arrays.load[row]);
    }

    /**
     * All contacts whose first particle is this rank's own, with their present
     * forces; with @p of_ghosts also those of ghosts with own particles. Dampers
     * see the present velocities of ghosts after synchronise() only.
     */
    std::vector<ContactState>
    contact_states(const bool of_ghosts = false) const
    {
      return contacts.states(arrays, walls, materials, of_ghosts);
    }

    /** Particles that have left through open ends, by type, on all ranks. */
    const std::vector<unsigned long> &
    departed() const
    {
      return departed_by_type;
    }

    /** Mass of the particles that have left, by type [kg]. */
    std::vector<double> departed_mass() const;

    /** Particles that have left, of all types. */
    unsigned long n_departed() const;

    /** The walls of the vessel, where they are now. */
    const std::vector<Wall> &
    vessel() const
    {
      return walls;
    }

    /** The space that the walls leave to the particles, as of the last advance(). */
    const Vessel &
    vessel_shape() const
    {
      return shape;
    }

    /** The longest substep in use [s]. */
    double
    substep() const
    {
      return longest_substep;
    }

    /** Particles in the vessel by type, on all ranks. */
    const std::vector<unsigned long> &
    n_by_type() const
    {
      return number_by_type;
    }

    /** Volume of all particles [m^3]. */
    double solid_volume() const;
    /** Sauter mean diameter of the original particles, volume over surface times six [m].
     * Collective. */
    double original_sauter_diameter() const;
    /** Mass of all particles [kg]. */
    double solid_mass() const;

    /** Mass over volume of all particles [kg/m^3]; of the first type without any. */
    double mean_density() const;

    /** Weight of all particles under the gravity of the parameters [N]. */
    double weight() const;

    /** Load pressed on the bottom, along gravity, mean of the last advance() [N]. */
    double
    bottom_force() const
    {
      return along_gravity(bottom_wall);
    }

    /** Load carried by the lateral wall, along gravity, mean of the last advance() [N].
     */
    double
    wall_force() const
    {
      return along_gravity(lateral_wall);
    }

    /** Load carried by all walls, along gravity, mean of the last advance() [N]. */
    double supported_weight() const;

    /** Force on the wall of this number, mean of the last advance() [N]. */
    const dealii::Tensor<1, 3> &
    force_on(const unsigned int wall) const
    {
      return wall_loads[wall].force;
    }

    /** Force on the wall of this name. Throws InputError if there is none. */
    const dealii::Tensor<1, 3> &
    force_on(const std::string &wall) const
    {
      return force_on(wall_number(wall));
    }

    /**
     * Torque on the wall of this number, about the axis that it turns about or that of
     * the vessel, mean of the last advance() [N m].
     */
    double
    torque_on(const unsigned int wall) const
    {
      return wall_loads[wall].torque;
    }

    /** Place in vessel() of the wall of this name. Throws InputError if there is none. */
    unsigned int wall_number(const std::string &name) const;

    /** Kinetic energy, translation and rotation, mean per particle [J]. Collective. */
    double mean_kinetic_energy() const;
    /** Of the translation alone, mean per particle [J]. Collective. */
    double mean_translational_energy() const;
    /** Largest speed of a center [m/s]. Collective. */
    double maximum_speed() const;
    /** Contacts with other particles, mean per particle [-]. Collective. */
    double coordination_number() const;

    /** Times that the neighbour list was built since the start. */
    unsigned int
    n_list_builds() const
    {
      return list_builds;
    }

  private:
    Integration integration(const double dt) const;
    void        substep_by(const double dt);
    // What is wrong with them, for a message.
    std::string problem_of(const std::vector<NewParticle> &added) const;
    std::string problem_of_places(const std::vector<NewParticle> &added) const;
    std::string infinite_position() const;
    std::vector<std::uint32_t> departed_rows() const;
    std::string                problem_of(const DemState &state) const;
    void                       take_rows(const DemState &state);
    void                       restore_counts(const DemState::Common &state);
    // Of an advance() in @p n substeps, over all ranks; takes away what has left.
    void add_up(const unsigned int n);
    // Goes on without computing until the end of the advance(), so that no neighbour
    // waits; there all ranks throw.
    void              stop(const std::string &problem);
    [[noreturn]] void throw_first_problem() const;

    void migrate(const std::vector<std::uint32_t> &departed,
                 const unsigned int                n_departed);
    // Brings back what has left through a periodic end, all of it or what is at home
    // here. False if there is nothing. Else all contacts are loose, too.
    bool bring_within(const bool all);
    void loosen_contacts(const std::vector<std::int64_t>  &old_ids,
                         const std::vector<std::uint32_t> &new_row);
    // All ranks choose and place their ghosts.
    void find_ghosts();
    void place_ghosts();
    // Gives and takes particles, as was announced with the last bodies.
    void take_over();
    void look_at_external_forces();
    void update_neighbors(const double dt, const double speed_square);
    // Sends and receives ghosts; returns the largest square of a drift here and there.
    double                    meet_neighbors(const double speed_square);
    void                      list_neighbors(const bool only_ghosts);
    ParticleStore::ContactsOf contacts_of() const;
    unsigned int              cell_weight(const double cell_share) const;
    void follow(const std::vector<std::int64_t> &old_ids, ParticleStore::Moves moves);
    void move_walls(const double dt);
    // Returns what is in the way of a wall that comes.
    std::string                 open_and_close_gates();
    std::string                 in_the_way_of(const Wall &wall) const;
    std::vector<DemState::Wall> state_of_walls() const;
    // The number here of each wall of a state; -1 for one whose contacts end.
    std::vector<std::int64_t> restore_walls(const DemState::Common &state);

    double
    along_gravity(const unsigned int wall) const
    {
      return wall_loads[wall].force * input.particles.gravity_direction;
    }

    const DemParameters  input;
    VesselMesh          &mesh;
    CostSheet           &costs;
    const double         longest_substep;
    const double         skin;
    const double         near_skin;
    std::vector<Wall>    walls;
    Vessel               shape;
    Materials            materials;
    dealii::Tensor<1, 3> gravity;

    const Period   ends;
    Subdomains     subdomains;
    ParticleStore  particle_store;
    ParticleArrays arrays;
    Halo           halo;
    VerletList     list;
    ContactSweep   contacts;

    // Of the flow, by which walls move.
    Clock                 time;
    std::vector<WallLoad> wall_loads;

    bool external_forces  = false;
    bool external_torques = false;
    bool packing          = false;

    // Of what is in the vessel and what has left it, by type [-, m^3].
    std::vector<unsigned long> number_by_type, departed_by_type;
    std::vector<double>        volume_by_type, departed_volume;

    // Contacts that wait for the rows of their ghosts.
    std::vector<LooseContact> loose;
    bool                      ghosts_are_placed = true;

    // Bounds on how far any particle of this rank, walls included, and any ghost has gone
    // since the list was made, and any of both since its pairs were sorted into near and
    // far ones.
    double       moved_since_list        = 0.;
    double       ghosts_moved_since_list = 0.;
    double       moved_since_sort        = 0.;
    double       walls_moved_since_list  = 0.;
    bool         list_is_valid           = false;
    unsigned int list_builds             = 0;

    // Why this rank has stopped in the present advance(), and in which substep; the
    // problem is empty where a neighbour has it.
    struct Stop
    {
      std::int64_t substep;
      std::string  problem;
    };
    std::optional<Stop> stopped;
    unsigned int        substep_number = 0;
  };
} // namespace graupel

#endif
