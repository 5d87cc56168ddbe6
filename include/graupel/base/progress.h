// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_progress_h
#define graupel_base_progress_h

#include <functional>
#include <iosfwd>
#include <string>

namespace graupel
{
  /**
   * Tells the user how far the run is: phase, simulated time of the total,
   * simulated seconds per second, and the time that is left.
   *
   * On a terminal one line is rewritten in place; into a file or a pipe, and
   * into the log, goes a line every ten seconds and at the end of a phase.
   * Only the rank that was given streams writes.
   */
  class Progress
  {
  public:
    /** Seconds from some fixed instant [s]. */
    using Clock = std::function<double()>;

    /** Writes nothing: for the ranks other than 0. */
    Progress() = default;

    /**
     * Writes to @p out, rewriting one line there if @p rewrites, and plain
     * lines to @p log, which may be null. The streams must outlive this object.
     */
    Progress(std::ostream &out,
             const bool    rewrites,
             std::ostream *log,
             const Clock  &clock = steady_seconds);

    /** Where a phase goes. */
    struct Way
    {
      double begin = 0., end = 1.;
      /** Of these two; without one they are a share of the whole. */
      std::string unit = "s";
      /** Whether the phase may be done before its end, so that nobody knows how much of
       * it is left. */
      bool end_is_limit = false;
    };

    /** A phase begins. */
    void start_phase(const std::string &name, const Way &way);

    /** The phase goes on from here, and is measured otherwise. */
    void go_on(const Way &way);

    /** The phase has come to @p time [s], or of another unit. Cheap: may be called every
     * step. */
    void update(const double time);

    /** Ends the phase, with a line that says what has been @p done. */
    void finish_phase(const std::string &done);

    /** Writes a line of its own that the progress line does not overwrite. */
    void say(const std::string &line);

    static double steady_seconds();

  private:
    std::string line() const;
    void        write_plain(std::ostream &stream) const;

    std::ostream *out      = nullptr;
    std::ostream *log      = nullptr;
    bool          rewrites = false;
    Clock         clock    = steady_seconds;

    std::string phase;
    Way         way;
    double      time          = 0.;
    double      wall_at_begin = 0.;
    // Of the first update of the phase: a resumed one begins in its middle.
    double first_time = 0., first_wall = 0.;
    bool   has_moved    = false;
    double last_rewrite = 0., last_plain = 0.;
    bool   line_open = false;
  };

  /**
   * True if a person sees this process's standard output in a terminal. Open
   * MPI gives its children a pseudo-terminal even if mpirun itself writes into
   * a file, so under mpirun it is mpirun's own output that is looked at.
   */
  bool stdout_is_terminal();

  /** @p seconds [s] as a person says it: "8 s", "3 min 20 s", "2 h 05 min", "3 d 4 h". */
  std::string spoken_duration(const double seconds);
} // namespace graupel

#endif
