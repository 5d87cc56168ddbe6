// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/quantity.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace graupel
{
  std::vector<double>
  Values::numbers() const
  {
    std::vector<double> result;
    for (const Value &value : values)
      result.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    return result;
  }

  Values
  Values::of_numbers(const std::vector<double> &numbers)
  {
    Values result;
    for (const double number : numbers)
      result.values.push_back(std::isnan(number) ? Value() : Value(number));
    return result;
  }

  std::string
  cell_text(const Value &value, const std::string &unit)
  {
    if (!value || !std::isfinite(*value))
      return "";
    if (unit == "flag")
      return *value != 0. ? "true" : "false";
    std::ostringstream text;
    text << std::setprecision(10) << *value;
    return text.str();
  }

  std::string
  told_text(const std::string &told,
            const Value       &value,
            const double       factor,
            const std::string &unit)
  {
    if (!value || !std::isfinite(*value))
      return "";
    if (unit == "flag")
      return *value != 0. ? told : "";
    std::ostringstream text;
    // A negative nothing is nothing.
    text << std::setprecision(4) << told << ' ' << *value * factor + 0.
         << (unit.empty() ? "" : " ") << unit;
    return text.str();
  }
} // namespace graupel
