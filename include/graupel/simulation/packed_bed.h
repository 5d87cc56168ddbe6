#ifndef graupel_simulation_packed_bed_h
#define graupel_simulation_packed_bed_h

#include <graupel/base/progress.h>
#include <graupel/simulation/checkpoint.h>
#include <graupel/simulation/coupled_flow.h>
#include <graupel/simulation/result_files.h>
#include <graupel/simulation/summary.h>

namespace graupel
{
  /**
   * A packed-bed run, in its order of events: fill the vessel, let the bed
   * settle, drive the fluid through it at one superficial velocity after the
   * other, write down what happened.
   */
  class PackedBed
  {
  public:
    /**
     * @p parameters are checked; @p files and @p progress must outlive this object.
     * @p parameter_file is named in the summary.
     */
    PackedBed(const RunParameters &parameters,
              const std::string   &parameter_file,
              ResultFiles         &files,
              Progress            &progress,
              MPI_Comm             communicator);

    /**
     * Runs to the end and writes all files but report.html; with @p resume, from the
     * checkpoint in the output directory on. Collective.
     */
    void run(const bool resume = false);

    /** What came out, after run(). */
    const Summary &
    result() const
    {
      return summary;
    }

  private:
    // Of this rank; on the first one with that of the run that this one resumes [s].
    double cpu_seconds() const;

    void start_fluid();
    void take_bed();
    void present_bed();
    void flow();
    void begin_case(const double superficial_velocity);

    RunState run_state() const;
    void     save();
    void     save_if_due();
    void     restore();
    // Adds where the state before is.
    [[noreturn]] void fail_with_checkpoint(const SolverFailure &error);

    CaseResult run_case(const double superficial_velocity);
    void       run_transient(const unsigned int number, const double duration);
    // False, in the mode automatic, if the bed does not rest against the flow.
    bool       run_steady(const unsigned int number);
    double     next_step(const double remaining) const;
    double     step_fluid(double step);
    void       adapt_mesh();
    void       adapt_if_due();
    void       move_particles(const double step);
    // Holds the bed against the force of a steady flow, which grows from @p force_before
    // [N], so that bottom and wall carry what the fluid leaves them; in the mode automatic
    // it ends where the bed rises. Relative change of the height [-].
    double       hold_particles(const double force_before);
    void       set_velocity_on_ramp(const double time_in_case);
    void       record_monitor(const unsigned int number);
    MonitorRow monitor(const std::string &phase) const;
    void       write_fields_if_due();
    void       evaluate(CaseResult &result, const unsigned int number);
    void       write_summary_file();

    const RunParameters parameters;
    ResultFiles        &files;
    Progress           &progress;
    const MPI_Comm      communicator;

    Summary        summary;
    VesselMesh     mesh;
    Dem            dem;
    BedObservables observables;

    std::optional<CoupledFlow> coupled; // from when the bed is ready

    double                  time = 0.; // simulated, since the run began [s]
    double                  next_output;
    double                  next_adaption = 0.;
    double                  cell_share    = 0.; // cost of a cell, in particles
    double                  step_limit;         // after a step that failed [s]
    FlowSolver::Report      last_report;
    SteadyMonitor           steady;
    bool                    in_case       = false;
    double                  case_begin    = 0.; // [s]
    double                  case_velocity = 0.; // [m/s]
    double                  ramp_from     = 0.; // velocity at its beginning [m/s]
    std::vector<MonitorRow> case_rows;
    double                  started; // wall clock; before that of a resumed run [s]
    double                  cpu_before = 0.; // of the run that this one resumes [s]
    double                  next_save  = 0.; // wall clock [s]
  };
} // namespace graupel

#endif
