// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/bed_correlations.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <limits>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    // G = viscous V + inertial V^2.
    struct ErgunCoefficients
    {
      ErgunCoefficients(const FluidProperties &fluid, const double d, const double alpha)
        : viscous(150. * (1. - alpha) * (1. - alpha) * fluid.viscosity /
                  (alpha * alpha * alpha * d * d))
        , inertial(1.75 * (1. - alpha) * fluid.density / (alpha * alpha * alpha * d))
      {
      }

      const double viscous, inertial;
    };
  } // namespace

  double
  ergun_pressure_gradient(const FluidProperties &fluid,
                          const double           diameter,
                          const double           alpha,
                          const double           superficial_velocity)
  {
    const ErgunCoefficients ergun(fluid, diameter, alpha);
    return (ergun.viscous + ergun.inertial * superficial_velocity) * superficial_velocity;
  }

  double
  ergun_pressure_drop(const FluidProperties &fluid,
                      const double           diameter,
                      const double           alpha,
                      const double           superficial_velocity,
                      const double           length)
  {
    return length * ergun_pressure_gradient(fluid, diameter, alpha, superficial_velocity);
  }

  double
  ergun_superficial_velocity(const FluidProperties &fluid,
                             const double           diameter,
                             const double           alpha,
                             const double           gradient)
  {
    // Not the textbook root, which loses its digits where the flow is slow.
    const ErgunCoefficients ergun(fluid, diameter, alpha);
    const double            root =
      std::sqrt(ergun.viscous * ergun.viscous + 4. * ergun.inertial * gradient);
    return 2. * gradient / (ergun.viscous + root);
  }

  double
  ergun_onset_velocity(const FluidProperties &fluid,
                       const double           diameter,
                       const double           alpha,
                       const double           particle_density,
                       const double           gravity)
  {
    const double weight = (1. - alpha) * (particle_density - fluid.density) * gravity;
    return ergun_superficial_velocity(fluid, diameter, alpha, weight > 0. ? weight : 0.);
  }

  double
  parallel_channels_pressure_gradient(const FluidProperties      &fluid,
                                      const double                diameter,
                                      const std::vector<Channel> &channels,
                                      const double                superficial_velocity)
  {
    if (channels.empty())
      throw std::invalid_argument("A bed without channels has no pressure gradient.");

    // The common gradient lies between those of the channels on their own.
    double total_area = 0.;
    double least      = std::numeric_limits<double>::infinity();
    double most       = 0.;
    for (const Channel &channel : channels)
      {
        const double alone =
          ergun_pressure_gradient(fluid, diameter, channel.alpha, superficial_velocity);
        if (!(channel.area > 0. && alone >= 0. && std::isfinite(alone)))
          throw std::invalid_argument("A channel needs a positive area and a void "
                                      "fraction in (0, 1]; this one has " +
                                      std::to_string(channel.area) + " m^2 and " +
                                      std::to_string(channel.alpha) + ".");
        total_area += channel.area;
        least = std::min(least, alone);
        most  = std::max(most, alone);
      }
    const auto excess_flow = [&](const double gradient) {
      double flow = -total_area * superficial_velocity;
      for (const Channel &channel : channels)
        flow += channel.area *
                ergun_superficial_velocity(fluid, diameter, channel.alpha, gradient);
      return flow;
    };

    // Where all channels are alike, round-off decides the signs.
    if (excess_flow(least) >= 0.)
      return least;
    if (excess_flow(most) <= 0.)
      return most;
    std::uintmax_t iterations = 100;
    const auto     bracket =
      boost::math::tools::toms748_solve(excess_flow,
                                        least,
                                        most,
                                        boost::math::tools::eps_tolerance<double>(48),
                                        iterations);
    return (bracket.first + bracket.second) / 2.;
  }

  double
  de_klerk_void_fraction(const double z, const double bulk)
  {
    if (z <= 0.637)
      return (2.14 * z - 2.53) * z + 1.;
    const double pi = boost::math::constants::pi<double>();
    return bulk + 0.29 * std::exp(-0.6 * z) * std::cos(2.3 * pi * (z - 0.16)) +
           0.15 * std::exp(-0.9 * z);
  }

  double
  janssen_stress(const double specific_weight,
                 const double diameter,
                 const double wall_friction,
                 const double depth)
  {
    const double rate = 4. * wall_friction / diameter;
    // (1 - e^{-x}) / x, without losing digits where the wall carries little.
    const double x = rate * depth;
    return specific_weight * depth * (x == 0. ? 1. : -std::expm1(-x) / x);
  }
} // namespace graupel
