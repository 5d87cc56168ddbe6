// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>

#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    constexpr char blanks[] = " \t\r\n";
  }

  std::optional<double>
  number_in(const std::string &text)
  {
    auto first = text.find_first_not_of(blanks);
    if (first == std::string::npos)
      return {};
    // from_chars knows no sign in front of a positive number.
    if (text[first] == '+' && text.find_first_of("+-", first + 1) != first + 1)
      ++first;
    const char *const end = text.data() + text.find_last_not_of(blanks) + 1;

    double value;
    const auto [stop, error] = std::from_chars(text.data() + first, end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      return {};
    return value;
  }

  double
  read_number(const std::string &parameter, const std::string &text)
  {
    const auto number = number_in(text);
    require(number.has_value(), parameter, '"' + text + "\" is not a number");
    return *number;
  }

  std::vector<double>
  read_numbers(const std::string &parameter, const std::string &text)
  {
    std::vector<double> numbers;
    std::istringstream  words(text);
    for (std::string word; words >> word;)
      numbers.push_back(read_number(parameter, word));
    return numbers;
  }

  std::string
  text_of(const double value, const int digits)
  {
    std::ostringstream text;
    text << std::setprecision(digits) << value;
    return text.str();
  }
} // namespace graupel
