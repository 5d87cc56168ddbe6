// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_probe_points_h
#define graupel_simulation_parameters_probe_points_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace graupel
{
  /** A point at which the fluid is watched. */
  struct ProbePoint
  {
    std::string      name;
    dealii::Point<3> place; // [m]
  };

  /** Reads "NAME: x y z | NAME: x y z", the value of Output/probes. Throws InputError. */
  std::vector<ProbePoint> read_probes(const std::string &text);
} // namespace graupel

#endif
