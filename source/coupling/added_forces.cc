// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/coupling/added_forces.h>

namespace graupel
{
  using Vector = dealii::Tensor<1, 3>;

  AddedForces::AddedForces(const AddedForceLaws &laws, const NodalSpace &nodes)
    : forces(laws.parameters, laws.fluid)
    , has_viscous_stress(laws.parameters.viscous_stress)
    , scales(laws.scales)
    , fields(nodes)
    , smooth(nodes)
  {
  }

  void
  AddedForces::follow(const FlowSolver &flow, const Filter &filter)
  {
    AssertThrow(flow.shares_viscous_stress() == has_viscous_stress,
                dealii::ExcMessage("Fluid and particles share the viscous stress or "
                                   "neither of them."));
    fields = flow.derivatives();
    smooth = fields;
    std::vector<NodalVector *> smoothed;
    for (NodalVectorField *field :
         {&smooth.acceleration, &smooth.vorticity, &smooth.viscous_force})
      for (NodalVector &component : *field)
        smoothed.push_back(&component);
    filter.smooth(smoothed);
  }

  void
  AddedForces::evaluate(const ParticleArrays      &particles,
                        const ParticleTransfer    &transfer,
                        const std::vector<Vector> &velocity,
                        const std::vector<double> &alpha,
                        const double               step)
  {
    const unsigned int n            = particles.n_owned;
    const auto         acceleration = transfer.sample(smooth.acceleration);
    const auto         vorticity    = transfer.sample(smooth.vorticity);
    const auto         viscous      = transfer.sample(smooth.viscous_force);
    rate_scale                      = std::isfinite(step) ? 1. / step : 0.;
    mass.resize(n);
    rate.resize(n);
    known_force.resize(n);
    carried_velocity.resize(n);
    for (unsigned int row = 0; row < n; ++row)
      {
        const Body  &body     = particles.body[row];
        const double volume   = sphere_volume(body.radius);
        const auto  &u        = velocity[row];
        mass[row]             = forces.virtual_mass(alpha[row], volume);
        rate[row]             = mass[row] * rate_scale;
        carried_velocity[row] = rate_scale > 0. ? u - acceleration[row] / rate_scale : u;
        known_force[row] =
          rate[row] * body.velocity + forces.lift(2. * body.radius,
                                                  scales[particles.type[row]],
                                                  u - body.velocity,
                                                  vorticity[row],
                                                  0.5 * vorticity[row] - body.spin);
        if (has_viscous_stress)
          known_force[row] += volume * viscous[row];
      }
  }

  std::vector<Vector>
  AddedForces::torques(const ParticleArrays   &particles,
                       const ParticleTransfer &transfer,
                       const double            step) const
  {
    std::vector<Vector> result(particles.n_owned);
    if (!std::isfinite(step))
      return result;
    const auto vorticity = transfer.sample(smooth.vorticity);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const Body  &body    = particles.body[row];
        const double inertia = 0.4 * particles.mass[row] * body.radius * body.radius;
        result[row]          = forces.torque(
          2. * body.radius, inertia, step, 0.5 * vorticity[row] - body.spin);
      }
    return result;
  }
} // namespace graupel
