// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "beds.h"

namespace
{
  using namespace graupel;
  using dealii::numbers::PI;

  // Mass that the bottom feels over that of a bed of height H, all wall friction
  // mobilised: lambda / H (1 - exp(-H / lambda)), lambda = D / (4 mu K).
  // Source: Janssen, Z. Ver. Dt. Ing. 39 (1895) 1045.
  double
  janssen(const double height, const double lambda)
  {
    return lambda / height * (1. - std::exp(-height / lambda));
  }

  struct Column
  {
    double height, mass, effective;
  };

  Column
  column(const unsigned int count, const double friction)
  {
    DemParameters p;
    p.particles.diameter                = 3.2e-3;
    p.contact.packing_wall_friction     = 0.;
    p.contact.wall_surface.friction     = 0.;
    p.contact.particle_surface.friction = friction;
    RainedBed bed(p, tube(0.32), count);
    // Rain packs a bed harder than its weight does and leaves the friction at the wall
    // in any state. So the wall is smooth at first; it gets rough while the bed has
    // little weight, and gravity, put on slowly, presses the bed down along it.
    bed.dem.set_gravity(0.02 * 9.81);
    bed.dem.advance(0.4);
    bed.dem.set_friction(friction, friction);
    for (unsigned int k = 1; k <= 49; ++k)
      {
        bed.dem.set_gravity(9.81 * (0.02 + 0.02 * k));
        bed.dem.advance(0.02);
      }
    bed.dem.advance(0.3);
    bed.dem.advance(0.1);
    const auto observed =
      BedObservables(bed.dem.particles(), bed.dem.vessel_shape(), bed.dem.communicator())
        .bed();
    const double weight = bed.dem.weight();
    expect_near("bottom and wall force over weight",
                (bed.dem.bottom_force() + bed.dem.wall_force()) / weight,
                1.,
                1e-3);
    return {observed.height, weight / 9.81, bed.dem.bottom_force() / 9.81};
  }

  // Laws: the effective mass saturates: from 2,000 to 4,000 spheres it grows by less
  // than a tenth of what is added; it follows Janssen's curve with K of one fit, which
  // lies between the active state (1 - sin) / (1 + sin) of a friction angle of 30
  // degrees, 1/3, and 1. Without friction the bottom carries all. Limit 15 % of the
  // effective mass: beds poured alike differ by up to 10 %.
  TEST(Janssen, BottomForceSaturates)
  {
    const double mu    = 0.5;
    const Column low   = column(2000, mu);
    const Column high  = column(4000, mu);
    double       close = 0., lambda = 0.;
    for (double l = 1e-3; l < 0.2; l += 1e-5)
      if (std::abs(janssen(high.height, l) - high.effective / high.mass) <
            std::abs(close - high.effective / high.mass) ||
          lambda == 0.)
        {
          close  = janssen(high.height, l);
          lambda = l;
        }
    const double K = 0.025 / (4. * mu * lambda);
    title("effective mass [g]: " + std::to_string(1e3 * low.effective) + " of " +
          std::to_string(1e3 * low.mass) + ", H/D " + std::to_string(low.height / 0.025) +
          "; " + std::to_string(1e3 * high.effective) + " of " +
          std::to_string(1e3 * high.mass) + ", H/D " +
          std::to_string(high.height / 0.025));
    expect_near("growth of the effective mass over mass added",
                (high.effective - low.effective) / (high.mass - low.mass),
                0.,
                0.1);
    expect_near("K of the high column", K, 2. / 3., 1. / 3.);
    expect_near("low column by Janssen, over its mass",
                low.effective / low.mass,
                janssen(low.height, lambda),
                0.15 * low.effective / low.mass);
    const Column smooth = column(2000, 0.);
    expect_near("without friction", smooth.effective / smooth.mass, 1., 1e-3);
  }
} // namespace
