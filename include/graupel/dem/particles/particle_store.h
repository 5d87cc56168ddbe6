// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_particle_store_h
#define graupel_dem_particles_particle_store_h

#include <graupel/dem/particles/loose_contact.h>
#include <graupel/dem/particles/parcel.h>
#include <graupel/dem/particles/subdomains.h>
#include <graupel/mesh/vessel_mesh.h>

#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/particles/particle_handler.h>

#include <functional>
#include <vector>

namespace graupel
{
  /**
   * Which cell and which rank each particle is in, as of the last migration. The
   * only class of the program that names deal.II's ParticleHandler.
   *
   * The arrays are the truth. The handler knows a particle's id and place, and as
   * a label the rank and row that has the rest of it. A migration moves the
   * handler's particles; then each rank fetches from the ranks named by the labels
   * what it does not have: type, body, forces and the springs of the contacts. So
   * whatever moves particles between ranks (migration, refinement, a new
   * partition) takes everything along.
   *
   * Between two migrations rows may go from rank to rank without the handler, by
   * release() and accept(); the next migration finds their cells.
   */
  class ParticleStore
  {
  public:
    using CellIterator = dealii::Triangulation<3>::active_cell_iterator;
    using CellVisitor =
      std::function<void(const CellIterator                  &cell,
                         const unsigned int                   first_row,
                         const std::vector<dealii::Point<3>> &reference_locations)>;

    /** @p mesh and its @p subdomains must outlive the store, which brings these up to
     * date where it changes the mesh. */
    ParticleStore(VesselMesh &mesh, Subdomains &subdomains);

    /**
     * Adds particles with ids that no other has, behind the own rows of @p particles,
     * which must hold no ghosts. Each is given by one rank, any one, and goes to one that
     * owns a cell around its center. Mass is left to the caller. Throws DemError, on all
     * ranks, for a point outside the mesh. Collective.
     */
    void insert(const std::vector<NewParticle> &added, ParticleArrays &particles);

    /** Forgets all particles, on a mesh that may have changed. Collective. */
    void clear();

    /** All of a particle that changes its rank between two migrations. */
    struct Passenger
    {
      std::int64_t id = 0;
      Parcel       parcel;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &id &parcel;
      }
    };

    /**
     * Takes @p rows, own ones in ascending order, out of @p particles, which must hold no
     * ghosts; the last rows fill the gaps. Returns for each old own row its new one, or
     * no_row.
     */
    std::vector<std::uint32_t> release(ParticleArrays                   &particles,
                                       const std::vector<std::uint32_t> &rows);

    /** Puts @p passengers behind the own rows of @p particles, which must hold no ghosts.
     */
    void accept(ParticleArrays &particles, const std::vector<Passenger> &passengers);

    /** After clear(): puts @p passengers, of all ranks each one once, into @p particles,
     * wherever they are; the next migration brings them to where they belong. The next
     * particle gets the number @p next_number, or a higher one. Collective. */
    void begin_with(ParticleArrays               &particles,
                    const std::vector<Passenger> &passengers,
                    const std::int64_t            next_number);

    /** The contacts of some own rows, given to a migration to go with them. */
    using ContactsOf =
      std::function<std::vector<LooseContact>(const std::vector<std::uint32_t> &rows)>;

    /** What a migration did to the rows. */
    struct Moves
    {
      /** For each old own row its new one, or no_row if it is not here any more. */
      std::vector<std::uint32_t> new_row;
      /** Contacts of the particles that came from other ranks. */
      std::vector<LooseContact> arrived;
    };
    static constexpr std::uint32_t no_row = -1;

    /**
     * Finds the cell and rank of every particle and moves it there; removes first
     * those that are listed in @p departed, own rows, @p n_departed on all ranks.
     * Afterwards the arrays hold
     * own rows only, those of one cell contiguous. Collective. Throws DemError,
     * with number, last place and reason, for a lost particle. What deal.II gives
     * up (a particle exactly on a face; a long way within one migration) is
     * searched for by all ranks that have cells near it.
     */
    Moves migrate(ParticleArrays                   &particles,
                  const ContactsOf                 &contacts_of,
                  const std::vector<std::uint32_t> &departed,
                  const unsigned int                n_departed);

    /**
     * Divides the mesh among the ranks anew, so that the sum of @p cell_weight +
     * @p particle_weight * particles is even, and moves the particles along. They
     * must have migrated just before. Collective.
     */
    Moves repartition(ParticleArrays    &particles,
                      const ContactsOf  &contacts_of,
                      const unsigned int cell_weight,
                      const unsigned int particle_weight);

    /**
     * Refines and coarsens the mesh as marked, with the same weights, and finds the
     * particles in it anew: deal.II, which hands them from parent to child by itself,
     * may lose one on a face between two of them. Collective.
     */
    Moves adapt(ParticleArrays    &particles,
                const ContactsOf  &contacts_of,
                const unsigned int cell_weight,
                const unsigned int particle_weight);

    /**
     * Calls @p visit for each locally owned cell that holds particles, with the
     * first of its rows and the places of its particles in the unit cell, as of
     * the last migrate().
     */
    void visit_cells(const CellVisitor &visit) const;

    /** Particles on all ranks. */
    unsigned int
    n_global() const
    {
      return n_expected;
    }

    /** The id that the next particle without one gets. */
    std::int64_t
    next_number() const
    {
      return next_id;
    }

    MPI_Comm
    communicator() const
    {
      return mesh.communicator();
    }

  private:
    struct Location
    {
      CellIterator     cell;
      dealii::Point<3> reference;
      bool             found = false;
    };

    // A particle on its way into a cell, with its label.
    struct Traveller
    {
      unsigned int        id;
      dealii::Point<3>    position;
      std::vector<double> label;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &id &position &label;
      }
    };

    // Looks in own cells within reach of the point.
    Location locate(const dealii::Point<3> &point, const double reach) const;
    // For each point this rank if it has a cell for it, else the lowest rank that has,
    // or nobody. Collective.
    std::vector<unsigned int> find_owners(
      const std::vector<dealii::Point<3>> &points) const;
    // Puts a traveller into an own cell.
    void put_down(const Traveller &traveller);

    void set_places(const ParticleArrays             &particles,
                    const std::vector<std::uint32_t> &departed);
    // With @p from_neighbors nothing has come from further than the cells next to own
    // ones.
    Moves collect(ParticleArrays   &particles,
                  const ContactsOf &contacts_of,
                  const bool        from_neighbors);
    void  bring_home_strays();
    // Gives the next particles ids from a number on, of all ranks the highest.
    void number_from(const std::int64_t number);
    void check_count();

    struct CellRows
    {
      CellIterator                  cell;
      unsigned int                  first_row;
      std::vector<dealii::Point<3>> reference_locations;
    };

    VesselMesh                           &mesh;
    Subdomains                           &subdomains;
    dealii::GridTools::Cache<3>           cache;
    dealii::Particles::ParticleHandler<3> handler;
    std::vector<CellRows>                 cells;

    // What all ranks together must hold, and the next id to give away.
    unsigned int n_expected = 0;
    unsigned int next_id    = 0;

    // The row of each particle of the handler, by the number in its label, which is the
    // row that it had when it came into the handler; and the other way round.
    std::vector<std::uint32_t> row_of_label, label_of_row;

    // What deal.II gave up in the present migration.
    std::vector<Traveller> strays;
  };
} // namespace graupel

#endif
