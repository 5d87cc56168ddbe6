// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_studies_study_runs_h
#define graupel_simulation_studies_study_runs_h

#include <graupel/simulation/files/summary.h>
#include <graupel/simulation/studies/study.h>

namespace graupel
{
  /** What a packed-bed run came to, case by case, as a level of a study. */
  LevelResult packed_bed_level(const RunParameters &parameters, const Summary &summary);

  /**
   * Computes the manufactured flow of @p parameters, writes its fields for ParaView into
   * @p directory, and gives its errors as a level of a study. Collective.
   */
  LevelResult manufactured_level(const RunParameters &parameters,
                                 const std::string   &directory,
                                 Progress            &progress,
                                 MPI_Comm             communicator);
} // namespace graupel

#endif
