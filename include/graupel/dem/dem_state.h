// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_dem_state_h
#define graupel_dem_dem_state_h

#include <graupel/dem/particles/loose_contact.h>
#include <graupel/dem/particles/parcel.h>

#include <boost/serialization/string.hpp>

#include <array>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * The particles and their contacts by themselves, without mesh and ranks, for a
   * checkpoint. Each rank has some particles, all ranks together each of them once.
   */
  struct DemState
  {
    struct Particle
    {
      std::int64_t id = 0;
      /** Its first contact in contacts; the last is before the first of the next one. */
      std::int64_t first_contact = 0;
      Parcel       parcel;
    };

    /** A wall by its name, so that it is found in another vessel. */
    struct Wall
    {
      std::string name;
      /** Equal where the facets have the same numbers (see Wall::fingerprint()). */
      std::uint64_t shape = 0;
      /** Where it has moved to, from where it was built [m], [rad]. */
      std::array<double, 3> shift = {};
      double                angle = 0.;
      /** A point on the axis that it has turned about [m], and its direction. */
      std::array<double, 6> axis = {};

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &name &shape &shift &angle &axis;
      }
    };

    /** What is the same on all ranks. */
    struct Common
    {
      std::vector<Wall> walls;
      /** Whether the clock runs, and what it shows [s]. */
      bool   clock_runs = false;
      double clock      = 0.;
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
        archive &walls &clock_runs                                &clock;
        archive &departed &departed_volume &solid_volume &next_id &packing_materials;
        archive &force_quantum                                    &torque_quantum;
      }
    };

    std::vector<Particle> particles;
    /** For each particle in turn those that it takes part in, so that one between two
     * particles is there twice. Those with walls name them by their place in
     * Common::walls. */
    std::vector<LooseContact> contacts;
    Common                    common;
  };
} // namespace graupel

#endif
