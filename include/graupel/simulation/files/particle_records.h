// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_particle_records_h
#define graupel_simulation_files_particle_records_h

#include <graupel/dem/dem_state.h>

#include <deal.II/base/mpi.h>

#include <istream>

namespace graupel
{
  /**
   * Writes a file of @p head, as the first rank has it, and then, as records of one
   * length each, the particles and the contacts of all ranks, each by the rank that has
   * them:
   *
   *   head | number of particles, of contacts | particles | contacts | checksum
   *
   * Where the contacts of a particle begin is counted over the whole file. Throws
   * FileError, on all ranks, if it cannot be written. Collective.
   */
  void write_particles(const std::string &file,
                       const std::string &head,
                       const DemState    &state,
                       MPI_Comm           communicator);

  /** What is wrong with a file of write_particles(), to be asked before it is read: that
   * it is missing, or is not what was written. Empty if nothing. Collective. */
  std::string problem_of_records(const std::string &file, MPI_Comm communicator);

  /** Reads an even share of the particles of a file without problem_of_records(), whose
   * head has just been read from @p stream, into @p state. */
  void read_particles(std::istream &stream, DemState &state, MPI_Comm communicator);
} // namespace graupel

#endif
