// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_say_h
#define graupel_tests_say_h

#include <deal.II/base/mpi.h>

#include <iostream>

/** std::cout on the first rank, nowhere on the others. */
inline std::ostream &
say()
{
  static std::ostream nowhere(nullptr);
  return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout
                                                                       : nowhere;
}

#endif
