// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/parameters/averages_parameters.h>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    // A part of a step in the window that rounding makes is none [-].
    constexpr double rounding = 1e-9;
  } // namespace

  std::vector<BinGrid>
  AveragesParameters::line_grids() const
  {
    return read_lines("Averages/lines", lines);
  }

  std::vector<BinGrid>
  AveragesParameters::plane_grids() const
  {
    return read_planes("Averages/planes", planes);
  }

  double
  AveragesParameters::time_within(const double before, const double now) const
  {
    const double within = std::min(now, to) - std::max(before, from);
    return within > rounding * (now - before) ? within : 0.;
  }

  bool
  AveragesParameters::has_ended(const double now) const
  {
    return now >= to * (1. - rounding);
  }

  bool
  AveragesParameters::is_snapshot_due(const double before, const double now) const
  {
    const auto taken_by = [&](const double time) {
      const double part = std::clamp((time - from) / (to - from), 0., 1.);
      return std::floor(part * snapshots * (1. + rounding));
    };
    return taken_by(now) > taken_by(before);
  }

  void
  AveragesParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Averages");
    prm.add_parameter("from",
                      from,
                      "Where the window of time begins over which means are taken, since "
                      "the flow case began [s].");
    prm.add_parameter("to",
                      to,
                      "Where the window ends; a case that ends earlier ends it. 0: no "
                      "averages [s].");
    prm.add_parameter("interval",
                      interval,
                      "Time between two looks at the fields and the bins, each of which "
                      "counts by the time since the last; 0 for every step of the fluid. "
                      "Monitors and probes count in every step [s].");
    prm.add_parameter("lines",
                      lines,
                      "Lines of bins for averages-lines-NN.csv: NAME: x y z x y z BINS "
                      "WIDTH THICKNESS, where the line begins and ends, how many bins it "
                      "has, and how far they reach across it: the width along the level "
                      "direction across (y for a line along x, x for one along z), the "
                      "thickness at right angles to both. Separated by bars (|), as in "
                      "\"low: -0.02 0 0.015 0.02 0 0.015 20 0.01 0.002\" [m].",
                      dealii::Patterns::Anything());
    prm.add_parameter(
      "planes",
      planes,
      "Planes of bins for averages-planes-NN.csv: NAME: x y z x y z x y z "
      "BINS BINS THICKNESS, a corner and the ends of both sides from it, "
      "the bins along them, and how far they reach across the plane. "
      "Separated by bars (|) [m].",
      dealii::Patterns::Anything());
    prm.add_parameter("snapshots",
                      snapshots,
                      "Moments in the window, evenly spaced, at which the mid-plane is "
                      "written to snapshots.csv [-].");
    prm.leave_subsection();
  }

  void
  AveragesParameters::check() const
  {
    const auto is_time = [](const double time) {
      return time >= 0. && std::isfinite(time);
    };
    require(is_time(from), "Averages/from", "must not be negative");
    require(is_time(to), "Averages/to", "must not be negative; 0 is for no averages");
    require(!are_wanted() || to > from,
            "Averages/to",
            "the window must end after it begins, at Averages/from");
    require(is_time(interval),
            "Averages/interval",
            "must not be negative; 0 looks at every step");
    line_grids();
    plane_grids();
    require(are_wanted() || (line_grids().empty() && plane_grids().empty()),
            "Averages/to",
            "there are lines or planes, but no window to average over them: say where it "
            "ends, in seconds");
  }
} // namespace graupel
