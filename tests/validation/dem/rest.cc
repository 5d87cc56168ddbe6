// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "beds.h"

namespace
{
  using namespace graupel;
  using Vector = dealii::Tensor<1, 3>;

  // Law: a settled bed stays as it is through a million substeps: center of mass, force
  // on the bottom and energy of motion do not drift. Limits: 1e-12 m of height, 1e-9 of
  // the force, 1e-20 J (a rise of 1e-13 m). Spheres that touch the bottom only may spin
  // about the vertical for ever, as no law resists twist; their energy must stay too.
  TEST(Rest, MillionSubsteps)
  {
    DemParameters p;
    p.particles.diameter = 3.2e-3;
    RainedBed  bed(p, tube(0.04), 100);
    Dem       &dem    = bed.dem;
    const auto center = [&]() {
      double sum = 0.;
      for (unsigned int i = 0; i < dem.particles().n_owned; ++i)
        sum += dem.particles().body[i].position[2];
      return dealii::Utilities::MPI::sum(sum, dem.communicator()) / dem.n_global();
    };
    dem.advance(1.);
    const double dt = dem.substep();
    dem.advance(1000 * dt);
    const auto moving = [&]() {
      double sum = 0.;
      for (unsigned int i = 0; i < dem.particles().n_owned; ++i)
        sum +=
          0.5 * dem.particles().mass[i] * dem.particles().body[i].velocity.norm_square();
      return dealii::Utilities::MPI::sum(sum, dem.communicator()) / dem.n_global();
    };
    const double height = center(), force = dem.bottom_force();
    const double energy = dem.mean_kinetic_energy();
    for (unsigned int k = 0; k < 10; ++k)
      {
        dem.advance(99000 * dt);
        dem.advance(1000 * dt);
        std::ostringstream at;
        at << "after " << (k + 1) << "00,000 substeps, ";
        expect_near(at.str() + "center [m]", center(), height, 1e-12);
        expect_near(at.str() + "bottom force over that before",
                    dem.bottom_force() / force,
                    1.,
                    1e-9);
        expect_near(at.str() + "energy of translation [J]", moving(), 0., 1e-20);
        expect_near(
          at.str() + "kinetic energy [J]", dem.mean_kinetic_energy(), energy, 1e-20);
      }
  }
} // namespace
