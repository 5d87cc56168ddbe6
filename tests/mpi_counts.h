// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_mpi_counts_h
#define graupel_tests_mpi_counts_h

#include <map>
#include <string>

namespace graupel
{
  /** Calls of one kind, and the bytes that this rank gave to them. */
  struct MpiCount
  {
    double calls = 0.;
    double bytes = 0.;
  };

  /** By kind: "message" for everything that goes from one rank to another; of the
   * collectives, the name of the function without MPI_. */
  using MpiCounts = std::map<std::string, MpiCount>;

  /**
   * What this rank has asked of MPI so far. The functions are counted by their profiling
   * interface, in every library of a program that mpi_counts.cc is linked into.
   */
  MpiCounts mpi_counts();

  /** What came between two of them. */
  MpiCounts operator-(MpiCounts later, const MpiCounts &earlier);

  /** A part of each. */
  MpiCounts operator*(const double factor, MpiCounts counts);

  /** Collectives that keep a rank until the others come. */
  double n_blocking_collectives(const MpiCounts &counts);
} // namespace graupel

#endif
