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
    /** Particles that have left, by type, and their volume [m^3]. */
    std::vector<unsigned long> departed;
    std::vector<double>        departed_volume;
    /** Volume of the particles of each type, as it was summed up; empty: to be summed
     * anew [m^3]. */
    std::vector<double> solid_volume;
    /** The number that the next particle gets; at least one above all that are here. */
    std::int64_t next_id = 0;
    /** Whether the friction of packing is in force. */
    bool packing_materials = false;
    /** Quanta in which the loads of the particles are counted; 0: of the reader's own
     * [N, N m]. */
    double force_quantum = 0., torque_quantum = 0.;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &particles &contacts &planes &departed &departed_volume &solid_volume
        &next_id &packing_materials &force_quantum &torque_quantum;
    }
  };
} // namespace graupel

#endif
