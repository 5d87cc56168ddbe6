// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_integration_h
#define graupel_dem_integration_h

#include <graupel/dem/contacts/contact_sweep.h>
#include <graupel/dem/numbers/period.h>

namespace graupel
{
  /** What a substep of velocity Verlet needs to know. */
  struct Integration
  {
    /** Units of the loads. */
    ForceQuanta quanta;
    /** Acceleration of gravity [m/s^2]. */
    dealii::Tensor<1, 3> gravity;
    /** Substep [s]. */
    double step;
    /** Whether some external force is not zero. */
    bool external_forces;
    /** The same of the torques. */
    bool external_torques;
    /** Of the vessel's ends. */
    Period period;
  };

  /**
   * Ends a substep: velocities and spins of the own rows from those of its
   * middle and the loads of its end.
   */
  void kick(ParticleArrays &particles, const Integration &integration);

  /**
   * Begins a substep: velocities of its middle from those of its begin and the
   * loads there, new positions, velocities predicted to its end; sets the loads
   * to zero. Returns the square of the largest speed [m^2/s^2]; infinity if some
   * speed is no number.
   */
  double drift(ParticleArrays &particles, const Integration &integration);

  /** kick() and drift() in one pass: the same, bit by bit. */
  double kick_and_drift(ParticleArrays &particles, const Integration &integration);
} // namespace graupel

#endif
