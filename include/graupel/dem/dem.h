#ifndef graupel_dem_dem_h
#define graupel_dem_dem_h

#include <graupel/base/cost_sheet.h>
#include <graupel/dem/contact_sweep.h>
#include <graupel/dem/dem_parameters.h>
#include <graupel/dem/halo.h>
#include <graupel/dem/particle_store.h>

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
    Dem(const DemParameters &parameters, const CylinderMesh &mesh, CostSheet &costs);

    /**
     * Adds simulated particles at @p positions [m], moving with @p velocity
     * [m/s]. The same call on every rank, collective. Rows may change.
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

    /** Uses the friction of packing (true) or that of the flow; springs stay. */
    void use_packing_materials(const bool packing);

    /** Sets the friction between particles and that with walls [-]; springs stay. */
    void set_friction(const double particles, const double walls);

    /** Sets the acceleration of gravity, along -z [m/s^2]. */
    void
    set_gravity(const double acceleration)
    {
      gravity = acceleration;
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

    /** The longest substep in use [s]. */
    double
    substep() const
    {
      return longest_substep;
    }

    /** Volume of all particles [m^3]. */
    double solid_volume() const;
    /** Weight of all particles under the gravity of the parameters [N]. */
    double weight() const;

    /** Load pressed on the bottom, along gravity, mean of the last advance() [N]. */
    double
    bottom_force() const
    {
      return -wall_loads[bottom_wall][2];
    }

    /** Load carried by the lateral wall, along gravity, mean of the last advance() [N].
     */
    double
    wall_force() const
    {
      return -wall_loads[lateral_wall][2];
    }

    /** Force on the wall of this number, mean of the last advance() [N]. */
    const dealii::Tensor<1, 3> &
    force_on(const VesselWall wall) const
    {
      return wall_loads[wall];
    }

    /** Kinetic energy, translation and rotation, mean per particle [J]. Collective. */
    double mean_kinetic_energy() const;
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
    void        drift(const double dt);
    void        kick(const double dt);
    void        substep_by(const double dt);
    void        update_neighbors();
    std::string first_problem() const;
    void        rebuild_list();
    void        save_springs();

    const DemParameters input;
    const CylinderMesh &mesh;
    CostSheet          &costs;
    const double        smallest_edge;
    const double        longest_substep;
    const double        skin;
    Materials           materials;
    double              gravity;

    ParticleStore           particle_store;
    ParticleArrays          arrays;
    SpringTable             spring_table;
    const std::vector<Wall> walls;
    Halo                    halo;
    VerletList              list;
    ContactSweep            contacts;

    std::vector<dealii::Tensor<1, 3>> wall_loads;

    // Positions at the last list, and how far any particle of any rank has
    // moved since; and the sum of such moves since the last migration.
    std::vector<dealii::Point<3>> listed_position;
    double                        move_since_list      = 0.;
    double                        move_since_migration = 0.;
    bool                          list_is_valid        = false;
    unsigned int                  list_builds          = 0;
  };
} // namespace graupel

#endif
