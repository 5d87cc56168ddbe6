// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_case_averages_h
#define graupel_simulation_observers_case_averages_h

#include <graupel/base/time_series.h>
#include <graupel/simulation/observers/bin_averages.h>
#include <graupel/simulation/observers/monitors.h>
#include <graupel/simulation/observers/probes.h>

#include <deque>

namespace graupel
{
  /** What a number that changes with time comes to, over a window. */
  struct SeriesStatistics
  {
    std::string name;
    std::string unit;
    /** Steps in which it had a value. */
    unsigned int samples = 0;
    /** Weighted by the length of the steps; rms about the mean. */
    Value mean, rms;
    /** Standard error of the mean, by error_of_mean(). */
    Value error;
    /** Where its spectrum is highest [Hz]; none if it scatters by rounding alone, or had
     * no value in some step. */
    Value    frequency;
    Spectrum spectrum;
  };

  /** Of @p values at the ends @p times of steps of the lengths @p weights [s]; a value
   * that there is not is NaN. */
  SeriesStatistics statistics_of(const std::vector<double> &times,
                                 const std::vector<double> &weights,
                                 const std::vector<double> &values);

  /** averages-NN.csv and spectra-NN.csv of CaseAverages::statistics(); empty what there
   * is none of. */
  std::string series_table(const std::vector<SeriesStatistics> &statistics);
  std::string spectra_table(const std::vector<SeriesStatistics> &statistics);

  /**
   * The means of one flow case over the window of "Averages": of monitors and probes step
   * by step, of particles and fluid in bins, and of the fluid's fields, which are the
   * state's. Means of particles and bins are the same on all ranks.
   */
  class CaseAverages
  {
  public:
    /** @p state must outlive this object. */
    explicit CaseAverages(SimulationState &state);

    /** Forgets the fields of the case before. */
    void begin();

    /**
     * Takes note of a step that ended with @p row, in a case that began at @p begin [s].
     * Collective.
     */
    void record(const MonitorRow &row, const double begin, const Probes &probes);

    /** Time of the window so far [s]. */
    double averaged_time() const;

    /** Of all monitors, then of all columns of the probes; empty without a window. */
    std::vector<SeriesStatistics> statistics() const;

    /** averages-lines-NN.csv and averages-planes-NN.csv; empty what there is none of. */
    std::string lines_table() const;
    std::string planes_table() const;

    /** For a checkpoint, without the fields. */
    std::string save() const;
    void        resume(const std::string &saved);

  private:
    void look(const double duration);

    SimulationState        &state;
    std::deque<BinAverages> lines, planes;

    double last     = 0.; // end of the last step, since the case began [s]
    double unlooked = 0.; // time in the window since the last look at fields and bins [s]
    std::vector<double> times, weights;
    std::vector<double> values; // all series, one row after the other
  };
} // namespace graupel

#endif
