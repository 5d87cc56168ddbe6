// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameter_entries.h>

#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace graupel
{
  namespace
  {
    // An entry is a node with a pattern; every other node is a section.
    void
    collect(const nlohmann::json        &node,
            const std::string           &path,
            std::vector<ParameterEntry> &entries)
    {
      for (const auto &[name, child] : node.items())
        {
          if (!child.is_object())
            continue;
          const std::string child_path = path.empty() ? name : path + "/" + name;
          const auto        pattern    = child.find("pattern_description");
          if (pattern != child.end() && pattern->is_string())
            entries.push_back({child_path,
                               child.at("documentation").get<std::string>(),
                               pattern->get<std::string>()});
          else
            collect(child, child_path, entries);
        }
    }

    // deal.II writes limits of the type where there is no limit.
    std::string
    with_limits(const std::string &kind,
                const std::string &least,
                const std::string &most)
    {
      const bool bounded_below = least != "-MAX_DOUBLE" && least != "-2147483648";
      const bool bounded_above = most != "MAX_DOUBLE" && most != "2147483647";
      if (bounded_below && bounded_above)
        return kind + " from " + least + " to " + most;
      if (bounded_below)
        return kind + ", " + least + " or more";
      if (bounded_above)
        return kind + ", " + most + " or less";
      return kind;
    }
  } // namespace

  std::vector<ParameterEntry>
  parameter_entries(const dealii::ParameterHandler &handler)
  {
    std::stringstream text;
    handler.print_parameters(text, dealii::ParameterHandler::JSON);

    std::vector<ParameterEntry> entries;
    collect(nlohmann::json::parse(text), "", entries);
    std::sort(
      entries.begin(),
      entries.end(),
      [](const ParameterEntry &a, const ParameterEntry &b) { return a.path < b.path; });
    return entries;
  }

  std::string
  expected_by(const std::string &pattern)
  {
    static const std::regex real(R"(\[Double (\S+)\.\.\.(\S+) \(inclusive\)\])");
    static const std::regex whole(R"(\[Integer range (\S+)\.\.\.(\S+) \(inclusive\)\])");
    static const std::regex selection(R"(\[Selection (.*?) ?\])");
    static const std::regex choice(R"(\[MultipleSelection (.*?) ?\])");
    static const std::regex list(R"(\[List of <(.*)> of length .*\])");
    static const std::regex separator(R"(.* separated by <(.)>\])");

    const auto bars = [](const std::string &names) {
      return std::regex_replace(names, std::regex(R"(\s*\|\s*)"), " | ");
    };

    std::smatch found;
    if (pattern == "[Bool]")
      return "true or false";
    // The limits of an unsigned type overflow in deal.II, which then names none.
    if (pattern == "[Integer]")
      return "a whole number, 0 or more";
    if (std::regex_match(pattern, found, real))
      return with_limits("a number", found[1], found[2]);
    if (std::regex_match(pattern, found, whole))
      return with_limits("a whole number", found[1], found[2]);
    if (std::regex_match(pattern, found, selection))
      return "one of " + bars(found[1]);
    if (std::regex_match(pattern, found, choice))
      return "any of " + bars(found[1]) + ", separated by commas";
    if (std::regex_match(pattern, found, list))
      {
        const std::string element = expected_by(found[1]);
        std::string       mark    = ",";
        if (std::regex_match(pattern, found, separator))
          mark = found[1];
        return "a list separated by \"" + mark + "\", each element " + element;
      }
    return pattern;
  }

  std::vector<std::string>
  entries_without_unit(const dealii::ParameterHandler &handler)
  {
    static const std::regex unit(R"([\s\S]*\[[^\]\s][^\]]*\]\.?\s*)");

    std::vector<std::string> paths;
    for (const ParameterEntry &entry : parameter_entries(handler))
      {
        const bool number = entry.pattern.find("[Double") != std::string::npos ||
                            entry.pattern.find("[Integer") != std::string::npos;
        if (number && !std::regex_match(entry.documentation, unit))
          paths.push_back(entry.path);
      }
    return paths;
  }
} // namespace graupel
