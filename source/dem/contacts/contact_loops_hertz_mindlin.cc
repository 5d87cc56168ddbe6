// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/contact_loops.h>

namespace graupel
{
  template void ContactSweep::sweep_by<HertzMindlin>(ParticleArrays          &particles,
                                                     VerletList              &list,
                                                     const std::vector<Wall> &walls,
                                                     const Materials         &materials,
                                                     const double             dt);
} // namespace graupel
