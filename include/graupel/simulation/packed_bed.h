#ifndef graupel_simulation_packed_bed_h
#define graupel_simulation_packed_bed_h

#include <graupel/base/progress.h>
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

    /** Runs to the end and writes all files but report.html. Collective. */
    void run();

    /** What came out, after run(). */
    const Summary &
    result() const
    {
      return summary;
    }

  private:
    void balance_if_due();
    void start_fluid();
    void fill();
    void settle();
    void flow();

    CaseResult run_case(const double superficial_velocity);
    void       run_transient(const unsigned int number, const double duration);
    void       run_steady(const unsigned int number);
    double     next_step(const double remaining) const;
    double     step_fluid(double step);
    void       adapt_mesh();
    void       adapt_if_due();
    void       move_particles(const double step);
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
    double                  next_balance  = 0.;
    double                  next_adaption = 0.;
    double                  cell_share    = 0.; // cost of a cell, in particles
    double                  step_limit;         // after a step that failed [s]
    FlowSolver::Report      last_report;
    SteadyMonitor           steady;
    std::vector<MonitorRow> case_rows;
    const double            started;
  };
} // namespace graupel

#endif
