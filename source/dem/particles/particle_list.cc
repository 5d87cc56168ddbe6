// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/particles/particle_list.h>

#include <deal.II/base/utilities.h>

#include <fstream>
#include <map>

namespace graupel
{
  namespace
  {
    const std::vector<std::string> needed{"x", "y", "z", "diameter"};
    const std::vector<std::string> optional{"vx", "vy", "vz", "wx", "wy", "wz", "type"};

    void
    check(const bool         holds,
          const std::string &file,
          const unsigned int line,
          const std::string &problem)
    {
      require(
        holds, "Filling/file", file + ", line " + std::to_string(line) + ": " + problem);
    }

    double
    number(const std::string &text, const std::string &file, const unsigned int line)
    {
      const auto value = number_in(text);
      check(value.has_value(), file, line, "\"" + text + "\" is not a number");
      return *value;
    }
  } // namespace

  namespace
  {
    using Columns = std::vector<std::string>;

    void
    check_header(const Columns &columns, const std::string &file, const unsigned int line)
    {
      for (const auto &name : columns)
        check(std::count(needed.begin(), needed.end(), name) +
                  std::count(optional.begin(), optional.end(), name) ==
                1,
              file,
              line,
              "there is no column \"" + name +
                "\"; there are x, y, z, diameter, vx, vy, vz, wx, wy, wz, type");
      for (const auto &name : needed)
        check(std::count(columns.begin(), columns.end(), name) == 1,
              file,
              line,
              "the column \"" + name + "\" is missing or double in the header");
    }

    NewParticle
    read_row(const Columns     &entries,
             const Columns     &columns,
             const unsigned int n_types,
             const std::string &file,
             const unsigned int line)
    {
      check(entries.size() == columns.size(),
            file,
            line,
            std::to_string(entries.size()) + " values for " +
              std::to_string(columns.size()) + " columns");
      std::map<std::string, double> value{{"type", 1.}};
      for (std::size_t k = 0; k < columns.size(); ++k)
        value[columns[k]] = number(entries[k], file, line);
      check(value["diameter"] > 0., file, line, "a diameter is positive, in metres");
      check(value["type"] >= 1. && value["type"] <= n_types &&
              value["type"] == std::floor(value["type"]),
            file,
            line,
            "types go from 1 to " + std::to_string(n_types));

      NewParticle particle;
      particle.position = dealii::Point<3>(value["x"], value["y"], value["z"]);
      particle.radius   = value["diameter"] / 2.;
      particle.velocity = dealii::Tensor<1, 3>({value["vx"], value["vy"], value["vz"]});
      particle.spin     = dealii::Tensor<1, 3>({value["wx"], value["wy"], value["wz"]});
      particle.type     = static_cast<unsigned char>(value["type"] - 1.);
      return particle;
    }
  } // namespace

  void
  read_particle_list(const std::string                                     &file,
                     const unsigned int                                     n_types,
                     const std::function<void(const NewParticle &)>        &take,
                     const std::function<std::string(const NewParticle &)> &problem_of)
  {
    std::ifstream stream(file);
    require(static_cast<bool>(stream), "Filling/file", file + " cannot be opened");

    std::vector<std::string> columns;
    bool                     is_empty = true;
    std::string              text;
    for (unsigned int line = 1; std::getline(stream, text); ++line)
      {
        text = dealii::Utilities::trim(text.substr(0, text.find('#')));
        if (text.empty())
          continue;
        const auto entries = dealii::Utilities::split_string_list(text, ',');
        if (columns.empty())
          {
            columns = entries;
            check_header(columns, file, line);
            continue;
          }
        const auto particle = read_row(entries, columns, n_types, file, line);
        const auto problem  = problem_of ? problem_of(particle) : std::string();
        check(problem.empty(), file, line, problem);
        take(particle);
        is_empty = false;
      }
    require(!is_empty, "Filling/file", file + " holds no particles");
  }
} // namespace graupel
