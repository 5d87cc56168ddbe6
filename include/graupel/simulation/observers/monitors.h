// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_monitors_h
#define graupel_simulation_observers_monitors_h

#include <graupel/simulation/observers/quantity.h>
#include <graupel/simulation/state/simulation_state.h>

namespace graupel
{
  /** The run at one moment, as the monitors see it. */
  class Moment
  {
  public:
    /** @p nominal_velocity: V of the flow case [m/s]; @p fed: particles that the feeds
     * have brought in since the flow began. */
    Moment(const SimulationState &state,
           const Value           &nominal_velocity = {},
           const Value           &fed              = {});

    const SimulationState &state;
    const Value            nominal_velocity, fed;

    /** The bed, found once. Collective at the first call. */
    const BedObservables::Bed &bed() const;

    /** Upward volumetric flow through the section at the height @p z over its area
     * [m/s]; nothing without a fluid. Collective. */
    Value upward_velocity(const double z) const;

    /** The height of what flows past the bed: its top, or the vessel's middle [m]. */
    double flow_height() const;

  private:
    mutable std::optional<BedObservables::Bed> found;
  };

  /**
   * What monitors.csv tells in every phase, beside time, phase and case. A new monitor is
   * one function and one line of this table.
   */
  const std::vector<Quantity<Moment>> &monitors();

  /** A row of monitors.csv. */
  struct MonitorRow
  {
    /** Simulated time since the run began [s]. */
    double      time = 0.;
    std::string phase;
    /** Number of the flow case from 1; 0 before. */
    unsigned int flow_case = 0;
    /** Of monitors(). */
    Values values;

    /** By the name of the monitor. */
    const Value &operator[](const std::string &monitor) const;
  };

  /** The columns of monitors.csv. */
  std::string monitors_header();
  std::string csv_row(const MonitorRow &row);

  /** Mean of the monitor @p name over the rows from the time @p from [s] on that have a
   * value; nothing without any. */
  Value mean_since(const std::vector<MonitorRow> &rows,
                   const double                   from,
                   const std::string             &name);
} // namespace graupel

#endif
