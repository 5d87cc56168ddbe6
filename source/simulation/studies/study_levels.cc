// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/simulation/studies/study_levels.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // The same mass of particles of another scale; the filter follows them.
    void
    set_scale(RunParameters &parameters, const double scale)
    {
      const double growth = scale / parameters.dem.particles.scale;
      auto        &count  = parameters.filling.count;
      count = static_cast<unsigned int>(std::lround(count / std::pow(growth, 3)));
      if (parameters.coupling.filter_length != "auto")
        parameters.coupling.filter_length =
          text_of(parameters.filter_length() * growth, 17);
      for (ParticleType &type : parameters.dem.particles.further_types)
        type.scale *= growth;
      parameters.dem.particles.scale      = scale;
      parameters.texts["Particles/scale"] = text_of(scale, 17);
    }

    RunParameters
    at_level(RunParameters parameters, const double value)
    {
      if (parameters.study.vary == "cell size")
        {
          parameters.mesh.cell_height *= value / parameters.mesh.cell_size;
          parameters.mesh.cell_size = value;
        }
      else if (parameters.study.vary == "time step")
        parameters.sweep.time_step = text_of(value);
      else if (parameters.study.vary == "scale")
        set_scale(parameters, value);
      else if (parameters.study.vary == "filter length")
        parameters.coupling.filter_length = text_of(value, 17);
      return parameters;
    }
  } // namespace

  std::vector<RunParameters>
  study_levels(const RunParameters &parameters)
  {
    std::vector<RunParameters> levels;
    if (!parameters.study.is_wanted())
      levels.push_back(parameters);
    else
      for (const double value : parameters.study.values)
        levels.push_back(at_level(parameters, value));
    return levels;
  }

  void
  check_levels(const RunParameters &parameters)
  {
    if (!parameters.study.is_wanted())
      return;
    const auto levels = study_levels(parameters);
    for (unsigned int n = 0; n < levels.size(); ++n)
      try
        {
          levels[n].check();
          if (!parameters.manufactured.is_given())
            levels[n].sweep.check_ramp(parameters.cylinder.height);
        }
      catch (const InputError &error)
        {
          std::ostringstream reason;
          reason << "level " << n + 1 << ", " << parameters.study.vary << ' '
                 << parameters.study.values[n] << ", cannot run. " << error.what();
          throw InputError("Refinement study/values", reason.str());
        }
  }
} // namespace graupel
