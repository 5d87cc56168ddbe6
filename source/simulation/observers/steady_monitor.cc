// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/steady_monitor.h>

namespace graupel
{
  SteadyMonitor::SteadyMonitor(const double window,
                               const double tolerance,
                               const double force_scale)
    : window(window)
    , tolerance(tolerance)
    , force_scale(force_scale)
  {
  }

  void
  SteadyMonitor::record(const MonitorRow &row)
  {
    rows.push_back(row);
    // The oldest row that is kept is the last one at or before the window's begin.
    while (rows.size() > 2 && rows[1].time <= row.time - window)
      rows.pop_front();
  }

  bool
  SteadyMonitor::rests(const std::string &monitor, const double scale) const
  {
    const std::size_t place  = place_of(monitor, monitors());
    double            lowest = std::numeric_limits<double>::max(), highest = -lowest;
    for (const MonitorRow &row : rows)
      if (const Value &value = row.values[place])
        {
          lowest  = std::min(lowest, *value);
          highest = std::max(highest, *value);
        }
    return lowest > highest || highest - lowest <= tolerance * scale;
  }

  bool
  SteadyMonitor::is_steady() const
  {
    if (rows.size() < 3 || rows.back().time - rows.front().time < window * (1. - 1e-9))
      return false;
    const auto last = [&](const std::string &monitor) {
      return std::abs(rows.back()[monitor].value_or(0.));
    };
    return rests("pressure_drop", last("pressure_drop")) &&
           rests("superficial_velocity", last("superficial_velocity")) &&
           rests("bottom_force", force_scale) && rests("support_force", force_scale) &&
           rests("bed_height", last("bed_height"));
  }
} // namespace graupel
