// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/files/may_change.h>

#include <deal.II/base/utilities.h>

#include <boost/lexical_cast/try_lexical_convert.hpp>

namespace graupel
{
  namespace
  {
    struct Rule
    {
      // Of a section, with its slash, or of a parameter.
      const char *path;
      // For a bed that another run starts from, between phases, within one.
      bool        for_bed, between, within;
      const char *why;
    };

    // The first rule whose path fits counts; what no rule fits may not change in a run,
    // and may for a bed.
    constexpr Rule rules[] = {
      {"Output/probes", true, false, false, "columns of tables that go on"},
      {"Output/field format", true, false, false, "one series has files of one kind"},
      {"Output/", true, true, true, "what is written does not change what happens"},
      {"Flow solver/", true, true, true, "how equations are solved, not which"},
      {"Boundary conditions/",
       true,
       true,
       true,
       "told in the log; a case that goes on has the new ones from there on"},
      {"Flow/superficial velocities",
       true,
       true,
       true,
       "cases that have ended or begun keep theirs; further ones may be added or "
       "changed"},
      {"Flow/time step", true, true, true, "how long steps are, not where they lead"},
      {"Flow/Courant number", true, true, true, "the same"},
      {"Flow/maximum solves", true, true, true, "when to give up"},
      {"Flow/mode", true, true, false, "for the cases that come"},
      {"Flow/", true, true, true, "when a case ends, and how its velocity is reached"},
      {"Settling/", true, true, false, "for a bed that settles still"},
      {"Averages/", true, true, false, "their account goes on"},
      {"Mesh adaption/", true, true, true, "from the next adaption on"},
      {"Feed", true, false, false, "their account goes on"},
      {"Refinement study/", true, true, true, "has no meaning for a run that goes on"},
      {"Manufactured solution/", true, true, true, "has no meaning for a bed"},
      {"Geometry/diameter", false, false, false, "the bed lies in this vessel"},
      {"Geometry/height", true, false, false, "a bed may stand in a higher vessel"},
      {"Mesh/", true, false, false, "the fields belong to this mesh"},
      {"Particles/density", true, false, false, "the bed settles anew"},
      {"Particles/gravity", true, false, false, "the bed settles anew"},
      {"Particles/", false, false, false, "the bed is made of these particles"},
      {"Walls/", true, false, false, "walls are known by their names"},
      {"Filling/", true, false, false, "the bed has been filled by them"},
      {"", true, false, false, "the state belongs to these values"}};

    const Rule &
    rule_for(const std::string &path)
    {
      for (const Rule &rule : rules)
        if (path.rfind(rule.path, 0) == 0)
          return rule;
      return rules[0]; // never: the last one fits all
    }

    bool
    may(const Rule &rule, const Standing standing)
    {
      return standing == Standing::settled_bed      ? rule.for_bed
             : standing == Standing::between_phases ? rule.between
                                                    : rule.within;
    }

    // "0.30, 1e-3" is the same as "0.3, 0.001".
    bool
    means_the_same(const std::string &one, const std::string &other)
    {
      if (one == other)
        return true;
      const auto first  = dealii::Utilities::split_string_list(one);
      const auto second = dealii::Utilities::split_string_list(other);
      if (first.size() != second.size())
        return false;
      for (std::size_t n = 0; n < first.size(); ++n)
        {
          double a = 0., b = 0.;
          if (first[n] != second[n] &&
              !(boost::conversion::try_lexical_convert(first[n], a) &&
                boost::conversion::try_lexical_convert(second[n], b) && a == b))
            return false;
        }
      return true;
    }
  } // namespace

  std::vector<std::string>
  check_changes(const ParameterTexts &here,
                const ParameterTexts &there,
                const Standing        standing,
                const std::string    &where)
  {
    std::vector<std::string> changes;
    for (const auto &[path, value] : here)
      {
        const auto other = there.find(path);
        if (other == there.end() || means_the_same(value, other->second))
          continue;
        require(may(rule_for(path), standing),
                path,
                where + " has " + (other->second.empty() ? "nothing" : other->second) +
                  " instead" +
                  (standing == Standing::settled_bed
                     ? "; set it back, or fill a bed of its own"
                     : "; set it back, or begin anew without --resume") +
                  " (doc/going-on.md has what may change)");
        changes.push_back(path + " is " + value + " from here on, was " + other->second);
      }
    return changes;
  }

  std::string
  table_of_changes()
  {
    const auto  word = [](const bool yes) { return yes ? "yes" : "no"; };
    std::string text = "| parameters | `start from` | `--resume` between phases | "
                       "`--resume` within a phase | why |\n"
                       "| --- | --- | --- | --- | --- |\n";
    for (const Rule &rule : rules)
      text += std::string("| ") +
              (*rule.path ? "`" + std::string(rule.path) + "`" : "others") + " | " +
              word(rule.for_bed) + " | " + word(rule.between) + " | " +
              word(rule.within) + " | " + rule.why + " |\n";
    return text;
  }
} // namespace graupel
