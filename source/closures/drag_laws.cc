// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/drag_laws.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    // C_0 x of one sphere in clear fluid, C_0 = (0.63 + 4.8 / sqrt(x))^2.
    double
    dallavalle_drag_number(const double x)
    {
      const double root = 0.63 * std::sqrt(x) + 4.8;
      return root * root;
    }

    // The transition between viscous and inertial flow in Di Felice's exponent.
    double
    bell(const double x)
    {
      const double distance = 1.5 - std::log10(x); // infinite at rest
      return std::exp(-0.5 * distance * distance);
    }

    // Drag over that of Stokes at the superficial slip, in the limit of slow flow.
    double
    viscous_normalised_drag(const double alpha)
    {
      const double phi = 1. - alpha;
      return 10. * phi / (alpha * alpha) + alpha * alpha * (1. + 1.5 * std::sqrt(phi));
    }
  } // namespace

  double
  ergun_drag_number(const double alpha, const double reynolds)
  {
    const double viscous  = 150. * (1. - alpha) / alpha;
    const double inertial = 1.75 * reynolds;
    return 4. / 3. * (viscous + inertial);
  }

  double
  wen_yu_drag_number(const double alpha, const double reynolds)
  {
    const double superficial = alpha * reynolds;
    const double one_sphere  = superficial < 1000.
                                 ? 24. * (1. + 0.15 * std::pow(superficial, 0.687))
                                 : 0.44 * superficial;
    return one_sphere * std::pow(alpha, -2.65);
  }

  double
  gidaspow_drag_number(const double alpha, const double reynolds)
  {
    return alpha < 0.8 ? ergun_drag_number(alpha, reynolds)
                       : wen_yu_drag_number(alpha, reynolds);
  }

  double
  blended_gidaspow_drag_number(const double alpha, const double reynolds)
  {
    const double weight =
      std::atan(150. * 1.75 * (alpha - 0.8)) / dealii::numbers::PI + 0.5;
    return (1. - weight) * ergun_drag_number(alpha, reynolds) +
           weight * wen_yu_drag_number(alpha, reynolds);
  }

  double
  di_felice_drag_number(const double alpha, const double reynolds)
  {
    const double superficial = alpha * reynolds;
    const double exponent    = 3.7 - 0.65 * bell(superficial);
    return dallavalle_drag_number(superficial) * std::pow(alpha, 1. - exponent);
  }

  double
  rong_drag_number(const double alpha, const double reynolds)
  {
    const double superficial = alpha * reynolds;
    const double exponent =
      2.65 * (alpha + 1.) - (5.3 - 3.5 * alpha) * alpha * alpha * bell(superficial);
    return dallavalle_drag_number(superficial) * std::pow(alpha, 1. - exponent);
  }

  double
  koch_hill_drag_number(const double alpha, const double reynolds)
  {
    const double phi     = 1. - alpha;
    const double log_phi = phi > 0. ? std::log(phi) : 0.; // phi log(phi) vanishes there
    const double viscous =
      phi < 0.4
        ? (1. + 3. * std::sqrt(phi / 2.) + 135. / 64. * phi * log_phi + 16.14 * phi) /
            (1. + phi * (0.681 + phi * (-8.48 + phi * 8.16)))
        : 10. * phi / std::pow(alpha, 3);
    const double inertial = 0.0673 + 0.212 * phi + 0.0232 / std::pow(alpha, 5);
    return 24. * alpha * alpha * (viscous + 0.5 * inertial * alpha * reynolds);
  }

  double
  beetstra_drag_number(const double alpha, const double reynolds)
  {
    const double phi = 1. - alpha, superficial = alpha * reynolds;
    const double inertial =
      0.413 / (24. * alpha * alpha) *
      ((1. / alpha + 3. * phi * alpha) * superficial +
       8.4 * std::pow(superficial, 0.657)) /
      (1. + std::pow(10., 3. * phi) * std::pow(superficial, -0.5 * (1. + 4. * phi)));
    return 24. * alpha * (viscous_normalised_drag(alpha) + inertial);
  }

  double
  tang_drag_number(const double alpha, const double reynolds)
  {
    const double phi = 1. - alpha, superficial = alpha * reynolds;
    const double fourth = std::pow(alpha, -4);
    const double inertial =
      (0.11 * phi * (1. + phi) - 0.00456 * fourth) * superficial +
      (0.169 * alpha + 0.0644 * fourth) * std::pow(superficial, 0.657);
    return 24. * alpha * (viscous_normalised_drag(alpha) + inertial);
  }

  double
  gibilaro_drag_number(const double alpha, const double reynolds)
  {
    return 4. / 3. * (17.3 / alpha + 0.336 * reynolds) * std::pow(alpha, -1.8);
  }

  double
  kta_drag_number(const double alpha, const double reynolds)
  {
    const double phi      = 1. - alpha;
    const double inertial = 6. * std::pow(phi, 0.1) * std::pow(alpha * reynolds, 0.9);
    return 2. / 3. / alpha * (320. * phi + inertial);
  }

  double
  erdim_drag_number(const double alpha, const double reynolds)
  {
    const double phi = 1. - alpha;
    const double inertial =
      2.81 * std::pow(phi, 0.096) * std::pow(alpha * reynolds, 0.904);
    return 4. / 3. / alpha * (160. * phi + inertial);
  }

  const std::vector<DragLaw> &
  drag_laws()
  {
    static const std::vector<DragLaw> laws{
      {"gidaspow",
       gidaspow_drag_number,
       "ergun below void fraction 0.8, wen-yu from there on",
       "Ding & Gidaspow (1990)"},
      {"ergun",
       ergun_drag_number,
       "C_d = 4/3 (150 (1 - alpha) / (alpha Re) + 1.75)",
       "Ergun (1952)"},
      {"wen-yu",
       wen_yu_drag_number,
       "C_d = 24 / (alpha Re) (1 + 0.15 (alpha Re)^0.687) alpha^-1.65, with 0.44 in "
       "place "
       "of the first factors from alpha Re = 1000 on",
       "Wen & Yu (1966)"},
      {"gidaspow-blended",
       blended_gidaspow_drag_number,
       "ergun and wen-yu weighed by an arctangent around void fraction 0.8",
       "Lu & Gidaspow (2003)"},
      {"di-felice",
       di_felice_drag_number,
       "C_d = (0.63 + 4.8 / sqrt(alpha Re))^2 alpha^(2 - chi(alpha Re))",
       "Di Felice (1994)"},
      {"rong",
       rong_drag_number,
       "as di-felice, chi also of alpha",
       "Rong, Dong & Yu (2013)"},
      {"koch-hill",
       koch_hill_drag_number,
       "C_d = 24 alpha^2 (F0 / Re + F3 alpha / 2)",
       "Hill, Koch & Ladd (2001)"},
      {"beetstra",
       beetstra_drag_number,
       "C_d = 24 alpha F / Re, F a fit to lattice-Boltzmann simulations",
       "Beetstra, van der Hoef & Kuipers (2007)"},
      {"tang",
       tang_drag_number,
       "C_d = 24 alpha F / Re, F a fit to immersed-boundary simulations",
       "Tang et al. (2015)"},
      {"gibilaro",
       gibilaro_drag_number,
       "C_d = 4/3 (17.3 / (alpha Re) + 0.336) alpha^-1.8",
       "Gibilaro et al. (1985)"},
      {"kta",
       kta_drag_number,
       "the rule for pebble beds, of packed beds only",
       "KTA 3102.3 (1981)"},
      {"erdim",
       erdim_drag_number,
       "C_d = 4/3 (1 - alpha) / (alpha Re) (160 + 2.81 (alpha Re / (1 - alpha))^0.904), "
       "of packed beds only",
       "Erdim, Akgiray & Demir (2015)"}};
    return laws;
  }

  const DragLaw &
  find_drag_law(const std::string &name)
  {
    for (const DragLaw &law : drag_laws())
      if (law.name == name)
        return law;
    throw std::out_of_range("There is no drag law \"" + name + "\".");
  }

  double
  drag_coefficient(const DragLaw &law, const double alpha, const double reynolds)
  {
    return law.drag_number(alpha, reynolds) / reynolds;
  }

  double
  polydisperse_drag_factor(const double alpha, const double y)
  {
    return y * y * (alpha + (1. - alpha) * y);
  }
} // namespace graupel
