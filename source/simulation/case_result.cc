#include <graupel/simulation/case_result.h>

#include <stdexcept>

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
  SteadyMonitor::is_steady() const
  {
    if (rows.size() < 3 || rows.back().time - rows.front().time < window * (1. - 1e-9))
      return false;
    const auto range_of = [&](double MonitorRow::*column) {
      const auto [low, high] =
        std::minmax_element(rows.begin(), rows.end(), [&](const auto &a, const auto &b) {
          return a.*column < b.*column;
        });
      return (*high).*column - (*low).*column;
    };
    const MonitorRow &last = rows.back();
    return range_of(&MonitorRow::pressure_drop) <=
             tolerance * std::abs(last.pressure_drop) &&
           range_of(&MonitorRow::bottom_force) <= tolerance * force_scale &&
           range_of(&MonitorRow::bed_height) <= tolerance * last.bed_height;
  }

  MonitorRow
  mean_since(const std::vector<MonitorRow> &rows, const double from)
  {
    MonitorRow   mean;
    unsigned int n = 0;
    for (const MonitorRow &row : rows)
      if (row.time >= from)
        {
          mean.pressure_drop += row.pressure_drop;
          mean.bottom_force += row.bottom_force;
          mean.wall_force += row.wall_force;
          mean.fluid_force += row.fluid_force;
          ++n;
        }
    if (n == 0)
      throw std::invalid_argument("mean_since: no row is that late");
    for (double MonitorRow::*column : {&MonitorRow::pressure_drop,
                                       &MonitorRow::bottom_force,
                                       &MonitorRow::wall_force,
                                       &MonitorRow::fluid_force})
      mean.*column /= n;
    return mean;
  }
} // namespace graupel
