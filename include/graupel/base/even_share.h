// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_even_share_h
#define graupel_base_even_share_h

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>

namespace graupel
{
  /** The sum of @p n on the lower ranks. Collective. */
  inline std::int64_t
  on_lower_ranks(const std::int64_t n, MPI_Comm communicator)
  {
    std::int64_t below = 0;
    const int    ierr  = MPI_Exscan(&n, &below, 1, MPI_INT64_T, MPI_SUM, communicator);
    AssertThrowMPI(ierr);
    // On the first rank it is undefined.
    return dealii::Utilities::MPI::this_mpi_process(communicator) == 0 ? 0 : below;
  }

  /** Numbers from begin to end - 1. */
  struct Share
  {
    std::int64_t begin = 0, end = 0;
  };

  /** This rank's share of 0 to @p n - 1, which are divided evenly among all ranks in
   * their order. */
  inline Share
  even_share(const std::int64_t n, MPI_Comm communicator)
  {
    const std::int64_t n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const std::int64_t rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const auto         begin   = [&](const std::int64_t of) {
      return n / n_ranks * of + std::min(of, n % n_ranks);
    };
    return {begin(rank), begin(rank + 1)};
  }
} // namespace graupel

#endif
