// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_contact_output_h
#define graupel_simulation_contact_output_h

#include <graupel/dem/contacts/contact_sweep.h>
#include <graupel/simulation/files/vtu_piece.h>

namespace graupel
{
  /**
   * The @p contacts of this rank, every one on one rank only, as lines for ParaView, from
   * center to center, or from a center to the contact point on a wall: normal force [N],
   * positive where the two press on each other, tangential force [N], overlap [m],
   * whether the partner is a wall, and the force on the particle at the first end [N].
   * Each value is the same at both ends. A tube filter whose radius follows the normal
   * force shows the force chains.
   */
  VtuPiece contact_output(const std::vector<ContactState> &contacts);
} // namespace graupel

#endif
