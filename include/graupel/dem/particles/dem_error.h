// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_dem_error_h
#define graupel_dem_particles_dem_error_h

#include <deal.II/base/mpi.h>

#include <stdexcept>
#include <string>

namespace graupel
{
  /**
   * The particles reached a state from which the run cannot go on: overlap out
   * of range, a lost particle, a column that is full. Says which particle,
   * where, and what to try.
   */
  class DemError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * Throws DemError on every rank of @p communicator if @p message is not empty
   * on some rank, with the message of the lowest such rank, so that no rank is
   * left waiting for one that has stopped. Collective.
   */
  void throw_together(const std::string &message, MPI_Comm communicator);
} // namespace graupel

#endif
