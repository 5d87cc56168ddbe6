// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/own_mark.h>

#include <deal.II/base/numbers.h>

#include <boost/math/special_functions/bessel.hpp>

namespace graupel
{
  namespace
  {
    // Beyond it Bessel functions come near the end of double precision.
    constexpr double large = 200.;

    // exp(-x) I_n(x), for n = 0 and 1.
    double
    scaled_bessel(const unsigned int n, const double x)
    {
      return x > large
               ? (1. - (4. * n - 1.) / (8. * x)) / std::sqrt(2. * dealii::numbers::PI * x)
               : std::exp(-x) * boost::math::cyl_bessel_i(n, x);
    }
  } // namespace

  OwnMark::OwnMark(const double                 length,
                   const unsigned int           times,
                   const std::array<double, 3> &edges)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double h = edges[i], two_t = 2. * times * length * length / (h * h);
        here[i]       = scaled_bessel(0, two_t) / h;
        difference[i] = here[i] - scaled_bessel(1, two_t) / h;
      }
  }

  std::array<double, 3>
  OwnMark::factors(const dealii::Point<3> &x) const
  {
    std::array<double, 3> factor;
    for (unsigned int i = 0; i < 3; ++i)
      factor[i] = here[i] - 2. * x[i] * (1. - x[i]) * difference[i];
    return factor;
  }

  double
  OwnMark::density(const dealii::Point<3> &x) const
  {
    const auto factor = factors(x);
    return factor[0] * factor[1] * factor[2];
  }

  dealii::Tensor<1, 3>
  OwnMark::slopes(const dealii::Point<3> &x) const
  {
    const auto           factor = factors(x);
    dealii::Tensor<1, 3> slope;
    for (unsigned int i = 0; i < 3; ++i)
      slope[i] =
        (2. * x[i] - 1.) * difference[i] * factor[(i + 1) % 3] * factor[(i + 2) % 3];
    return slope;
  }
} // namespace graupel
