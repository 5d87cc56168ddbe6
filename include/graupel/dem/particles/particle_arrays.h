// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_particle_arrays_h
#define graupel_dem_particles_particle_arrays_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cstdint>
#include <vector>

namespace graupel
{
  /**
   * Place and motion of one particle: two cache lines, the record that the
   * contact loop loads and that ranks send each other every substep.
   */
  struct alignas(64) Body
  {
    /** Center [m]. */
    dealii::Point<3> position;
    /** Radius of the simulated particle [m]. */
    double radius = 0.;
    /**
     * Velocity [m/s]. While forces are computed: predicted to the end of the
     * substep, for the dampers.
     */
    dealii::Tensor<1, 3> velocity;
    /** Angular velocity [rad/s]; see velocity. */
    dealii::Tensor<1, 3> spin;
    /** Mean velocity over the current substep, by which springs move [m/s]. */
    dealii::Tensor<1, 3> drift;
    /** Mean angular velocity over the current substep [rad/s]. */
    dealii::Tensor<1, 3> spin_drift;
  };
  static_assert(sizeof(Body) == 16 * sizeof(double));

  /**
   * Sum of the contact forces (0 to 2) and torques (3 to 5) on one particle at
   * the current time, in the whole quanta of ForceQuanta; the rest is zero.
   */
  struct alignas(64) Load
  {
    std::array<std::int64_t, 8> quanta{};
  };

  /**
   * The particles of this rank as contiguous arrays: the workplace of the
   * contact loop. Rows 0..n_owned-1 are the rank's own particles, after a
   * migration in the order of the ParticleStore (by cell), newly inserted ones
   * behind them; rows from n_owned on are copies of other ranks' particles near
   * the border (ghosts), of which only id, type and body are kept current.
   */
  struct ParticleArrays
  {
    /** Global number of the particle, unique over all ranks, never reused. */
    std::vector<std::int64_t> id;
    /** Its type, an index into DemParameters::types. */
    std::vector<unsigned char> type;
    /** Place and motion. */
    std::vector<Body> body;
    /** Mass [kg]; own rows only. */
    std::vector<double> mass;
    /** Contact force and torque; own rows only. */
    std::vector<Load> load;
    /**
     * Force from outside (drag, pressure gradient, but not gravity), constant
     * until changed; it travels with the particle [N]; own rows only.
     */
    std::vector<dealii::Tensor<1, 3>> external_force;
    /** Torque from outside, likewise [N m]; own rows only. */
    std::vector<dealii::Tensor<1, 3>> external_torque;
    /**
     * Solid fraction around it at the last step of a fluid, which wants to know at the
     * next how that changes; it travels with the particle [-]; 0: none yet; own rows
     * only.
     */
    std::vector<double> solid_fraction;
    /** Number of own particles. */
    unsigned int n_owned = 0;

    /** Own rows and ghosts. */
    unsigned int
    n_rows() const
    {
      return id.size();
    }

    /** Gives every array @p n_rows rows; new ones are zero. */
    void resize(const unsigned int n_rows);
  };

  /** A particle to be put into the vessel. */
  struct NewParticle
  {
    /** Center [m]. */
    dealii::Point<3> position;
    /** Radius of the simulated particle [m]. */
    double radius = 0.;
    /** Velocity [m/s]. */
    dealii::Tensor<1, 3> velocity = {};
    /** Angular velocity [rad/s]. */
    dealii::Tensor<1, 3> spin = {};
    /** Index into DemParameters::types. */
    unsigned char type = 0;
    /** Its number, which no particle has had; negative: the next free one. */
    std::int64_t id = -1;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &position &radius &velocity &spin &type &id;
    }
  };

  /** Volume of a sphere [m^3]. */
  double sphere_volume(const double radius);
} // namespace graupel

#endif
