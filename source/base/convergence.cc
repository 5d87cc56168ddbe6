// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/convergence.h>

#include <cmath>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    constexpr double       factor_of_safety = 1.25;
    constexpr double       smallest_order = 1e-3, largest_order = 20.;
    constexpr unsigned int bisections = 60;
    // Changes below this part of the value are round-off or solver tolerance.
    constexpr double negligible = 1e-13;

    // Weight of computation @p k at the size @p to in the polynomial through those from
    // the number @p first on.
    double
    lagrange_weight(const std::vector<Computation> &computations,
                    const std::size_t               first,
                    const std::size_t               k,
                    const double                    to)
    {
      double weight = 1.;
      for (std::size_t j = first; j < computations.size(); ++j)
        if (j != k)
          weight *=
            (to - computations[j].size) / (computations[k].size - computations[j].size);
      return weight;
    }

    double
    polynomial_value(const std::vector<Computation> &computations,
                     const std::size_t               first,
                     const double                    to)
    {
      double value = 0.;
      for (std::size_t k = first; k < computations.size(); ++k)
        value += lagrange_weight(computations, first, k, to) * computations[k].value;
      return value;
    }

    void
    check_numbers(const std::vector<Computation> &computations,
                  const std::vector<double>      &standard_errors)
    {
      if (computations.size() < 2 || computations.size() != standard_errors.size())
        throw std::invalid_argument("An extrapolation needs two computations or more, "
                                    "each with its error.");
    }

    double
    weight_of_distance(const Computation &computation, const double to)
    {
      return 1. / std::pow(computation.size - to, 2);
    }
  } // namespace

  GridConvergence
  grid_convergence(const Computation &fine,
                   const Computation &medium,
                   const Computation &coarse)
  {
    if (!(fine.size > 0. && medium.size > fine.size && coarse.size > medium.size))
      throw std::invalid_argument("The sizes must grow from the finest to the coarsest.");
    GridConvergence result;
    const double    e21 = medium.value - fine.value, e32 = coarse.value - medium.value;
    const double    size = std::abs(fine.value);
    if (size > 0.)
      result.relative_change = std::abs(e21) / size;
    if (std::abs(e21) <= negligible * size || std::abs(e32) <= negligible * size)
      return result;
    result.oscillates = e32 * e21 < 0.;

    // The ratio of the changes that order p makes grows with p; below its limit at
    // p = 0 the changes grow as the mesh is refined and there is no order.
    const double r21 = medium.size / fine.size, r32 = coarse.size / medium.size;
    const double s = result.oscillates ? -1. : 1., ratio = std::abs(e32 / e21);
    const auto   surplus = [&](const double p) {
      return std::pow(r21, p) * (std::pow(r32, p) - s) / (std::pow(r21, p) - s) - ratio;
    };
    double low = smallest_order, high = largest_order;
    if (surplus(low) >= 0. || surplus(high) <= 0.)
      return result;
    for (unsigned int n = 0; n < bisections; ++n)
      (surplus(0.5 * (low + high)) < 0. ? low : high) = 0.5 * (low + high);
    const double p      = 0.5 * (low + high);
    const double growth = std::pow(r21, p) - 1.;
    result.order        = p;
    result.extrapolated = fine.value - e21 / growth;
    if (size > 0.)
      result.index = factor_of_safety * result.relative_change / growth;
    return result;
  }

  Estimate
  extrapolate(const std::vector<Computation> &computations,
              const std::vector<double>      &standard_errors,
              const double                    to)
  {
    check_numbers(computations, standard_errors);
    for (std::size_t k = 1; k < computations.size(); ++k)
      if (computations[k].size == computations[k - 1].size)
        throw std::invalid_argument("Two computations have the same size.");
    const double value = polynomial_value(computations, 0, to);
    const double form =
      factor_of_safety * (value - polynomial_value(computations, 1, to));
    double square = form * form;
    for (std::size_t k = 0; k < computations.size(); ++k)
      {
        const double part = lagrange_weight(computations, 0, k, to) * standard_errors[k];
        square += part * part;
      }
    return {value, std::sqrt(square)};
  }

  Estimate
  mean_at(const std::vector<Computation> &computations,
          const std::vector<double>      &standard_errors,
          const double                    to)
  {
    check_numbers(computations, standard_errors);
    double sum = 0., values = 0.;
    for (const Computation &one : computations)
      {
        if (one.size == to)
          throw std::invalid_argument("A computation has the size that is asked for.");
        sum += weight_of_distance(one, to);
        values += weight_of_distance(one, to) * one.value;
      }
    const double mean    = values / sum;
    double       scatter = 0., squares = 0.;
    for (std::size_t k = 0; k < computations.size(); ++k)
      {
        const double weight = weight_of_distance(computations[k], to) / sum;
        scatter += weight * std::pow(computations[k].value - mean, 2);
        squares += std::pow(weight * standard_errors[k], 2);
      }
    return {mean, std::sqrt(scatter / (computations.size() - 1.) + squares)};
  }

  Estimate
  product(const Estimate &one, const Estimate &other)
  {
    return {one.value * other.value,
            std::hypot(one.error * other.value, other.error * one.value)};
  }

  std::optional<double>
  observed_order(const Computation &fine, const Computation &coarse)
  {
    if (!(fine.value > 0. && coarse.value > 0.) || fine.size == coarse.size)
      return std::nullopt;
    return std::log(coarse.value / fine.value) / std::log(coarse.size / fine.size);
  }
} // namespace graupel
