// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_simulation_h
#define graupel_simulation_simulation_h

#include <graupel/simulation/files/checkpoint.h>
#include <graupel/simulation/files/summary.h>
#include <graupel/simulation/phases/flow_case.h>

namespace graupel
{
  /**
   * A run in its order of events: a list of phases, one after the other, each step by
   * step, with everything that is watched and written on the way, and a checkpoint from
   * which any of them goes on.
   *
   * The constructor reads all that the run will need; nothing is written before run().
   */
  class Simulation
  {
  public:
    /**
     * @p parameters are checked; @p files and @p progress must outlive this object.
     * @p parameter_file is named in the summary. Throws InputError for a file that cannot
     * be used. Collective.
     */
    Simulation(const RunParameters &parameters,
               const std::string   &parameter_file,
               ResultFiles         &files,
               Progress            &progress,
               MPI_Comm             communicator);

    /** Reads the checkpoint of the output directory, from which run() goes on. Throws
     * InputError where there is none or the run is another. Collective. */
    void resume();

    /**
     * Runs to the end and writes all files but report.html. Throws Stopped after a
     * checkpoint where a signal or the time limit asks for it. Collective.
     */
    void run();

    /** Lets run() stop before @p seconds of wall-clock time have passed from now on, with
     * room for a checkpoint. */
    void set_time_limit(const double seconds);

    /** What came out, after run(). */
    const Summary &
    result() const
    {
      return summary;
    }

  private:
    std::size_t            n_phases() const;
    std::unique_ptr<Phase> make_phase(const std::size_t number);
    void                   run_phase(Phase &phase);
    void                   warn_of_disk(const double needed) const;
    void                   step_or_fail(Phase &phase, bool &goes_on);
    void                   observe(Phase &phase);
    void                   present_bed();
    void                   write_fields_if_due();
    void                   write_summary_file();

    // Cases that have ended or begun must be the same in the parameters of now.
    void     check_cases(const RunState &saved) const;
    RunState run_state() const;
    void     save();
    // A checkpoint where it is due, or where the run is to stop.
    void save_or_stop();
    void stop(const int signal);
    void go_on_from(const RunState &saved);

    Summary          summary;
    SimulationState  state;
    ResultFiles     &files;
    FlowCase::Series series;

    /** The settled bed of another run that this one begins with. */
    std::optional<DemState> given_bed;
    /** The checkpoint that this run goes on from. */
    std::optional<Checkpoint> checkpoint;

    /** Behind filling and settling. */
    static constexpr std::size_t first_flow_phase = 2;

    std::size_t           phase_number = 0;
    Phase                *phase_now    = nullptr; // between its steps
    double                next_output;            // [s]
    double                next_observation = 0.;  // of packing [s]
    double                started;        // wall clock; before that of a resumed run [s]
    double                next_save = 0.; // wall clock [s]
    std::optional<double> last_save;      // when the last checkpoint is of [s]
    double                last_look = 0.; // by save_or_stop(), wall clock [s]
    // Of a step and of a checkpoint [s].
    double longest_step = 0., save_seconds = 0.;
    double stop_at = std::numeric_limits<double>::infinity(); // wall clock [s]
  };
} // namespace graupel

#endif
