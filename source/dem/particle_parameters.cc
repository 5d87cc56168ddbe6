// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/dem_parameters.h>
#include <graupel/dem/particles/particle_arrays.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <sstream>

namespace graupel
{
  double
  ParticleParameters::simulated_mass() const
  {
    return density * sphere_volume(simulated_radius());
  }

  void
  ParticleParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Particles");
    prm.add_parameter("diameter",
                      diameter,
                      "Diameter of the original particles, those of the real bed [m].");
    prm.add_parameter(
      "scale",
      scale,
      "Diameter of a simulated particle over that of an original one; each "
      "simulated particle stands for scale^3 original ones [-].");
    prm.add_parameter("density", density, "Density of the solid [kg/m^3].");
    std::ostringstream size;
    size << gravity;
    prm.declare_entry("gravity",
                      size.str(),
                      dealii::Patterns::List(dealii::Patterns::Double(), 1, 3),
                      "Acceleration of gravity: one number for its size, downwards along "
                      "the axis, or the three components of a vector [m/s^2].");
    prm.add_action("gravity", [this](const std::string &text) { set_gravity(text); });
    sizes.declare(prm);
    for (unsigned int t = 0; t < further_types.size(); ++t)
      {
        prm.enter_subsection("Type " + std::to_string(t + 2));
        further_types[t].declare(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void
  ParticleParameters::set_gravity(const std::string &text)
  {
    const auto numbers =
      dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(text));
    gravity           = numbers[0];
    gravity_direction = dealii::Tensor<1, 3>({0., 0., -1.});
    if (numbers.size() == 1)
      return;
    // Two numbers are refused by check(), as no size is.
    dealii::Tensor<1, 3> vector;
    for (unsigned int d = 0; d < 3; ++d)
      vector[d] = numbers.size() == 3 ? numbers[d] : std::nan("");
    gravity = vector.norm();
    if (gravity != 0.)
      gravity_direction = vector / gravity;
  }

  void
  ParticleParameters::check() const
  {
    require(diameter > 0.,
            "Particles/diameter",
            "a sphere needs a positive diameter, in metres");
    require(scale >= 1.,
            "Particles/scale",
            "scaled particles are larger than the original ones: choose 1 or more");
    require(
      density > 0., "Particles/density", "a solid needs a positive density, in kg/m^3");
    require(
      gravity >= 0.,
      "Particles/gravity",
      "gravity is one number that is not negative, its size, as it points downwards "
      "already; or a vector of three numbers, as in \"0, 0, -9.81\"");
    sizes.check(diameter, "Particles");
    double others = 0.;
    for (unsigned int t = 0; t < further_types.size(); ++t)
      {
        further_types[t].check("Particles/Type " + std::to_string(t + 2));
        others += further_types[t].mass_fraction;
      }
    require(others < 1.,
            "Particles/Type 2/mass fraction",
            "nothing is left for the first type: the others must stay below 1 together");
  }
} // namespace graupel
