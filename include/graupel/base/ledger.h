// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_ledger_h
#define graupel_base_ledger_h

namespace graupel
{
  /**
   * The worst relative errors of what the equations conserve, over all steps
   * recorded so far. The same on every rank if every rank records the same.
   */
  struct Ledger
  {
    /** |inflow - outflow - stored| over the inflow [-]. */
    double max_mass_imbalance = 0.;
    /** |momentum to the fluid + momentum to the particles| over either [-]. */
    double max_momentum_imbalance = 0.;
    /** |solid volume on the mesh - volume of the particles| over the latter [-]. */
    double max_solid_volume_error = 0.;

    /**
     * Records one step; the sign of an error does not matter. Throws
     * std::runtime_error naming the quantity if an error is not a finite
     * number. It is then kept as the worst, whatever is recorded afterwards.
     */
    void record(const double mass_imbalance,
                const double momentum_imbalance,
                const double solid_volume_error);
  };
} // namespace graupel

#endif
