// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/closures/scaling.h>

#include <muParser.h>

#include <sstream>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    const char *const expression_name = "Coupling/scaling expression";

    // Keeps Cd finite in an expression at rest.
    constexpr double least_reynolds = 1e-6;

    // A filtered void fraction may overshoot 1 by a little; it counts as 1.
    constexpr double greatest_void_fraction = 1.01;

    std::string
    at(const double alpha, const double reynolds)
    {
      std::ostringstream text;
      text << "Re = " << reynolds << ", alpha = " << alpha;
      return text.str();
    }
  } // namespace

  double
  exact_drag_number(const DragLaw &law,
                    const double   alpha,
                    const double   reynolds,
                    const double   scale)
  {
    // s C(Re_1) times Re_s = s Re_1.
    return scale * scale * law.drag_number(alpha, reynolds / scale);
  }

  double
  ricklick_baran_drag_number(const DragLaw &law,
                             const double   alpha,
                             const double   reynolds,
                             const double   scale)
  {
    const double unlimited = scale * law.drag_number(alpha, reynolds) - 1.75 * reynolds;
    // In this order std::max keeps a NaN.
    return scale * std::max(unlimited, 0.);
  }

  // The parser reads its variables where it was told that they are.
  struct ScalingExpression::Compiled
  {
    std::string formula;
    mu::Parser  parser;
    double      coefficient = 1., reynolds = 1., alpha = 0.5;
  };

  ScalingExpression::ScalingExpression(const std::string &formula,
                                       const double       scale,
                                       const double       diameter)
    : compiled(std::make_shared<Compiled>())
  {
    compiled->formula = formula;
    try
      {
        compiled->parser.DefineVar("Cd", &compiled->coefficient);
        compiled->parser.DefineVar("Re", &compiled->reynolds);
        compiled->parser.DefineVar("alpha", &compiled->alpha);
        compiled->parser.DefineConst("s", scale);
        compiled->parser.DefineConst("d", diameter);
        compiled->parser.SetExpr(formula);
        compiled->parser.Eval(); // parses
      }
    catch (const mu::Parser::exception_type &error)
      {
        throw InputError(expression_name,
                         "muParser does not understand it: " + error.GetMsg() +
                           " It may use Cd, Re, alpha, s and d");
      }
  }

  double
  ScalingExpression::drag_number(const DragLaw &law,
                                 const double   alpha,
                                 const double   reynolds) const
  {
    const double re       = std::max(reynolds, least_reynolds);
    compiled->coefficient = law.drag_number(alpha, re) / re;
    compiled->reynolds    = re;
    compiled->alpha       = alpha;
    const double result   = compiled->parser.Eval();
    if (!(result >= 0. && std::isfinite(result)))
      throw std::runtime_error("The scaling expression " + compiled->formula +
                               " gives the drag coefficient " + std::to_string(result) +
                               " at " + at(alpha, re) +
                               "; a drag coefficient is positive. Limit it, as in "
                               "max(..., 0)");
    return result * re;
  }

  void
  DragParameters::declare(dealii::ParameterHandler &prm)
  {
    std::string names, explained;
    for (const DragLaw &known : drag_laws())
      {
        names += (names.empty() ? "" : "|") + known.name;
        explained += " " + known.name + ": " + known.form + " (" + known.source + ").";
      }

    prm.enter_subsection("Coupling");
    prm.add_parameter("drag law",
                      law,
                      "Drag of a sphere in a bed." + explained,
                      dealii::Patterns::Selection(names));
    prm.add_parameter(
      "scaling",
      scaling,
      "How the drag of a simulated sphere follows from the s^3 original ones "
      "that it stands for. exact: the sum of theirs; ricklick-baran: "
      "s (s Cd - 1.75), limited to positive values, as printed by Ricklick & "
      "Baran (2014); expression: the formula below; none: the law for a "
      "sphere of the simulated diameter.",
      dealii::Patterns::Selection("exact|ricklick-baran|expression|none"));
    prm.add_parameter(
      "scaling expression",
      expression,
      "Formula for the drag coefficient of a simulated sphere, in use with "
      "\"set scaling = expression\": of Cd and Re, the law's drag coefficient "
      "and Reynolds number for the simulated diameter, alpha, the void "
      "fraction, s, the scale, and d, the original diameter in metres.");
    prm.leave_subsection();
  }

  void
  DragParameters::check(const double scale, const double diameter) const
  {
    if (scaling != "expression")
      return;
    const ScalingExpression formula(expression, scale, diameter);
    for (const double alpha : {0.3, 0.4, 0.5, 0.6, 0.7})
      for (const double reynolds : {0., 1e-3, 1., 30., 300., 1000.})
        try
          {
            formula.drag_number(find_drag_law(law), alpha, reynolds);
          }
        catch (const std::runtime_error &error)
          {
            throw InputError(expression_name, error.what());
          }
  }

  Drag::Drag(const DragParameters  &parameters,
             const FluidProperties &fluid,
             const double           diameter,
             const double           scale)
    : drag_law(&find_drag_law(parameters.law))
    , around(fluid)
    , scale(scale)
    , reynolds_per_slip(fluid.density * scale * diameter / fluid.viscosity)
    , beta_per_drag_number(dealii::numbers::PI / 8. * fluid.viscosity * scale * diameter)
  {
    static const std::map<std::string, Form> forms{
      {"exact", Form::exact},
      {"ricklick-baran", Form::ricklick_baran},
      {"expression", Form::expression},
      {"none", Form::none}};
    form = forms.at(parameters.scaling);
    if (form == Form::expression)
      expression =
        std::make_shared<ScalingExpression>(parameters.expression, scale, diameter);
  }

  double
  Drag::reynolds(const double slip) const
  {
    return reynolds_per_slip * slip;
  }

  const DragLaw &
  Drag::law() const
  {
    return *drag_law;
  }

  double
  Drag::drag_number(const double alpha, const double reynolds) const
  {
    switch (form)
      {
        case Form::exact:
          return exact_drag_number(*drag_law, alpha, reynolds, scale);
        case Form::ricklick_baran:
          return ricklick_baran_drag_number(*drag_law, alpha, reynolds, scale);
        case Form::expression:
          return expression->drag_number(*drag_law, alpha, reynolds);
        case Form::none:
          break;
      }
    return drag_law->drag_number(alpha, reynolds);
  }

  double
  Drag::beta(const double alpha, const double slip, const double size) const
  {
    const double re = reynolds(slip) * size;
    if (!(alpha > 0. && alpha <= greatest_void_fraction))
      throw std::runtime_error("No drag law holds at " + at(alpha, re) +
                               ": the void fraction must lie in (0, 1]");
    const double result =
      beta_per_drag_number * size * drag_number(std::min(alpha, 1.), re);
    if (!(result >= 0. && std::isfinite(result)))
      throw std::runtime_error("The drag law " + drag_law->name +
                               " gives the coefficient " + std::to_string(result) +
                               " kg/s at " + at(alpha, re));
    return result;
  }
} // namespace graupel
