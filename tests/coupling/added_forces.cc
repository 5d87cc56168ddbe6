// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "tube.h"

using namespace graupel;

namespace
{
  using Vector = dealii::Tensor<1, 3>;
  using Point  = dealii::Point<3>;

  // The force of the steady flow on spheres that do not move, without buoyancy.
  Vector
  steady_force(Tube &tube)
  {
    for (unsigned int n = 0; n < 8; ++n)
      tube.step_fluid(FlowSolver::steady);
    return tube.exchange.total_force();
  }

  void
  set_spin(Tube &tube, const Vector &spin)
  {
    for (unsigned int row = 0; row < tube.dem.particles().n_owned; ++row)
      tube.dem.particles().body[row].spin = spin;
  }

  // Upward velocity of one sphere in still liquid, by Runge and Kutta:
  // (m + M) dv/dt = (m_f - m) g - beta(v) v.
  struct Rise
  {
    explicit Rise(const Tube::Settings &sphere, const double virtual_mass)
      : drag(sphere.drag())
      , radius(0.5 * sphere.particle)
      , mass(sphere.mass() + virtual_mass * sphere.fluid.density * sphere.volume())
      , lift((sphere.fluid.density - sphere.density) * sphere.volume() * 9.81)
      , slip(sphere.terminal_velocity())
    {
    }

    double
    acceleration(const double v) const
    {
      return (lift - drag.beta(1., std::abs(v), radius) * v) / mass;
    }

    void
    advance(const double dt)
    {
      for (unsigned int n = 0; n < 20; ++n)
        {
          const double h = dt / 20., a = acceleration(v),
                       b = acceleration(v + h / 2. * a), c = acceleration(v + h / 2. * b),
                       e = acceleration(v + h * c);
          v += h / 6. * (a + 2. * b + 2. * c + e);
        }
    }

    double
    terminal_velocity() const
    {
      return std::copysign(slip, lift);
    }

    const DragOfType drag;
    const double     radius, mass, lift, slip;
    double           v = 0.;
  };

  Tube::Settings
  with_virtual_mass(const double density)
  {
    Tube::Settings settings;
    settings.density             = density;
    settings.forces.virtual_mass = "constant";
    return settings;
  }

  Point
  start(const Tube::Settings &settings)
  {
    return {1e-3, 0.5e-3, settings.density < 998. ? 0.01 : 0.035};
  }

  // Water of high viscosity in a tube without slip: Poiseuille's flow.
  Tube::Settings
  of_poiseuille()
  {
    Tube::Settings settings;
    settings.diameter          = 0.012;
    settings.height            = 0.009;
    settings.cell              = 1e-3;
    settings.particle          = 0.5e-3;
    settings.fluid.viscosity   = 0.1;
    settings.filter_length     = 0.5e-3;
    settings.velocity          = 0.01;
    settings.law               = "none";
    settings.gravity           = Vector();
    settings.boundaries.bottom = "parabolic";
    settings.boundaries.wall   = "no-slip";
    // The pressure pushes the whole tube ten thousand times as much as the sphere, and
    // leaves the rounding errors of that.
    settings.imbalance = 1e-9;
    return settings;
  }
  const Point  off_axis(3e-3, 0., 0.0045);
  const double radius_square = 36e-6;

  // What the filter and the sampling leave of Poiseuille's velocity at off_axis, and its
  // vorticity: a Gaussian of variance 2 l^2 takes that times the curvature of a parabola.
  Vector
  poiseuille_velocity(const Tube::Settings &s)
  {
    const double l = *s.filter_length, r2 = off_axis[0] * off_axis[0] + 4. * l * l;
    return Vector({0., 0., 2. * s.velocity * (1. - r2 / radius_square)});
  }

  Vector
  poiseuille_vorticity(const Tube::Settings &s)
  {
    return Vector({0., 4. * s.velocity * off_axis[0] / radius_square, 0.});
  }
} // namespace

