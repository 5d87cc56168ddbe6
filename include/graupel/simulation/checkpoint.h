#ifndef graupel_simulation_checkpoint_h
#define graupel_simulation_checkpoint_h

#include <graupel/dem/dem_state.h>
#include <graupel/fluid/flow_history.h>
#include <graupel/simulation/result_files.h>
#include <graupel/simulation/run_parameters.h>
#include <graupel/simulation/summary.h>

namespace graupel
{
  /** What a continued run has in common with the one before: values by parameter. */
  using Identity = std::map<std::string, double>;

  /** Where a run is, beside particles, mesh and fields. */
  struct RunState
  {
    Identity                identity;
    double                  time        = 0.; // simulated [s]
    double                  next_output = 0.; // [s]
    BedResult               bed;
    std::vector<CaseResult> cases; // those that have ended
    Ledger                  ledger;
    CostSheet               costs; // of all ranks
    double                  wall_seconds = 0., cpu_seconds = 0.;
    ResultFiles::Written    written;

    bool                    has_fluid = false;
    FlowHistory             fluid;
    bool                    in_case    = false; // within a flow case,
    double                  ramp_from  = 0.;    // superficial velocity before [m/s]
    double                  velocity   = 0.;    // of this superficial velocity [m/s],
    double                  case_begin = 0.;    // that began then [s]
    std::vector<MonitorRow> case_rows;
  };

  /** The values that must not change within a run, mesh included. */
  Identity identity_of_run(const RunParameters &parameters);
  /** The values that a bed is made for. */
  Identity identity_of_bed(const RunParameters &parameters);

  /**
   * Writes the checkpoint @p folder in place of the last one: @p state and @p particles
   * (both as rank 0 has them) and whatever @p write_more puts into files whose names
   * begin with its argument. The last checkpoint stays until the new one is whole.
   * Collective.
   */
  void write_checkpoint(const std::string                              &folder,
                        const RunState                                 &state,
                        const DemState                                 &particles,
                        const std::function<void(const std::string &)> &write_more,
                        MPI_Comm                                        communicator);

  /** Where write_more() of the checkpoint @p folder has put its files. */
  std::string checkpoint_fields(const std::string &folder);

  /**
   * Reads a checkpoint on every rank. Throws InputError("Output/directory", ...) without
   * one, and InputError naming the parameter where it is another run's by @p identity.
   */
  std::pair<RunState, DemState> read_checkpoint(const std::string &folder,
                                                const Identity    &identity);

  /** Writes a settled bed to @p file, on the rank that calls. */
  void write_bed(const std::string &file,
                 const Identity    &identity,
                 const DemState    &particles);

  /** Reads it. Throws InputError("Filling/start from", ...) where there is none, and
   * InputError naming the parameter where it is another vessel's or other particles. */
  DemState read_bed(const std::string &file, const Identity &identity);
} // namespace graupel

#endif
