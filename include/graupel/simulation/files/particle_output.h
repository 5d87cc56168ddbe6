// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_particle_output_h
#define graupel_simulation_particle_output_h

#include <graupel/dem/dem.h>
#include <graupel/simulation/files/vtu_piece.h>

namespace graupel
{
  /**
   * The own particles of this rank as points for ParaView: id, type, number of contacts
   * with particles and with walls [-], diameter [m], velocity [m/s], spin [rad/s], mean
   * normal stress [Pa], contact force [N], fluid force [N].
   */
  VtuPiece particle_output(const Dem &dem);
} // namespace graupel

#endif
