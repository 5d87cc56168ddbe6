// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/base/parameters.h>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  DemParameters
  read_gravity(const std::string &text)
  {
    DemParameters            p = SmallColumn::parameters();
    dealii::ParameterHandler prm;
    p.declare(prm);
    ParameterFile(prm).set("Particles/gravity=" + text);
    p.check(SmallColumn::vessel());
    return p;
  }

  TEST(Gravity, OneNumberOrThree)
  {
    EXPECT_EQ(read_gravity("9.81").gravity(), Vector({0., 0., -9.81}));
    EXPECT_EQ(read_gravity("0").gravity(), Vector());
    const DemParameters p = read_gravity("3, -4, 0");
    EXPECT_NEAR((p.gravity() - Vector({3., -4., 0.})).norm(), 0., 1e-15);
    EXPECT_NEAR(p.particles.gravity, 5., 1e-15);
    EXPECT_FALSE(p.particles.gravity_is_axial());
    EXPECT_TRUE(read_gravity("0, 0, -2").particles.gravity_is_axial());
    EXPECT_EQ(read_gravity("0, 0, 0").particles.gravity, 0.);
    for (const std::string text : {"-9.81", "1, 2", "down"})
      EXPECT_THROW(read_gravity(text), InputError) << text;
  }

  // Exact for velocity Verlet up to rounding.
  TEST(Gravity, FreeFallAlongIt)
  {
    SmallColumn column(read_gravity("1, 2, -3"));
    column.dem.insert({Point<3>(-2e-3, -1e-3, 0.02)});
    column.dem.advance(0.03);
    const double half = 0.5 * 9e-4;
    EXPECT_NEAR(column.position(0)[0], -2e-3 + half, 1e-12);
    EXPECT_NEAR(column.position(0)[1], -1e-3 + 2. * half, 1e-12);
    EXPECT_NEAR(column.position(0)[2], 0.02 - 3. * half, 1e-12);
    EXPECT_NEAR(column.dem.weight(),
                std::sqrt(14.) * column.dem.parameters().particles.simulated_mass(),
                1e-12 * column.dem.weight());
  }

  // A body that cannot roll slides down an incline only if its angle's tangent is above
  // the friction: then by g (sin - mu cos).
  TEST(Gravity, BlockOnAnInclineSlidesAboveTheAngleOfFriction)
  {
    const double mu = 0.3;
    for (const double slope : {0.25, 0.35})
      {
        const double  angle             = std::atan(slope);
        DemParameters p                 = SmallColumn::parameters();
        p.particles.gravity_direction   = Vector({std::sin(angle), 0., -std::cos(angle)});
        p.contact.rolling_model         = "constant-torque";
        p.contact.wall_surface.friction = mu;
        p.contact.wall_surface.rolling_resistance = 1.;
        SmallColumn  column(p);
        const double weight  = 9.81 * p.particles.simulated_mass();
        const double overlap = hertz_overlap(
          weight * std::cos(angle),
          p.materials(false, column.dem.vessel()).with_wall(bottom_wall, 0).young,
          1e-3);
        column.dem.insert({Point<3>(-3e-3, 0., 1e-3 - overlap)});
        column.dem.advance(0.05);
        const double before = column.velocity(0)[0];
        column.dem.advance(0.05);
        const double gained = column.velocity(0)[0] - before;
        const double pull   = 9.81 * (std::sin(angle) - mu * std::cos(angle));
        if (slope < mu)
          EXPECT_NEAR(column.position(0)[0], -3e-3, 5e-5);
        else
          EXPECT_NEAR(gained, 0.05 * pull, 0.01 * 0.05 * pull);
        // N and F_t along gravity, with N = m g cos.
        const double held = std::min(std::tan(angle), mu);
        const double carried =
          std::cos(angle) * (std::cos(angle) + held * std::sin(angle));
        EXPECT_NEAR(column.dem.bottom_force() / weight, carried, 5e-3);
      }
  }
} // namespace
