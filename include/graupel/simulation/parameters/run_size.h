// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_run_size_h
#define graupel_simulation_parameters_run_size_h

#include <graupel/simulation/parameters/run_parameters.h>

namespace graupel
{
  /** Memory of the program itself, on each rank [GB]. */
  constexpr double memory_of_rank = 0.15;

  /**
   * How large a run will be, as far as its parameters say: numbers of cells are those of
   * the mesh without adaption, particles those of the filling; all else is a guess that
   * may be wrong by a factor of two or three.
   */
  struct RunSize
  {
    double cells = 0., particles = 0.;
    /** Of the particles, in the whole run, and of the fluid; at most. */
    double substeps = 0., fluid_steps = 0.;
    /** Sets of ParaView files. */
    double outputs = 0.;
    /** Memory of all ranks beside that of the program, and all files [bytes]. */
    double memory = 0., disk = 0.;
    /** CPU time of all ranks [s]. */
    double cpu_seconds = 0.;
    /** Whether cases end when they are steady, so that steps and time are often far
     * fewer. */
    bool cases_may_end = false;
  };

  /** That of a run of @p parameters. Throws InputError where files cannot be read. */
  RunSize expected_size(const RunParameters &parameters);

  /**
   * Throws InputError, with the number, for a run that does not end or has no room:
   * numbers of steps or of files beyond any patience, more memory than this machine has
   * for its ranks. Collective.
   */
  void check_size(const RunParameters &parameters, MPI_Comm communicator);
} // namespace graupel

#endif
