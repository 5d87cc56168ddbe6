// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_history_h
#define graupel_fluid_flow_history_h

namespace graupel
{
  /**
   * What a flow knows of its past beside its fields: with those of FlowSolver::save() all
   * that the next step depends on. Trivially copyable, for a checkpoint.
   */
  struct FlowHistory
  {
    /** The time of the flux [s]. */
    double time = 0.;
    /** The last step, 0 before the first [s]. */
    double last_step = 0.;
    /** V of the boundary conditions in it [m/s]. */
    double last_velocity = 0.;
    /** Steps since the flow began or was continued: for void fraction and flux, and for
     * the flux that the mesh does not resolve [-]. */
    unsigned int known_media = 0, known_unresolved = 0;
    /** Iterations of the linear solver: with the preconditioner new, and last [-]. */
    unsigned int fresh_iterations = 0, last_iterations = 0;
    /** FlowCoefficients::rate, subscale_rate and speed of the matrix that the
     * preconditioner was made of [1/s], [1/s], [m/s]; the first negative: there is none.
     */
    double preconditioned_rate = -1., preconditioned_subscale_rate = 0.,
           preconditioned_speed = 0.;
    /** Whether solids moved in that matrix. */
    bool preconditioned_solids = false;
    /** By how many iterations the last step took more than the one before, with the same
     * preconditioner [-]. */
    unsigned int iteration_growth = 0;
  };
} // namespace graupel

#endif
