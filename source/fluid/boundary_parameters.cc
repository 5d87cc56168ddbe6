// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/fluid/boundary_parameters.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    struct Word
    {
      const char             *text;
      BoundaryCondition::Kind kind;
      unsigned int            n_expressions;
    };

    constexpr Word words[] = {{"plug", BoundaryCondition::plug, 0},
                              {"parabolic", BoundaryCondition::parabolic, 0},
                              {"velocity", BoundaryCondition::velocity, 3},
                              {"mass flow rate", BoundaryCondition::mass_flow_rate, 1},
                              {"pressure", BoundaryCondition::pressure, 1},
                              {"no-slip", BoundaryCondition::no_slip, 0},
                              {"slip", BoundaryCondition::slip, 0}};

    // Whether @p text is @p word, or goes on behind it after a blank.
    bool
    begins_with_word(const std::string &text, const std::string &word)
    {
      return text.compare(0, word.size(), word) == 0 &&
             (text.size() == word.size() || text[word.size()] == ' ' ||
              text[word.size()] == '\t');
    }

    // Whether an expression is a number at one place at least: one that holds within the
    // vessel only may not be at all.
    bool
    is_finite_somewhere(dealii::FunctionParser<3> &function, const unsigned int component)
    {
      for (const double t : {0., 1e-2, 1.})
        for (const double x : {1e-3, -1e-3, 1e-2, 0.1, 1.})
          {
            function.set_time(t);
            if (std::isfinite(
                  function.value(dealii::Point<3>(x, 2. * x, 3. * x), component)))
              return true;
          }
      return false;
    }

    void
    try_expressions(const std::vector<std::string> &expressions,
                    const std::string              &parameter)
    {
      dealii::FunctionParser<3> function(expressions.size());
      std::vector<bool>         are_finite;
      try
        {
          function.initialize(
            "x,y,z,t", expressions, {{"V", 1.}, {"pi", dealii::numbers::PI}}, true);
          for (unsigned int c = 0; c < expressions.size(); ++c)
            are_finite.push_back(is_finite_somewhere(function, c));
        }
      catch (const std::exception &)
        {
          throw InputError(
            parameter,
            "an expression cannot be read; it may hold x, y, z [m], t [s], "
            "V (the superficial velocity of the flow case) and pi");
        }
      for (unsigned int c = 0; c < expressions.size(); ++c)
        require(are_finite[c],
                parameter,
                "the expression \"" + expressions[c] + "\" has no finite value");
    }
    // Where fluid enters it must be able to leave. What a velocity, or a mass flow rate
    // beside another inlet, lets in or out is known in the run only.
    void
    require_exit(const std::vector<BoundaryCondition> &conditions,
                 const std::string                    &remark)
    {
      std::array<unsigned int, BoundaryCondition::no_slip + 1> count{};
      unsigned int                                             n_inlets = 0;
      for (const BoundaryCondition &condition : conditions)
        {
          ++count[condition.kind];
          n_inlets += condition.is_inlet() ? 1 : 0;
        }
      const bool may_balance =
        n_inlets == 0 || count[BoundaryCondition::velocity] > 0 ||
        (count[BoundaryCondition::mass_flow_rate] > 0 && n_inlets > 1);
      require(count[BoundaryCondition::pressure] > 0 || may_balance,
              "Boundary conditions/top",
              "fluid enters, but no boundary has a pressure, so that it cannot leave; "
              "\"pressure 0\" at the top is usual, and in a vessel that is closed all "
              "around no boundary lets fluid in, the bottom neither" +
                remark);
    }
  } // namespace

  BoundaryCondition
  BoundaryCondition::read(const std::string &text, const std::string &parameter)
  {
    const std::string trimmed = dealii::Utilities::trim(text);
    for (const Word &word : words)
      {
        const std::string name = word.text;
        if (!begins_with_word(trimmed, name))
          continue;
        BoundaryCondition result;
        result.kind        = word.kind;
        result.expressions = dealii::Utilities::split_string_list(
          dealii::Utilities::trim(trimmed.substr(name.size())), ';');
        require(result.expressions.size() == word.n_expressions,
                parameter,
                "\"" + name + "\" needs " + std::to_string(word.n_expressions) +
                  " expression(s), separated by semicolons, but there are " +
                  std::to_string(result.expressions.size()));
        if (word.n_expressions > 0)
          try_expressions(result.expressions, parameter);
        return result;
      }
    throw InputError(parameter,
                     "\"" + trimmed +
                       "\" is no boundary condition; there are plug, parabolic, velocity "
                       "A; B; C, mass flow rate A, pressure A, slip and no-slip");
  }

  void
  BoundaryParameters::declare(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Anything anything;
    prm.enter_subsection("Boundary conditions");
    prm.add_parameter(
      "bottom",
      bottom,
      "What the fluid meets at the bottom. plug: the superficial velocity of the flow "
      "case, even; parabolic: the same mean with the profile of Poiseuille; velocity A; "
      "B; C: the superficial velocity by three expressions in m/s; mass flow rate A: "
      "plug "
      "flow of A times the mean void fraction at the boundary, in kg/s (eq. 8 of "
      "Ricklick & "
      "Baran); pressure A: static pressure in Pa; slip; no-slip. Expressions may hold x, "
      "y, "
      "z [m], t [s], V (the superficial velocity of the case) and pi.",
      anything);
    prm.add_parameter("top", top, "The same at the top.", anything);
    prm.add_parameter(
      "wall",
      wall,
      "The same at the lateral wall. In a bed the layer that a wall slows down is far "
      "thinner than a cell, so slip is the better choice there.",
      anything);
    prm.add_parameter("others",
                      others,
                      "The same at further boundaries of a mesh from a file: name = "
                      "condition, separated by bars (|). Without an entry: as the wall.",
                      anything);
    prm.add_parameter(
      "weigh inlets by void fraction",
      weigh_inlets,
      "Whether the fluid enters in proportion to the void fraction at each "
      "point of an inlet, with the same total: none where solids are.");
    prm.leave_subsection();
  }

  void
  BoundaryParameters::check() const
  {
    std::vector<BoundaryCondition> all;
    for (const auto &entry : conditions())
      all.push_back(entry.second);
    require_exit(all, "");
  }

  std::map<std::string, BoundaryCondition>
  BoundaryParameters::conditions() const
  {
    const std::string                        section = "Boundary conditions/";
    std::map<std::string, BoundaryCondition> result;
    result["bottom"] = BoundaryCondition::read(bottom, section + "bottom");
    result["top"]    = BoundaryCondition::read(top, section + "top");
    result["wall"]   = BoundaryCondition::read(wall, section + "wall");
    for (const std::string &entry : dealii::Utilities::split_string_list(others, '|'))
      {
        const auto equals = entry.find('=');
        require(equals != std::string::npos,
                section + "others",
                "\"" + entry + "\" is not of the form name = condition");
        result[dealii::Utilities::trim(entry.substr(0, equals))] =
          BoundaryCondition::read(entry.substr(equals + 1), section + "others");
      }
    return result;
  }

  std::map<dealii::types::boundary_id, BoundaryCondition>
  BoundaryParameters::by_id(
    const std::map<std::string, dealii::types::boundary_id> &boundaries) const
  {
    const auto  by_name = conditions();
    std::string names;
    for (const auto &entry : boundaries)
      names += (names.empty() ? "" : ", ") + entry.first;
    for (const auto &entry : by_name)
      require(boundaries.count(entry.first) > 0 || entry.first == "bottom" ||
                entry.first == "top" || entry.first == "wall",
              "Boundary conditions/others",
              "the mesh has no boundary \"" + entry.first + "\"; it has " + names);

    std::map<dealii::types::boundary_id, BoundaryCondition> result;
    std::vector<BoundaryCondition>                          all;
    for (const auto &[name, id] : boundaries)
      {
        const auto own = by_name.find(name);
        result[id]     = own == by_name.end() ? by_name.at("wall") : own->second;
        all.push_back(result[id]);
      }
    require_exit(all, "; the mesh has " + names);
    return result;
  }
} // namespace graupel
