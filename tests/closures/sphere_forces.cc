// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/closures/sphere_forces.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace graupel;

namespace
{
  using Vector        = dealii::Tensor<1, 3>;
  constexpr double pi = dealii::numbers::PI;

  // A handful of operations in double precision.
  constexpr double round_off = 1e-13;

  FluidProperties
  of_water()
  {
    FluidProperties result;
    result.density   = 998.;
    result.viscosity = 1e-3;
    return result;
  }
  const FluidProperties water = of_water();
  constexpr double      d     = 1e-3;

  double
  volume(const double diameter)
  {
    return pi / 6. * diameter * diameter * diameter;
  }

  SphereForces
  with(const std::string &shear_lift,
       const std::string &spin_lift       = "none",
       const std::string &rotational_drag = "none")
  {
    ForceParameters parameters;
    parameters.shear_lift      = shear_lift;
    parameters.spin_lift       = spin_lift;
    parameters.rotational_drag = rotational_drag;
    return SphereForces(parameters, water);
  }

  void
  expect_equal(const Vector &computed, const Vector &expected, const std::string &what)
  {
    std::cout << what << ": " << computed << ", expected " << expected << std::endl;
    EXPECT_GT(expected.norm(), 0.) << what;
    EXPECT_LE((computed - expected).norm(), round_off * expected.norm()) << what;
  }

  // Twice the kinetic energy of the potential flow between a sphere of radius a that
  // moves with U and a concentric one of radius b at rest, over U^2 and the mass of fluid
  // of the sphere's volume. Phi = (A r + B / r^2) cos theta has the normal velocities
  // U cos theta and 0 there; the angles are integrated by hand, the radius by Simpson.
  double
  mass_by_energy(const double a, const double b)
  {
    const double A = -a * a * a / (b * b * b - a * a * a), B = 0.5 * A * b * b * b;
    const auto   density = [&](const double r) {
      const double radial = A - 2. * B / (r * r * r), other = A + B / (r * r * r);
      return r * r * 4. / 3. * pi * (radial * radial + 2. * other * other);
    };
    const unsigned int n   = 2000;
    const double       h   = (b - a) / n;
    double             sum = density(a) + density(b);
    for (unsigned int k = 1; k < n; ++k)
      sum += (k % 2 ? 4. : 2.) * density(a + k * h);
    return h / 3. * sum / (4. / 3. * pi * a * a * a);
  }
} // namespace

TEST(SphereForces, VirtualMassIsTheKineticEnergyOfPotentialFlow)
{
  // 1e-8: Simpson's rule.
  for (const double phi : {0.01, 0.1, 0.3, 0.6})
    {
      const double expected = mass_by_energy(1., std::cbrt(1. / phi));
      const double computed = zuber_virtual_mass(1. - phi);
      std::cout << "phi " << phi << ": " << computed << " of " << expected << std::endl;
      EXPECT_NEAR(computed, expected, 1e-8 * expected);
    }
  EXPECT_NEAR(zuber_virtual_mass(1.), constant_virtual_mass(0.5), round_off);
  ForceParameters parameters;
  parameters.virtual_mass = "constant";
  EXPECT_NEAR(SphereForces(parameters, water).virtual_mass(0.4, volume(d)),
              0.5 * 998. * volume(d),
              round_off * 998. * volume(d));
}

TEST(SphereForces, SaffmansLiftPushesALateSphereIntoTheFasterFluid)
{
  // u_x = G y and a sphere that is slower by U: 6.46 mu a^2 U (G / nu)^1/2 along y.
  const double G = 30., U = 1e-4, a = 0.5 * d;
  const Vector slip({U, 0., 0.}), vorticity({0., 0., -G});
  const double nu       = water.viscosity / water.density;
  const double expected = 6.46 * water.viscosity * a * a * U * std::sqrt(G / nu);
  expect_equal(
    with("saffman").lift(d, 1., slip, vorticity, {}), Vector({0., expected, 0.}), "late");
  expect_equal(with("saffman").lift(d, 1., -slip, vorticity, {}),
               Vector({0., -expected, 0.}),
               "early");
  // The number from the integral J = 2.255 of the disturbance, in three digits.
  EXPECT_NEAR(4. * saffman_lift(0., 1.), 9. / pi * 2.255, 1e-3);
}

TEST(SphereForces, MeisFactorIsSaffmansInSlowFlowAndHisFitsBeyond)
{
  EXPECT_NEAR(saffman_mei_lift(0., 0.), 1.615, round_off);
  // b = Re_w / (2 Re) grows without bound as Re falls, and its part is b^1/2 Re / 10.
  EXPECT_NEAR(saffman_mei_lift(1e-10, 1e-3), 1.615, 1e-4);
  for (const double reynolds : {0.3, 5., 39., 40., 41., 90.})
    for (const double b : {0.005, 0.1, 0.4})
      {
        const double slow = (1. - 0.3314 * std::sqrt(b)) * std::exp(-reynolds / 10.) +
                            0.3314 * std::sqrt(b);
        const double fast     = 0.0524 * std::sqrt(b * reynolds);
        const double expected = 1.615 * (reynolds > 40. ? fast : slow);
        EXPECT_NEAR(
          saffman_mei_lift(reynolds, 2. * b * reynolds), expected, 1e-12 * expected)
          << reynolds << " " << b;
        // Both fits agree at 40 but for exp(-4).
        const bool at_the_change = reynolds > 38. && reynolds < 42.;
        EXPECT_NEAR(slow, fast, at_the_change ? 0.025 : 1.);
      }
}

