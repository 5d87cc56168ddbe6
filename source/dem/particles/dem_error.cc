// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/dem_error.h>

namespace graupel
{
  void
  throw_together(const std::string &message, MPI_Comm communicator)
  {
    namespace mpi              = dealii::Utilities::MPI;
    const unsigned int n_ranks = mpi::n_mpi_processes(communicator);
    const unsigned int culprit = mpi::min(
      message.empty() ? n_ranks : mpi::this_mpi_process(communicator), communicator);
    if (culprit < n_ranks)
      throw DemError(mpi::broadcast(communicator, message, culprit));
  }
} // namespace graupel
