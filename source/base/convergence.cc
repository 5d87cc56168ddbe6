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

  std::optional<double>
  observed_order(const Computation &fine, const Computation &coarse)
  {
    if (!(fine.value > 0. && coarse.value > 0.) || fine.size == coarse.size)
      return std::nullopt;
    return std::log(coarse.value / fine.value) / std::log(coarse.size / fine.size);
  }
} // namespace graupel