TEST(VirtualMass, OneSphereInStillLiquidFollowsTheExactEquation)
{
  // 3 % of the terminal velocity: half a step of the implicit Euler method is 2 %, the
  // sphere's own disturbance 2 %. The error without virtual mass would be 60 % of the
  // begin for the lightest one.
  for (const double ratio : {0.1, 0.5, 1.05})
    {
      Tube         tube(with_virtual_mass(998. * ratio),
                {start(with_virtual_mass(998. * ratio))});
      Rise         exact(tube.settings, 0.5);
      const double terminal = exact.terminal_velocity();
      const double dt    = 0.05 * std::abs(terminal) / std::abs(exact.acceleration(0.));
      double       worst = 0.;
      for (unsigned int n = 0; n < 60; ++n)
        {
          tube.step(dt);
          exact.advance(dt);
          const double error = (tube.rise_velocity() - exact.v) / terminal;
          worst              = std::max(worst, std::abs(error));
        }
      say() << "rho_p/rho " << ratio << ", step " << dt << " s: " << tube.rise_velocity()
            << " m/s of " << exact.v << ", terminal " << terminal << ", worst error "
            << worst << std::endl;
      EXPECT_LT(worst, 0.03);
    }
}

TEST(VirtualMass, ReleasedSpheresAccelerateWithTheMassOfBoth)
{
  // Steps so short that nothing else has grown: (m_f - m) g / (m + M). 3 %: the filtered
  // sphere also pushes fluid aside, at a volume fraction of 0.03.
  for (const double ratio : {0.1, 0.5, 1.05})
    {
      Tube       tube(with_virtual_mass(998. * ratio),
                {start(with_virtual_mass(998. * ratio))});
      const Rise exact(tube.settings, 0.5);
      tube.step(1e-5);
      const double a = tube.rise_velocity() / 1e-5;
      say() << "rho_p/rho " << ratio << ": " << a << " m/s^2 of "
            << exact.acceleration(0.) << std::endl;
      EXPECT_NEAR(a, exact.acceleration(0.), 0.03 * std::abs(exact.acceleration(0.)));
    }
}

TEST(VirtualMass, LightSpheresAreStableWithAnyStep)
{
  // Up to five times (m + M)/F'. 3 %: the sphere's own blob. Beyond the limit the first
  // step, which knows the drag of a sphere at rest only, goes too far.
  for (const double dt : {1e-3, 1e-2, 4e-2})
    {
      auto settings   = with_virtual_mass(99.8);
      settings.height = 0.1;
      Tube         tube(settings, {start(settings)});
      const double terminal = Rise(tube.settings, 0.5).terminal_velocity();
      double       place = 0., fastest = 0.;
      while (place < (dt < 5e-3 ? 0.015 : 0.06))
        {
          tube.step(dt);
          const double v = tube.rise_velocity();
          fastest        = std::max(fastest, std::abs(v));
          place += dt * v;
          ASSERT_TRUE(v > 0.) << v;
        }
      const double v = tube.rise_velocity();
      say() << "step " << dt << " s: " << v << " m/s of " << terminal << ", limit "
            << tube.exchange.stable_step(tube.dem.particles()) << " s" << std::endl;
      EXPECT_NEAR(v, terminal, 0.03 * terminal);
      if (dt < tube.exchange.stable_step(tube.dem.particles()))
        {
          EXPECT_LT(fastest, 1.03 * terminal);
        }
    }
}

TEST(VirtualMass, ACloudOfLightSpheresMovesSmoothly)
{
  // Spheres of a tenth of the liquid's density, half of a section: never faster than one
  // alone, nor back.
  for (const std::string law : {"constant", "zuber"})
    for (const double dt : {1e-3, 2e-2})
      {
        auto settings                = with_virtual_mass(99.8);
        settings.forces.virtual_mass = law;
        std::vector<Point> positions;
        for (int k = 0; k < 5; ++k)
          for (int i = -4; i <= 4; ++i)
            for (int j = -4; j <= 4; ++j)
              if (std::hypot(i, j) < 4.3)
                positions.emplace_back(i * 2.05e-3, j * 2.05e-3, 0.01 + k * 2.05e-3);
        Tube         tube(settings, positions);
        const double terminal = Rise(tube.settings, 0.5).terminal_velocity();
        double       last = 0., back = 0.;
        for (unsigned int n = 0; n < 8; ++n)
          {
            tube.step(dt);
            const double v = tube.rise_velocity();
            say() << v << " ";
            back = std::max(back, last - v);
            last = v;
            EXPECT_LT(v, terminal);
          }
        say() << "m/s, alone " << terminal << " (" << law << ")" << std::endl;
        EXPECT_GT(last, 0.);
        EXPECT_LT(back, 0.1 * terminal);
      }
}

