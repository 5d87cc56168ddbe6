#include <graupel/dem/particle_arrays.h>

#include <deal.II/base/numbers.h>

namespace graupel
{
  void
  ParticleArrays::resize(const unsigned int n_rows)
  {
    id.resize(n_rows);
    radius.resize(n_rows);
    mass.resize(n_rows);
    inertia.resize(n_rows);
    position.resize(n_rows);
    for (auto *vectors :
         {&velocity, &spin, &drift, &spin_drift, &force, &torque, &external_force})
      vectors->resize(n_rows);
  }

  void
  ParticleArrays::set_sphere(const unsigned int row, const double r, const double density)
  {
    radius[row]  = r;
    mass[row]    = density * sphere_volume(r);
    inertia[row] = 0.4 * mass[row] * r * r;
  }

  double
  sphere_volume(const double radius)
  {
    return 4. / 3. * dealii::numbers::PI * radius * radius * radius;
  }
} // namespace graupel
