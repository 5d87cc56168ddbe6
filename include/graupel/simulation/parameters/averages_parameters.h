// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_averages_parameters_h
#define graupel_simulation_parameters_averages_parameters_h

#include <graupel/simulation/parameters/bin_grid.h>

#include <deal.II/base/parameter_handler.h>

namespace graupel
{
  /** Means over a window of time of each flow case. */
  struct AveragesParameters
  {
    /** The window, since the case began; no averages if it ends at 0 [s]. */
    double from = 0., to = 0.;
    /** Between two looks at fields and bins; 0: every step of the fluid [s]. */
    double interval = 0.;
    /** Moments in the window at which the mid-plane is written [-]. */
    unsigned int snapshots = 6;
    /** As read_lines() and read_planes() have them. */
    std::string lines, planes;

    bool
    are_wanted() const
    {
      return to > 0.;
    }

    std::vector<BinGrid> line_grids() const;
    std::vector<BinGrid> plane_grids() const;

    /** Part of the time between @p before and @p now, both since the case began, that
     * lies in the window [s]. */
    double time_within(const double before, const double now) const;

    /** Whether the window has ended @p now, since the case began [s]. */
    bool has_ended(const double now) const;

    /** Whether one of the snapshots is due after the step from @p before to @p now, both
     * since the case began [s]. */
    bool is_snapshot_due(const double before, const double now) const;

    /** Declares the section "Averages". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };
} // namespace graupel

#endif
