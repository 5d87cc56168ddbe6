// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/parcel.h>

#include <cstring>

namespace graupel
{
  Parcel
  pack(const ParticleArrays &p, const unsigned int row)
  {
    Parcel parcel;
    parcel.type = p.type[row];
    parcel.mass = p.mass[row];
    std::memcpy(parcel.body.data(), &p.body[row], sizeof(Body));
    parcel.load           = p.load[row].quanta;
    parcel.solid_fraction = p.solid_fraction[row];
    for (unsigned int d = 0; d < 3; ++d)
      {
        parcel.external_force[d]  = p.external_force[row][d];
        parcel.external_torque[d] = p.external_torque[row][d];
      }
    return parcel;
  }

  void
  unpack(const Parcel &parcel, ParticleArrays &p, const unsigned int row)
  {
    p.type[row]           = parcel.type;
    p.mass[row]           = parcel.mass;
    p.body[row]           = body_of(parcel);
    p.load[row].quanta    = parcel.load;
    p.solid_fraction[row] = parcel.solid_fraction;
    for (unsigned int d = 0; d < 3; ++d)
      {
        p.external_force[row][d]  = parcel.external_force[d];
        p.external_torque[row][d] = parcel.external_torque[d];
      }
  }

  Body
  body_of(const Parcel &parcel)
  {
    Body body;
    std::memcpy(static_cast<void *>(&body), parcel.body.data(), sizeof(Body));
    return body;
  }
} // namespace graupel
