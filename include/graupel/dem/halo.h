#ifndef graupel_dem_halo_h
#define graupel_dem_halo_h

#include <graupel/dem/particle_arrays.h>
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
   * one next to it. On one rank nothing is done.
   */
  class Halo
  {
  public:
    /** @p reach: the distance within which a rank must see all particles [m]. */
    Halo(const Cylinder &cylinder, const double reach, MPI_Comm communicator);
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
      int                       rank;
      std::vector<unsigned int> rows;
      unsigned int              first_ghost;
      unsigned int              n_ghosts;
      std::vector<double>       outgoing;
      std::vector<double>       incoming;
    };

    std::vector<unsigned char> occupied_bins(const ParticleArrays &particles) const;
    unsigned int               bin(const dealii::Point<3> &x) const;
    void                       choose_rows(const ParticleArrays &particles);
    void                       exchange_identities(ParticleArrays &particles);
    void                       start_requests();
    void                       free_requests();

    MPI_Comm                    communicator;
    const unsigned int          n_ranks;
    dealii::Point<3>            corner;
    double                      bin_size;
    std::array<unsigned int, 3> n_bins;
    std::vector<Neighbor>       neighbors;
    std::vector<MPI_Request>    requests;
  };
} // namespace graupel

#endif
