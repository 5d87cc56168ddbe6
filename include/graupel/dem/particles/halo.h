#ifndef graupel_dem_particles_halo_h
#define graupel_dem_particles_halo_h

#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/mesh/cylinder.h>

#include <vector>

namespace graupel
{
  /**
   * Copies of other ranks' particles near this rank's own, chosen by distance
   * and not by cells: on a locally refined mesh one layer of ghost cells can be
   * thinner than a particle.
   *
   * Every rank publishes which bins (cubes of the size of the reach) its
   * particles occupy; a particle goes to every rank that occupies its bin or
   * one next to it. On one rank without periodic ends nothing is done.
   */
  class Halo
  {
  public:
    /**
     * @p reach: the distance within which a rank must see all particles [m]. With
     * @p periodic ends, particles near one end are copied beyond the other as well,
     * a height away, also for their own rank.
     */
    Halo(const Cylinder &cylinder,
         const double    reach,
         const bool      periodic,
         MPI_Comm        communicator);

    /** Whether there can be ghosts at all. */
    bool
    is_needed() const
    {
      return n_ranks > 1 || shifts.size() > 1;
    }
    ~Halo();

    Halo(const Halo &)            = delete;
    Halo &operator=(const Halo &) = delete;

    /**
     * Decides anew who sends what, and replaces the ghost rows of @p particles,
     * complete with positions and velocities. Collective.
     */
    void rebuild(ParticleArrays &particles);

    /**
     * Brings the bodies of the ghost rows up to date. Collective among neighbours.
     */
    void refresh(ParticleArrays &particles);

  private:
    struct Neighbor
    {
      int rank;
      // Number of the shift that the receiver's copies have.
      unsigned int              shift;
      std::vector<unsigned int> rows;
      unsigned int              first_ghost;
      unsigned int              n_ghosts;
      std::vector<double>       outgoing;
      std::vector<double>       incoming;
    };

    std::vector<unsigned char> occupied_bins(const ParticleArrays &particles) const;
    unsigned int               bin(const dealii::Point<3> &x) const;
    std::vector<unsigned char> bins_near(const unsigned char *occupied) const;
    void                       choose_rows(const ParticleArrays &particles);
    void                       exchange_identities(ParticleArrays &particles);
    void                       start_requests();
    void                       free_requests();

    MPI_Comm           communicator;
    const unsigned int n_ranks;
    dealii::Point<3>   corner;
    double             height;
    double             bin_size;
    // Added to the height of what is sent [m]: 0, and with periodic ends up and
    // down by the height of the vessel.
    std::vector<double>         shifts;
    std::array<unsigned int, 3> n_bins;
    std::vector<Neighbor>       neighbors;
    std::vector<MPI_Request>    requests;
  };
} // namespace graupel

#endif
