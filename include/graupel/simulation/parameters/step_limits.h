// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_step_limits_h
#define graupel_simulation_parameters_step_limits_h

#include <graupel/simulation/parameters/run_parameters.h>

namespace graupel
{
  /** Void fraction of a bed that is not there yet, for estimates only [-]. */
  constexpr double guessed_void_fraction = 0.4;

  /** Steps of the fluid [s] that resolve what moves in a bed. */
  struct StepLimits
  {
    /** The response of the particles to the drag (stable_step()). */
    double response = 0.;
    /** The fluid's way over a cell, by the Courant number in force. */
    double courant = 0.;
  };

  /**
   * Those in a bed at rest of this @p void_fraction [-] through which fluid flows with
   * the superficial @p velocity [m/s]: of the particles that respond soonest, and over a
   * cell's height with the interstitial velocity; infinite at no velocity.
   */
  StepLimits limits_at_rest(const RunParameters &parameters,
                            const double         void_fraction,
                            const double         velocity);

  /** What is wrong with a @p step beyond the response @p limit, both in [s], and the
   * remedy: the end of a sentence. */
  std::string long_step(const double step, const double limit);

  /** What a run is warned of beforehand: a step, a filter or a scale that is valid but
   * does not resolve what it should. A sentence each, with number and remedy. */
  std::vector<std::string> warnings(const RunParameters &parameters);

  /** What is no mistake, but to be known when results are read: cells longer than a
   * particle or the filter, and a friction of packing that is not that of the flow. A
   * sentence each. */
  std::vector<std::string> notes(const RunParameters &parameters);
} // namespace graupel

#endif
