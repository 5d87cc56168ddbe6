// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_loose_contact_h
#define graupel_dem_particles_loose_contact_h

#include <graupel/dem/laws/contact_laws.h>

#include <cstdint>

namespace graupel
{
  /**
   * A contact by the ids of its bodies: the form in which springs outlive the
   * numbering of rows, travel to another rank, and rest in a checkpoint.
   */
  struct LooseContact
  {
    /** The lower id, from which the contact is seen. */
    std::int64_t first = 0;
    /** The higher id, or a negative wall_id(). */
    std::int64_t    second = 0;
    Springs<double> springs;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &first &second &springs.tangential.x &springs.tangential.y &springs
        .tangential.z &springs.rolling.x &springs.rolling.y &springs.rolling.z;
    }
  };
} // namespace graupel

#endif
