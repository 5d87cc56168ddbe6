// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_summary_h
#define graupel_simulation_files_summary_h

#include <graupel/closures/fluid_properties.h>
#include <graupel/simulation/observers/case_result.h>

#include <mpi.h>

namespace graupel
{
  /** Everything that summary.json tells. */
  struct Summary
  {
    std::string             parameter_file;
    std::string             reference;   // that the report compares with
    unsigned int            cells  = 0;  // of the mesh, at the end
    double                  volume = 0.; // of the mesh [m^3]
    BedResult               bed;
    std::vector<CaseResult> cases;
    FluidProperties         fluid;
    Ledger                  ledger;
    CostSheet               costs;
    double                  wall_seconds = 0.; // of the whole run [s]
    double                  cpu_seconds  = 0.; // of this rank [s]
  };

  /**
   * Writes summary.json on rank 0: counts and CPU time summed over the ranks,
   * seconds of each activity the largest of any rank. The file appears whole or
   * not at all. Collective.
   */
  void write_summary(const std::string &path,
                     const Summary     &summary,
                     MPI_Comm           communicator);
} // namespace graupel

#endif
