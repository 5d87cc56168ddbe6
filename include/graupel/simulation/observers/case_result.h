// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_case_result_h
#define graupel_simulation_observers_case_result_h

#include <graupel/simulation/observers/case_averages.h>
#include <graupel/simulation/observers/profiles.h>

namespace graupel
{
  /** How a flow case went. */
  struct CaseCourse
  {
    unsigned int number = 0; // from 1
    /** V [m/s]. */
    Value  nominal_velocity;
    double begin          = 0.;    // [s]
    double simulated_time = 0.;    // [s]
    bool   is_steady      = false; // at its end
    double wall_seconds   = 0.;    // [s]
    double cpu_seconds    = 0.;    // of all ranks [s]
    /** Of all its steps. */
    std::vector<MonitorRow> rows;
    /** Of the window of "Averages" that the case had [s]. */
    double averaged_time = 0.;
    /** CaseAverages::statistics(). */
    std::vector<SeriesStatistics> window = {};
  };

  /** Of @p flow as it is now. */
  FlowFields fields_of(const CoupledFlow &flow);

  /**
   * A flow case at its end, as the quantities of cases.csv see it: the last moment, the
   * course of the monitors, and the profiles of the fluid, found once.
   */
  class CaseView
  {
  public:
    /** Both must outlive this object. Collective. */
    CaseView(const Moment &end, const CaseCourse &course);

    const Moment     &end;
    const CaseCourse &course;

    /** Mean of a monitor over the window of "Averages"; without one, over the last
     * quarter of the case. */
    Value mean(const std::string &monitor) const;

    /** What a monitor comes to over the window; nothing without one. */
    SeriesStatistics over_window(const std::string &monitor) const;

    /** The bed now, if it stands on the floor of the vessel or near it; or the one before
     * the flow if all of its particles are there still but no bed can be made out; else
     * nothing. */
    struct WholeBed
    {
      double bottom, height, void_fraction;
    };
    std::optional<WholeBed> whole_bed() const;

    /** Slabs from the bottom up; empty without a fluid. */
    std::vector<RegionMean> axial;
    /** Annuli over the middle half of the bed; empty without one or the other. */
    std::vector<RegionMean> radial;
    /** Mean void fraction over the middle half of the bed [-]. */
    Value middle_void_fraction;
    /** Pressure gradient over the middle half of the bed, positive where the pressure
     * falls upwards [Pa/m]. */
    Value middle_gradient;

    /** Upward superficial velocity at the height @p z [m/s]. Collective. */
    double velocity_at(const double z) const;
    /** Ergun's gradient for the original particles at @p void_fraction and @p velocity,
     * with the sign of the latter [Pa/m]. */
    double ergun_gradient(const double void_fraction, const double velocity) const;

  private:
    void look_at_middle();
  };

  /** What cases.csv and summary.json tell of a flow case. A new one is one function and
   * one line of this table. */
  const std::vector<Quantity<CaseView>> &case_quantities();

  /** What came out of a flow case: the values of case_quantities(). */
  struct CaseResult
  {
    Values values;

    /** By the name of the quantity. */
    const Value &operator[](const std::string &quantity) const;
  };
} // namespace graupel

#endif
