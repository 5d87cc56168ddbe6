// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_checkpoint_h
#define graupel_simulation_files_checkpoint_h

#include <graupel/dem/dem_state.h>
#include <graupel/simulation/files/result_files.h>
#include <graupel/simulation/parameters/run_parameters.h>

namespace graupel
{
  /** Where a run is, beside particles, mesh and fields. */
  struct RunState
  {
    /** Every parameter by its path, as text. */
    std::map<std::string, std::string> parameters;

    double                  time             = 0.; // simulated [s]
    double                  next_output      = 0.; // [s]
    double                  next_observation = 0.; // of packing [s]
    double                  next_adaption    = 0.; // [s]
    BedResult               rest;
    std::vector<CaseResult> cases;                 // those that have ended
    double                  last_velocity = 0.;    // V of the last of them [m/s]
    bool                    has_begun     = false; // the first flow case
    std::string             feeds;                 // Feeds::State
    Ledger                  ledger;
    CostSheet               costs; // of all ranks
    double                  wall_seconds = 0., cpu_seconds = 0.;
    ResultFiles::Written    written;

    /** The phase that comes or goes on, and where it is; empty if it has not begun. */
    std::size_t phase_number = 0;
    std::string phase;
    /** V of the flow case that comes or goes on [m/s]. */
    Value velocity;

    bool                      has_fluid = false;
    FlowHistory               fluid;
    double                    stable_step   = 0.; // CoupledFlow::stable_step() [s]
    double                    averaged_time = 0.; // FieldAverages::averaged_time() [s]
    std::vector<unsigned int> partition;          // of the mesh
  };

  /** A checkpoint that was read. */
  struct Checkpoint
  {
    std::string folder;
    RunState    state;
    /** A share of them on each rank. */
    DemState particles;
    /** What is to be said of it: damage to a later one, parameters that have changed. */
    std::vector<std::string> told;
  };

  /**
   * Writes the checkpoint @p folder: @p state (as rank 0 has it), the @p particles of all
   * ranks (see write_particles()) and whatever @p write_more puts into files whose names
   * begin with its argument. A list of these with their checksums goes into state.bin,
   * which is written last. The last checkpoint stays as FOLDER.old; wherever the program
   * is killed, one or the other is whole. Collective.
   */
  void write_checkpoint(const std::string                              &folder,
                        const RunState                                 &state,
                        const DemState                                 &particles,
                        const std::function<void(const std::string &)> &write_more,
                        MPI_Comm                                        communicator);

  /** Where write_more() of the checkpoint @p folder has put its files. */
  std::string checkpoint_fields(const std::string &folder);

  /**
   * Reads the last checkpoint that is whole: @p folder, or the one before. Throws
   * InputError("Output/directory", ...) without one, with the files that are missing or
   * damaged, and InputError naming the parameter where a value differs that a resumed run
   * may not change (may_change()). Collective.
   */
  Checkpoint read_checkpoint(const std::string   &folder,
                             const RunParameters &parameters,
                             MPI_Comm             communicator);

  /** Writes a settled bed to @p file. Collective. */
  void write_bed(const std::string   &file,
                 const RunParameters &parameters,
                 const DemState      &particles,
                 MPI_Comm             communicator);

  /** Reads it, each rank a share of the particles. Throws InputError("Filling/start
   * from", ...) where there is none, and InputError naming the parameter where it is
   * another vessel's or other particles. Collective. */
  DemState read_bed(const std::string   &file,
                    const RunParameters &parameters,
                    MPI_Comm             communicator);
} // namespace graupel

#endif
