#ifndef graupel_dem_dem_state_h
#define graupel_dem_dem_state_h

#include <graupel/dem/particles/loose_contact.h>
#include <graupel/dem/particles/parcel.h>

#include <array>
#include <vector>

namespace graupel
{
  /**
   * The particles and their contacts by themselves, without mesh and ranks, for a
   * checkpoint.
   */
  struct DemState
  {
    struct Particle
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
