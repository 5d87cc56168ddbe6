#ifndef graupel_dem_dem_state_h
#define graupel_dem_dem_state_h

#include <graupel/dem/loose_contact.h>

#include <array>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * The particles and their contacts by themselves, without mesh and ranks, for a
   * checkpoint.
   */
  struct DemState
  {
    /** A particle; see ParticleArrays. */
    struct Particle
    {
      std::int64_t                id   = 0;
      unsigned char               type = 0;
      std::array<double, 16>      body;           // as Body
      std::array<std::int64_t, 8> load;           // [quanta]
      std::array<double, 3>       external_force; // [N]

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &id &type &body &load &external_force;
      }
    };

    /** Sorted by id. */
    std::vector<Particle>     particles;
    std::vector<LooseContact> contacts;
    /** Points of the planes among the walls, which may have moved [m]. */
    std::vector<std::array<double, 3>> planes;
    /** Particles that have left. */
    unsigned int n_departed = 0;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &particles &contacts &planes &n_departed;
    }
  };
} // namespace graupel

#endif
