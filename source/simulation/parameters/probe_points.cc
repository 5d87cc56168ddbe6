// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/simulation/parameters/probe_points.h>

#include <deal.II/base/utilities.h>

#include <set>

namespace graupel
{
  namespace
  {
    const char *const parameter = "Output/probes";

    ProbePoint
    read_probe(const std::string &text)
    {
      const auto colon   = text.find(':');
      const auto numbers = colon == std::string::npos
                             ? std::vector<double>()
                             : read_numbers(parameter, text.substr(colon + 1));
      require(numbers.size() == 3,
              parameter,
              "\"" + text +
                "\" is not a probe: write NAME: x y z, a name and three numbers in "
                "metres; probes are separated by bars (|)");
      ProbePoint point;
      for (unsigned int d = 0; d < 3; ++d)
        point.place[d] = numbers[d];
      point.name = dealii::Utilities::trim(text.substr(0, colon));
      require(!point.name.empty() &&
                point.name.find_first_of(",\" ") == std::string::npos,
              parameter,
              "a probe needs a name without blanks, commas or quotes, for its columns");
      return point;
    }
  } // namespace

  std::vector<ProbePoint>
  read_probes(const std::string &text)
  {
    std::vector<ProbePoint> points;
    std::set<std::string>   names;
    for (const auto &entry : dealii::Utilities::split_string_list(text, '|'))
      {
        points.push_back(read_probe(entry));
        require(names.insert(points.back().name).second,
                parameter,
                "there are two probes named " + points.back().name);
      }
    return points;
  }
} // namespace graupel
