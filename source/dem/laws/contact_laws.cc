// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/laws/contact_laws.h>

#include <deal.II/base/numbers.h>

namespace graupel
{
  using dealii::numbers::PI;

  namespace
  {
    double
    normal_compliance(const Elasticity &body)
    {
      return (1. - body.poisson_ratio * body.poisson_ratio) / body.young_modulus;
    }

    double
    shear_compliance(const Elasticity &body)
    {
      return 2. * (2. - body.poisson_ratio) * (1. + body.poisson_ratio) /
             body.young_modulus;
    }

    double
    damping_ratio(const double restitution)
    {
      const double l = std::log(restitution);
      return -l / std::sqrt(l * l + PI * PI);
    }
  } // namespace

  PairMaterial::PairMaterial(const Elasticity &first,
                             const Elasticity &second,
                             const Surface    &surface,
                             const double      normal_stiffness,
                             const double      stiffness_ratio)
    : young(1. / (normal_compliance(first) + normal_compliance(second)))
    , shear(1. / (shear_compliance(first) + shear_compliance(second)))
    , damping(damping_ratio(surface.restitution))
    , normal_stiffness(normal_stiffness)
    , stiffness_ratio(stiffness_ratio)
    , mindlin_damping_ratio(std::sqrt(4. * shear / young))
    , linear_damping_ratio(std::sqrt(stiffness_ratio))
    , friction(surface.friction)
    , rolling_resistance(surface.rolling_resistance)
    , adhesion(surface.adhesion)
  {
  }

  double
  rayleigh_time(const double radius, const double density, const Elasticity &elasticity)
  {
    const double nu = elasticity.poisson_ratio;
    const double G  = elasticity.young_modulus / (2. * (1. + nu));
    return PI * radius * std::sqrt(density / G) / (0.1631 * nu + 0.8766);
  }

  double
  hertz_overlap(const double force, const double young, const double radius)
  {
    return std::pow(3. * force / (4. * young * std::sqrt(radius)), 2. / 3.);
  }
} // namespace graupel