TEST(VirtualMass, SpheresInAFluidThatAcceleratesFollowIt)
{
  // From rest to V in a time in which drag does nothing: (m + M) v = (m_f + M) V, 3 V for
  // a weightless sphere, V for a neutral one. 0.3 % for the neutral one, which moves as
  // one with the fluid: the fluid's momentum is an integral over the cells, and its share
  // of the pressure one of the nodes. Else the sphere's disturbance is 3 %.
  for (const double ratio : {0.1, 1., 2.5})
    {
      auto settings     = with_virtual_mass(998. * ratio);
      settings.velocity = 0.01;
      settings.gravity  = Vector();
      Tube         tube(settings, {Point(1e-3, 0.5e-3, 0.025)});
      const double expected = 1.5 / (ratio + 0.5) * settings.velocity;
      tube.step(1e-5);
      const double v = tube.rise_velocity();
      say() << "rho_p/rho " << ratio << ": " << v << " m/s of " << expected << std::endl;
      EXPECT_NEAR(v, expected, (ratio == 1. ? 3e-3 : 0.03) * expected);
      if (ratio == 1.)
        for (const double faster : {0.02, 0.01, 0.05})
          {
            tube.flow.set_superficial_velocity(faster);
            tube.step(1e-3);
            EXPECT_NEAR(tube.rise_velocity(), faster, 3e-3 * faster);
          }
    }
}

TEST(BuoyantSpheres, MoveAlongGravityOrNot)
{
  // Gravity that is inclined to all axes. A neutral sphere stays; a light one rises along
  // it from the middle of the tube. 2 degrees: the walls.
  const Vector gravity({3., -4., -8.});
  for (const double density : {998., 300., 2000.})
    {
      auto settings    = with_virtual_mass(density);
      settings.gravity = gravity;
      Tube tube(settings, {Point(0., 0., 0.025)});
      for (unsigned int n = 0; n < 4; ++n)
        tube.step(1e-3);
      const Vector v = tube.mean(&Body::velocity);
      say() << "density " << density << ": " << v << std::endl;
      if (density == 998.)
        EXPECT_LE(v.norm(), 1e-9);
      else
        EXPECT_GT(v * gravity * (density - 998.),
                  std::cos(2. / 180. * dealii::numbers::PI) * v.norm() * gravity.norm() *
                    std::abs(density - 998.));
    }
}

TEST(ViscousStress, BalancesThePressureOnASphereInPoiseuillesFlow)
{
  // Nothing else acts on a sphere without drag. 4 %: the mesh of 12 cells, of which the
  // pressure gradient misses as much.
  Tube::Settings settings = of_poiseuille();
  const double   gradient = 32. * settings.fluid.viscosity * settings.velocity / 144e-6;
  const double   expected = gradient * settings.volume();
  Tube           without(settings, {off_axis});
  const double   pressure        = steady_force(without)[2];
  settings.forces.viscous_stress = true;
  for (const Point &place : {off_axis, Point(4.5e-3, 1e-3, 0.0045), Point(0., 0., 3e-3)})
    {
      Tube         with(settings, {place});
      const Vector sum = steady_force(with);
      say() << "pressure " << pressure << " N of " << expected << " N, with friction "
            << sum << " N at " << place << std::endl;
      EXPECT_LE(sum.norm(), 0.04 * expected);
    }
  EXPECT_NEAR(pressure, expected, 0.06 * expected);
}

TEST(ViscousStress, LeavesTheForceOnTheTubeAsItIs)
{
  // The solids' share goes through them; with particles that do not drag, the wall bears
  // the drop either way. 1 %: the profile at a void fraction of 0.99.
  Tube::Settings settings = of_poiseuille();
  double         force[2];
  for (const bool shared : {false, true})
    {
      settings.forces.viscous_stress = shared;
      Tube tube(settings, {off_axis});
      steady_force(tube);
      force[shared] = tube.flow.force_on(VesselMesh::wall)[2];
    }
  say() << "force on the wall " << force[0] << " and " << force[1] << " N" << std::endl;
  EXPECT_NEAR(force[0], force[1], 0.01 * std::abs(force[0]));
}

