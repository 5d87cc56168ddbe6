// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_steady_monitor_h
#define graupel_simulation_observers_steady_monitor_h

#include <graupel/simulation/observers/monitors.h>

#include <deque>

namespace graupel
{
  /**
   * Watches pressure drop, superficial velocity, the support of the bed and its height:
   * steady if none changes, over a window of time, by more than a tolerance relative to
   * its scale. What has no value is not watched.
   */
  class SteadyMonitor
  {
  public:
    /** @p window [s]; @p tolerance [-]; @p force_scale: the weight of the bed [N]. */
    SteadyMonitor(const double window, const double tolerance, const double force_scale);

    void record(const MonitorRow &row);

    /** False until a whole window has been recorded. */
    bool is_steady() const;

  private:
    bool rests(const std::string &monitor, const double scale) const;

    double                 window, tolerance, force_scale;
    std::deque<MonitorRow> rows;
  };
} // namespace graupel

#endif