TEST(SphereForces, MagnusLiftsABallWithBackspin)
{
  // A ball that flies along x with V and whose top goes backwards: pi rho a^3 s V up.
  const double V = 5e-4, s = 3., a = 0.5 * d;
  const Vector slip({-V, 0., 0.}), spin({0., 0., s});
  expect_equal(with("none", "rubinow-keller").lift(d, 1., slip, {}, -spin),
               Vector({0., pi * water.density * a * a * a * s * V, 0.}),
               "backspin");
  EXPECT_NEAR(lun_liu_lift(1.), lun_liu_lift(1. + 1e-12), 1e-9);
  EXPECT_NEAR(
    lun_liu_lift(100.), 0.178 + 0.822 * std::exp(-0.522 * std::log(100.)), 1e-12);
}

TEST(SphereForces, RotationalDragIsStokesAndDennis)
{
  // Steps that are short beside the time of the decay: the torque itself.
  const double a = 0.5 * d, inertia = 0.4 * 2500. * volume(d) * a * a, step = 1e-9;
  for (const auto &[name, s] : {std::pair("rubinow-keller", 3.),
                                {"dennis", 3.},
                                {"dennis", 50.},
                                {"dennis", 400.}})
    {
      const Vector spin({0., -0.6 * s, 0.8 * s});
      const double re = water.density * d * d * s / water.viscosity;
      const double c  = re < 32. ? 64. * pi / re : 12.9 / std::sqrt(re) + 128.4 / re;
      const Vector expected = -c * 0.5 * water.density * std::pow(a, 5) * s * spin;
      const Vector computed = with("none", "none", name).torque(d, inertia, step, -spin);
      std::cout << name << " Re " << re << ": " << computed << std::endl;
      // Half a step over the time of 0.02 s.
      EXPECT_LE((computed - expected).norm(), 1e-6 * expected.norm());
    }
  const double slow =
    with("none", "none", "dennis").torque(d, inertia, step, Vector({3., 0., 0.}))[0];
  EXPECT_NEAR(slow, 8. * pi * water.viscosity * a * a * a * 3., 1e-6 * slow);
  // Both fits meet.
  EXPECT_NEAR(dennis_torque(32. + 1e-9), 1., 2e-3);
}

TEST(SphereForces, SpinDecaysExponentiallyWhateverTheStep)
{
  // tau = rho_p d^2 / (60 mu).
  const double a = 0.5 * d, density = 2500., tau = density * d * d / (60. * 1e-3);
  const double inertia = 0.4 * density * volume(d) * a * a;
  const auto   forces  = with("none", "none", "rubinow-keller");
  const Vector begin({1., -2., 0.5});
  Vector       spin = begin;
  double       time = 0.;
  for (const double step : {1e-3, 0.02, 0.3, 5e-3, 1e-6})
    {
      spin += step / inertia * forces.torque(d, inertia, step, -spin);
      time += step;
      expect_equal(spin, std::exp(-time / tau) * begin, "spin");
    }
}

TEST(SphereForces, NothingMovesASphereThatMovesAndSpinsWithTheFluid)
{
  const auto   forces = with("saffman-mei", "lun-liu", "dennis");
  const Vector vorticity({1., 2., 3.}), slip({1e-3, 0., 0.});
  EXPECT_EQ(forces.lift(d, 1., {}, vorticity, {}).norm(), 0.);
  EXPECT_EQ(forces.lift(d, 1., slip, {}, {}).norm(), 0.);
  EXPECT_EQ(forces.torque(d, 1e-12, 1e-3, {}).norm(), 0.);
}

TEST(SphereForces, AScaledSphereFeelsWhatItStandsFor)
{
  const auto   forces = with("saffman-mei");
  const Vector slip({0.02, 0.01, 0.}), vorticity({0., 7., -30.});
  expect_equal(forces.lift(3. * d, 3., slip, vorticity, {}),
               27. * forces.lift(d, 1., slip, vorticity, {}),
               "27 spheres");
}

TEST(SphereForces, WhatALawDoesNotKnowIsRefused)
{
  const auto refused =
    [](const ForceParameters &parameters, const double scale, const std::string &model) {
      try
        {
          parameters.check(scale, model);
        }
      catch (const InputError &error)
        {
          return error.parameter;
        }
      return std::string();
    };
  ForceParameters spin, torque, stress;
  spin.spin_lift         = "lun-liu";
  torque.rotational_drag = "dennis";
  stress.viscous_stress  = true;
  EXPECT_EQ(refused(spin, 2., "A"), "Forces/spin lift");
  EXPECT_EQ(refused(torque, 2., "A"), "Forces/rotational drag");
  EXPECT_EQ(refused(stress, 1., "B"), "Forces/viscous stress");
  for (const ForceParameters &parameters : {spin, torque, stress})
    {
      EXPECT_EQ(refused(parameters, 1., "A"), "");
      EXPECT_TRUE(parameters.any());
    }
  EXPECT_FALSE(ForceParameters().any());
}
