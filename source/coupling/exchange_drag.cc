// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/self_disturbance.h>
#include <graupel/coupling/exchange.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // More of the undisturbed slip than this is not taken for a particle's own work [-]:
    // the superposition of both is linear.
    constexpr double largest_part = 0.5;
    // Repetitions for that part, and the change at which it is found [-].
    constexpr unsigned int repetitions = 20;
    constexpr double       converged   = 1e-6;

    [[noreturn]] void
    fail_at(const dealii::Point<3> &position, const std::string &reason)
    {
      std::ostringstream message;
      message << "At the particle at (" << position << ") m: " << reason;
      throw std::runtime_error(message.str());
    }
  } // namespace

  void
  Exchange::find_drag_coefficients(const ParticleArrays &particles)
  {
    look_ahead(particles);
    const unsigned int n = particles.n_owned;
    felt_velocity        = transfer.sample(smooth_velocity);
    beta.resize(n);
    slip.resize(n);
    felt_alpha.resize(n);
    own_part.assign(n, 0.);
    for (unsigned int row = 0; row < n; ++row)
      {
        const auto felt = felt_velocity[row] - particles.body[row].velocity;
        felt_alpha[row] =
          void_fraction_upstream(row, 2. * particles.body[row].radius, felt);
        try
          {
            find_coefficient(
              row, drags[particles.type[row]], particles.body[row].radius, felt.norm());
          }
        catch (const std::exception &error)
          {
            fail_at(particles.body[row].position,
                    error.what() + (", where the void fraction of the flow is " +
                                    std::to_string(flow_alpha[row])));
          }
      }
  }

  void
  Exchange::find_coefficient(const unsigned int row,
                             const DragOfType  &drag,
                             const double       radius,
                             const double       felt)
  {
    const double a    = felt_alpha[row];
    double      &part = own_part[row];
    for (unsigned int n = 0; n < repetitions; ++n)
      {
        const double before = part;
        slip[row]           = felt / ((1. - part) * of_slip[row] * a);
        beta[row]           = drag.beta(a, slip[row], radius) / (of_drag[row] * a * a);
        part = std::min(largest_part, beta[row] * own_mobility(row, drag.drag.fluid()));
        if (std::abs(part - before) < converged)
          break;
      }
    beta[row] /= 1. - part;
  }

  double
  Exchange::own_mobility(const unsigned int row, const FluidProperties &fluid) const
  {
    // Depositing and sampling spread a particle, too.
    const double variance =
      4. * filter_length * filter_length + 2. / 3. * transfer.variance(row);
    const double s = std::sqrt(std::max(variance, std::numeric_limits<double>::min()));
    const double others = surroundings[row] / volume[row] * beta[row] / felt_alpha[row];
    return isolation[row] * screened_mobility(fluid, s, slip[row], others);
  }
} // namespace graupel
