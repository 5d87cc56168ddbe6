#ifndef graupel_dem_particle_arrays_h
#define graupel_dem_particle_arrays_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <cstdint>
#include <vector>

namespace graupel
{
  /**
   * The particles of this rank as contiguous arrays: the workplace of the
   * contact loop. Rows 0..n_owned-1 are the rank's own particles in the order
   * of the ParticleStore (by cell); rows from n_owned on are copies of other
   * ranks' particles near the border (ghosts), of which only id, radius, mass,
   * position and the velocities are kept current.
   */
  struct ParticleArrays
  {
    /** Global number of the particle, unique over all ranks, never reused. */
    std::vector<std::int64_t> id;
    /** Radius of the simulated particle [m]. */
    std::vector<double> radius;
    /** Mass [kg]. */
    std::vector<double> mass;
    /** Moment of inertia of a solid sphere, 2/5 m r^2 [kg m^2]. */
    std::vector<double> inertia;
    /** Center [m]. */
    std::vector<dealii::Point<3>> position;
    /**
     * Velocity [m/s]. While forces are computed: predicted to the end of the
     * substep, for the dampers.
     */
    std::vector<dealii::Tensor<1, 3>> velocity;
    /** Angular velocity [rad/s]; see velocity. */
    std::vector<dealii::Tensor<1, 3>> spin;
    /** Mean velocity over the current substep, by which springs move [m/s]. */
    std::vector<dealii::Tensor<1, 3>> drift;
    /** Mean angular velocity over the current substep [rad/s]. */
    std::vector<dealii::Tensor<1, 3>> spin_drift;
    /** Sum of the contact forces at the current time [N]; own rows only. */
    std::vector<dealii::Tensor<1, 3>> force;
    /** Sum of the contact torques at the current time [N m]; own rows only. */
    std::vector<dealii::Tensor<1, 3>> torque;
    /**
     * Force from outside (drag, pressure gradient, but not gravity), constant
     * until changed; it travels with the particle [N]; own rows only.
     */
    std::vector<dealii::Tensor<1, 3>> external_force;
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

    /** Sets radius, mass and inertia of a sphere of @p density [kg/m^3]. */
    void set_sphere(const unsigned int row, const double radius, const double density);
  };

  /** Volume of a sphere [m^3]. */
  double sphere_volume(const double radius);
} // namespace graupel

#endif
