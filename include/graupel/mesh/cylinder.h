#ifndef graupel_mesh_cylinder_h
#define graupel_mesh_cylinder_h

#include <deal.II/base/parameter_handler.h>

namespace graupel
{
  /** The vessel: a circular cylinder that stands on z = 0, its axis along z. */
  struct Cylinder
  {
    /** Inner diameter [m]. */
    double diameter = 0.025;
    /** Height from the bottom (z = 0) to the top [m]. */
    double height = 0.169;

    /** Mean area of the empty cross-section where a mesh from a file fills less than the
     * circle; 0: the circle's [m^2]. Not a parameter. */
    double section = 0.;

    /** Area of the empty cross-section [m^2]. */
    double cross_section() const;

    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError unless both lengths are positive. */
    void check() const;
  };
} // namespace graupel

#endif
