// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_time_scheme_h
#define graupel_fluid_time_scheme_h

namespace graupel
{
  /**
   * Backward differentiation with variable steps:
   *
   *   dy/dt (t_n+1) = now y_n+1 + old y_n + older y_n-1,
   *
   * weights in [1/s]. Of order 1 (BDF1) with two levels, of order 2 (BDF2) with
   * three. Source: Hairer, Norsett, Wanner, Solving Ordinary Differential
   * Equations I (1993), ch. III.5.
   */
  struct TimeScheme
  {
    double now   = 0.;
    double old   = 0.;
    double older = 0.;
  };

  /** BDF1 for the step @p step [s]. */
  TimeScheme bdf1(const double step);

  /** BDF2 for the step @p step after a step of @p last_step [s]. */
  TimeScheme bdf2(const double step, const double last_step);
} // namespace graupel

#endif
