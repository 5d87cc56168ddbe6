// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_added_forces_h
#define graupel_coupling_added_forces_h

#include <graupel/closures/sphere_forces.h>
#include <graupel/coupling/filter.h>
#include <graupel/coupling/particle_transfer.h>
#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  /** What Exchange needs to know for them; by default there are none. */
  struct AddedForceLaws
  {
    ForceParameters parameters;
    FluidProperties fluid;
    /** By type of particle [-]. */
    std::vector<double> scales;
  };

  /**
   * The forces on the particles beside drag, pressure and buoyancy, felt as fields of the
   * nodes are, by W S (see Exchange). With the virtual mass M = C rho V, the step dt, a
   * particle's velocity v' at its begin and v at its end, and the velocity that the fluid
   * brings along from its begin,
   *
   *   e = u' - dt (u' grad) u',
   *
   * of the last flow u', the force on a particle is
   *
   *   F = M/dt (W S (u - e) - (v - v')) + lift + V W S div tau(u').
   *
   * The first part is in the fluid's matrix, as drag is, of first order in the step. The
   * lift is that of the last flow and v'. Without a step, in a steady flow, there is no
   * virtual mass. The inertia moves particles in contact as those without; an impact
   * within a step is one of the bare masses.
   */
  class AddedForces
  {
  public:
    /** @p nodes must outlive this object. */
    AddedForces(const AddedForceLaws &laws, const NodalSpace &nodes);

    /** Takes the fields of the last @p flow, u'. Collective. */
    void follow(const FlowSolver &flow, const Filter &filter);

    /**
     * All that is known before the fluid's step of @p step [s]: of the own particles
     * where @p transfer has them, from W S u' = @p velocity [m/s] and at the void
     * fraction @p alpha [-], by row.
     */
    void evaluate(const ParticleArrays                    &particles,
                  const ParticleTransfer                  &transfer,
                  const std::vector<dealii::Tensor<1, 3>> &velocity,
                  const std::vector<double>               &alpha,
                  const double                             step);

    /** M by row [kg]. */
    const std::vector<double> &
    virtual_mass() const
    {
      return mass;
    }

    /** M/dt by row, 0 in a steady flow [kg/s]. */
    const std::vector<double> &
    inertia() const
    {
      return rate;
    }

    /** M/dt v' + lift + V W S div tau by row [N]. */
    const std::vector<dealii::Tensor<1, 3>> &
    known() const
    {
      return known_force;
    }

    /** W S e by row [m/s]. */
    const std::vector<dealii::Tensor<1, 3>> &
    carried() const
    {
      return carried_velocity;
    }

    /** e of component @p i at the local node @p k, with u' of component i as @p velocity
     * [m/s]. */
    double
    carried(const double velocity, const unsigned int i, const unsigned int k) const
    {
      return rate_scale > 0.
               ? velocity - fields.acceleration[i].local_element(k) / rate_scale
               : velocity;
    }

    /** Mean torque of the rotational drag on each own particle over @p step [s], from the
     * vorticity of the last flow where @p transfer has the particles [N m]; 0 in a steady
     * flow. */
    std::vector<dealii::Tensor<1, 3>> torques(const ParticleArrays   &particles,
                                              const ParticleTransfer &transfer,
                                              const double            step) const;

  private:
    const SphereForces                forces;
    const bool                        has_viscous_stress;
    const std::vector<double>         scales;
    FlowDerivatives                   fields;          // of u'
    FlowDerivatives                   smooth;          // S of them
    double                            rate_scale = 0.; // 1/dt [1/s]
    std::vector<double>               mass, rate;
    std::vector<dealii::Tensor<1, 3>> known_force, carried_velocity;
  };
} // namespace graupel

#endif