TEST(Lift, OfShearPushesALateSphereTowardsTheAxis)
{
  // 5 %: the mesh of 12 cells.
  for (const std::string law : {"saffman", "saffman-mei"})
    {
      Tube::Settings settings    = of_poiseuille();
      settings.forces.shear_lift = law;
      Tube         tube(settings, {off_axis});
      const Vector force    = steady_force(tube);
      const Vector expected = SphereForces(settings.forces, tube.settings.fluid)
                                .lift(settings.particle,
                                      1.,
                                      poiseuille_velocity(settings),
                                      poiseuille_vorticity(settings),
                                      {});
      say() << law << ": " << force << " N, lift of " << expected << " N" << std::endl;
      EXPECT_LT(force[0], 0.);
      EXPECT_NEAR(force[0], expected[0], 0.05 * expected.norm());
      EXPECT_NEAR(force[1], 0., 0.01 * expected.norm());
    }
}

TEST(Lift, OfSpinIsMagnus)
{
  // Plug flow along z past a sphere at rest that spins about x: pi/8 rho d^3 K s V along
  // y. 2 %: the sphere's blob.
  Tube::Settings settings   = of_poiseuille();
  settings.fluid.viscosity  = 1e-3;
  settings.boundaries       = {};
  settings.forces.spin_lift = "lun-liu";
  Tube tube(settings, {off_axis});
  set_spin(tube, Vector({50., 0., 0.}));
  const Vector force = steady_force(tube);
  const double d     = settings.particle;
  const double expected =
    dealii::numbers::PI / 8. * tube.settings.fluid.density * d * d * d *
    lun_liu_lift(tube.settings.fluid.density * 0.01 * d / 1e-3) * 50. * 0.01;
  say() << force << " N, expected " << expected << " N along y" << std::endl;
  EXPECT_NEAR(force[1], expected, 0.02 * expected);
  EXPECT_NEAR(force[0], 0., 1e-3 * expected);
}

TEST(RotationalDrag, SpinDecaysExponentiallyInStillLiquid)
{
  // exp(-t / tau), tau = rho_p d^2 / (60 mu), to round-off through steps of a tenth of
  // tau and of twice tau; the integrator adds up some hundred substeps.
  Tube::Settings settings         = of_poiseuille();
  settings.density                = 2500.;
  settings.boundaries             = {};
  settings.velocity               = 0.;
  settings.forces.rotational_drag = "rubinow-keller";
  const double tau = settings.density * 0.25e-6 / (60. * settings.fluid.viscosity);
  Tube         tube(settings, {off_axis});
  const Vector begin({1., -2., 0.5});
  set_spin(tube, begin);
  double time = 0.;
  for (const double step : {0.1 * tau, 0.1 * tau, 2. * tau, 0.3 * tau})
    {
      tube.step(step);
      time += step;
      const Vector spin     = tube.mean(&Body::spin),
                   expected = std::exp(-time / tau) * begin;
      say() << "after " << time / tau << " tau: " << spin << " of " << expected
            << std::endl;
      EXPECT_LE((spin - expected).norm(), 1e-10 * expected.norm());
    }
}

TEST(RotationalDrag, SpheresTakeUpTheSpinOfTheFluid)
{
  // Half the vorticity, where the drag leaves them long enough. 5 %: the mesh.
  Tube::Settings settings         = of_poiseuille();
  settings.forces.rotational_drag = "dennis";
  Tube tube(settings, {off_axis});
  steady_force(tube);
  const double step    = 1.;
  const double inertia = 0.1 * settings.mass() * settings.particle * settings.particle;
  Vector       spin;
  for (const Vector &torque : tube.exchange.torques(tube.dem.particles(), step))
    spin += step / inertia * torque;
  spin                  = dealii::Utilities::MPI::sum(spin, MPI_COMM_WORLD);
  const Vector expected = 0.5 * poiseuille_vorticity(settings);
  say() << spin << " rad/s of " << expected << std::endl;
  EXPECT_LE((spin - expected).norm(), 0.05 * expected.norm());
}
