#ifndef graupel_coupling_particle_transfer_h
#define graupel_coupling_particle_transfer_h

#include <graupel/dem/particles/particle_store.h>
#include <graupel/mesh/nodal_space.h>

namespace graupel
{
  /**
   * The weights w_pk = psi_k(x_p) of this rank's particles on the nodes, used
   * both ways: deposit() is W^T, sample() is W.
   */
  class ParticleTransfer
  {
  public:
    /** @p nodes must outlive this object. */
    explicit ParticleTransfer(const NodalSpace &nodes);

    /** Takes over where the particles are, as of the store's last migration. */
    void update(const ParticleStore &store);

    /** W^T v: @p values has a number for each own particle; @p sums is overwritten. */
    void deposit(NodalVector &sums, const std::vector<double> &values) const;

    /** W f at each own particle; the ghosts of @p field must be up to date. */
    void sample(std::vector<double> &values, const NodalVector &field) const;

    /** Where a particle is in its cell. */
    struct Place
    {
      /** Mean lengths of the cell's edges in each of its directions [m]. */
      std::array<double, 3> edge;
      /** x (1 - x) in each, with the part x of the edge that is behind the particle [-].
       */
      std::array<double, 3> mixing;

      /** How far its weights lie from it, sum of w_pk |x_k - x_p|^2 [m^2]. */
      double
      variance() const
      {
        return edge[0] * edge[0] * mixing[0] + edge[1] * edge[1] * mixing[1] +
               edge[2] * edge[2] * mixing[2];
      }
    };

    /** By row. */
    const std::vector<Place> &
    places() const
    {
      return place;
    }

  private:
    static constexpr unsigned int n_nodes = dealii::GeometryInfo<3>::vertices_per_cell;

    struct Cell
    {
      unsigned int                                 first_row, end_row;
      std::vector<dealii::types::global_dof_index> nodes;
      std::array<unsigned int, n_nodes>            local_nodes;
    };

    const NodalSpace                        &nodes;
    std::vector<Cell>                        cells;
    std::vector<std::array<double, n_nodes>> weights; // by row
    std::vector<Place>                       place;
  };
} // namespace graupel

#endif
