#ifndef graupel_dem_particle_store_h
#define graupel_dem_particle_store_h

#include <graupel/dem/particle_arrays.h>
#include <graupel/dem/spring_table.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/particles/particle_handler.h>

#include <functional>
#include <vector>

namespace graupel
{
  /**
   * The owner of the particles between substeps: which cell and which rank each
   * one is in. The only class of the program that names deal.II's
   * ParticleHandler, in whose properties everything travels that a particle
   * has: velocities, forces, external force, radius and the springs of its
   * contacts.
   *
   * While the DEM runs, the arrays are the truth and the store is old; scatter()
   * makes it current, gather() the other way round.
   */
  class ParticleStore
  {
  public:
    using CellIterator = dealii::Triangulation<3>::active_cell_iterator;
    using CellVisitor =
      std::function<void(const CellIterator                  &cell,
                         const unsigned int                   first_row,
                         const std::vector<dealii::Point<3>> &reference_locations)>;

    /** @p density: of all particles [kg/m^3]. @p mesh must outlive the store. */
    ParticleStore(const CylinderMesh &mesh, const double density);

    /**
     * Adds spheres at @p positions [m], with the next free ids, at rest but for
     * @p velocity [m/s]. The same call on every rank, collective; each sphere
     * goes to the lowest rank that owns a cell around its center. The store
     * must be current, and the arrays be gathered again afterwards. Throws
     * DemError for a point outside the mesh.
     */
    void insert(const std::vector<dealii::Point<3>> &positions,
                const double                         radius,
                const dealii::Tensor<1, 3>          &velocity);

    /**
     * Finds the cell and rank of every particle and moves it there. Collective.
     * Throws DemError, with number, last place and reason, for a lost particle.
     * What deal.II gives up (a particle exactly on a face; a long way within one
     * migration) is searched for in all cells of all ranks.
     */
    void migrate();

    /**
     * Copies everything to @p particles (own rows only) and @p table; rows of
     * one cell are contiguous. To be called after insert() and migrate().
     */
    void gather(ParticleArrays &particles, SpringTable &table);

    /** Copies the own rows of @p particles and @p table back. */
    void scatter(const ParticleArrays &particles, const SpringTable &table);

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

    // A particle on its way into a cell, with all that it has.
    struct Traveller
    {
      unsigned int        id;
      dealii::Point<3>    position;
      std::vector<double> properties;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &id &position &properties;
      }
    };

    // Looks in own cells within reach of the point.
    Location locate(const dealii::Point<3> &point, const double reach) const;
    // Puts each traveller, the same on all ranks, into a cell of the lowest rank
    // that has one for it; tells which ones found a cell. Collective.
    std::vector<bool> place(const std::vector<Traveller> &travellers);
    void              bring_home_strays();
    void              check_count() const;

    struct CellRows
    {
      CellIterator                  cell;
      unsigned int                  first_row;
      std::vector<dealii::Point<3>> reference_locations;
    };

    const CylinderMesh                   &mesh;
    const double                          density;
    dealii::GridTools::Cache<3>           cache;
    dealii::Particles::ParticleHandler<3> handler;
    std::vector<CellRows>                 cells;

    // What all ranks together must hold, and the next id to give away.
    unsigned int n_expected = 0;
    unsigned int next_id    = 0;

    // What deal.II gave up in the present migration, and where each particle was
    // before, to name one that is lost.
    std::vector<Traveller>                                 strays;
    std::vector<std::pair<unsigned int, dealii::Point<3>>> last_places;
  };
} // namespace graupel

#endif
