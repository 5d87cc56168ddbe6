// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/wall_forces.h>

#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    // A name as a part of a column's: no blanks, commas or folders.
    std::string
    column(const std::string &name)
    {
      std::string text = name.substr(name.find_last_of('/') + 1);
      for (char &letter : text)
        if (letter == ' ' || letter == ',' || letter == '"')
          letter = '_';
      return text;
    }

    std::string
    three_columns(const std::string &prefix, const std::string &name)
    {
      const std::string start = "," + prefix + "_on_" + column(name) + "_";
      return start + "x" + start + "y" + start + "z";
    }
  } // namespace

  std::string
  wall_forces_header(const SimulationState &state)
  {
    std::string text = "time";
    for (const Wall &wall : state.dem.vessel())
      text += three_columns("particles", wall.name);
    if (state.parameters.sweep.has_fluid())
      for (const auto &boundary : state.mesh.boundaries())
        text += three_columns("fluid", boundary.first);
    return text;
  }

  std::string
  wall_forces_row(const SimulationState &state)
  {
    std::ostringstream text;
    text << std::setprecision(10) << state.time;
    const auto write = [&](const dealii::Tensor<1, 3> &force) {
      for (unsigned int i = 0; i < 3; ++i)
        text << ',' << force[i];
    };
    for (unsigned int wall = 0; wall < state.dem.vessel().size(); ++wall)
      write(state.dem.force_on(wall));
    if (!state.parameters.sweep.has_fluid())
      return text.str();
    for (const auto &boundary : state.mesh.boundaries())
      {
        if (state.fluid)
          write(state.fluid->fluid().force_on(boundary.second));
        else
          text << ",,,";
      }
    return text.str();
  }
} // namespace graupel
