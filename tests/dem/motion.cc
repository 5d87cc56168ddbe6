// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/dem/particles/dem_error.h>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  DemParameters
  no_gravity(const std::string &model, const double restitution)
  {
    DemParameters p                        = SmallColumn::parameters();
    p.particles.gravity                    = 0.;
    p.contact.model                        = model;
    p.contact.particle_surface.restitution = restitution;
    p.contact.wall_surface.restitution     = restitution;
    return p;
  }

  // Two spheres that meet head-on across the middle of the column, along z,
  // where two ranks have their border.
  SmallColumn &
  launch(SmallColumn &column, const Vector &first, const Vector &second)
  {
    column.dem.insert({Point<3>(1e-4, 2e-4, 0.0138), Point<3>(1e-4, 2e-4, 0.0162)});
    column.set_velocity(0, first);
    column.set_velocity(1, second);
    return column;
  }

  // Law: e times the approach speed returns, momentum stays. The limit on e is
  // the time error of the dampers, which set in with a jump (linear) or steeply
  // (Hertz), relative to the approach speed: 2.5 % at the default substep, with
  // 13 and 44 substeps in contact, 0.4 % with ten times as many. Momentum is
  // exact up to the quantum of the force.
  TEST(Motion, HeadOnCollision)
  {
    for (const std::string model : {"hertz-mindlin", "linear-spring"})
      for (const double e : {0.2, 0.4, 0.5, 0.7, 0.9, 1.})
        for (const double fraction : {0.2, 0.02})
          {
            DemParameters p         = no_gravity(model, e);
            p.contact.time_fraction = fraction;
            SmallColumn column(p);
            launch(column, Vector({0., 0., 0.3}), Vector({0., 0., -0.2}));
            column.dem.advance(4e-3);
            const Vector a = column.velocity(0), b = column.velocity(1);
            const double returned = (b - a)[2] / 0.5;
            if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
              std::cout << model << ", time fraction " << fraction << ": e = " << e
                        << ", returned " << returned << std::endl;
            EXPECT_NEAR(returned, e, fraction > 0.1 ? 2.5e-2 : 4e-3);
            EXPECT_NEAR((a + b)[2], 0.1, 1e-12);
            EXPECT_EQ((a + b)[0], 0.);
          }
  }

  // Law: in the substep in which a contact begins, its spring moves only for the
  // time in contact: tangential over normal speed times the overlap. Limit 0.1 %:
  // the turning of the contact plane within the substep.
  TEST(Motion, ContactBeginsWithinASubstep)
  {
    SmallColumn column(no_gravity("hertz-mindlin", 1.));
    launch(column, Vector({0.02, 0., 0.5}), Vector({0., 0., -0.5}));
    const double dt = column.dem.substep();
    column.dem.advance(std::floor(4e-4 / dt) * dt);
    for (unsigned int k = 0; k < 100 && column.dem.coordination_number() == 0.; ++k)
      column.dem.advance(dt);
    const Vector          between = column.position(1) - column.position(0);
    const Vector          n       = between / between.norm();
    const Vector          u({0.02, 0., 1.});
    const Contact<double> contact{
      triple(n), 2e-3 - between.norm(), 5e-4, 1., {}, {}, {}, 0.};
    const double S_t =
      HertzMindlin::stiffness(column.dem.parameters().materials(false, {}).between(0, 0),
                              contact)
        .tangential;
    const double expected =
      S_t * contact.overlap * in_plane(triple(u), triple(n)).norm() / (u * n);
    EXPECT_GT(contact.overlap, 0.);
    EXPECT_LE(contact.overlap, 0.99 * dt);
    EXPECT_NEAR(
      in_plane(triple(column.force(0)), triple(n)).norm(), expected, 1e-3 * expected);
  }

  // Without damping the kinetic energy after an impact is that before. Limit
  // 0.3 %: the error of the scheme with 11 substeps in contact (measured 0.14 %).
  TEST(Motion, ElasticImpactConservesEnergy)
  {
    SmallColumn column(no_gravity("hertz-mindlin", 1.));
    launch(column, Vector({0., 0., 0.5}), Vector({0., 0., -0.5}));
    const double before = column.dem.mean_kinetic_energy();
    column.dem.advance(3e-3);
    EXPECT_NEAR(column.dem.mean_kinetic_energy() / before, 1., 3e-3);
    EXPECT_LE(column.velocity(0)[2], -0.49);
  }

  // An oblique impact with friction keeps linear and angular momentum: to the
  // rounding of forces to quanta, far below any physics.
  TEST(Motion, ObliqueImpactConservesAngularMomentum)
  {
    SmallColumn column(no_gravity("hertz-mindlin", 0.7));
    column.dem.insert({Point<3>(-4e-4, 0., 0.0138), Point<3>(4e-4, 0., 0.0162)});
    column.set_velocity(0, Vector({0., 0., 0.4}));
    column.set_velocity(1, Vector({0., 0.1, -0.4}));
    const double mass    = column.dem.parameters().particles.simulated_mass();
    const double inertia = 0.4 * mass * 1e-6;

    const auto angular = [&]() {
      Vector L;
      for (const int id : {0, 1})
        L += mass * cross_product_3d(Vector(column.position(id)), column.velocity(id)) +
             inertia * column.spin(id);
      return L;
    };
    const Vector before = angular();
    column.dem.advance(3e-3);
    EXPECT_GT(column.spin(0).norm(), 1.);
    EXPECT_NEAR((angular() - before).norm() / before.norm(), 0., 1e-9);
    EXPECT_NEAR((column.velocity(0) + column.velocity(1) - Vector({0., 0.1, 0.})).norm(),
                0.,
                1e-12);
  }

  // A sphere that just touches the bottom is pressed on it by a constant force
  // and swings in Hertz's spring, with and without damping. Error of its place
  // and speed at a fixed time against a run with steps 32 times finer.
  double
  error_after(const double  restitution,
              const double  dt,
              const Vector *reference,
              Vector       &result)
  {
    DemParameters p   = no_gravity("hertz-mindlin", restitution);
    p.contact.substep = dt;
    SmallColumn column(p);
    column.dem.insert({Point<3>(0., 0., 1e-3)});
    if (column.row(0) >= 0)
      column.dem.particles().external_force[column.row(0)] = Vector({0., 0., -0.01});
    column.dem.advance(1.2e-3);
    const double speed_scale = 0.05;
    result =
      Vector({column.position(0)[2] / 1e-5, column.velocity(0)[2] / speed_scale, 0.});
    return reference ? (result - *reference).norm() : 0.;
  }

  // Law: velocity Verlet is of second order. Limit 1.9: the onset of the
  // contact (force ~ overlap^1.5) keeps the observed order from being exact.
  TEST(Motion, SecondOrderThroughHertzContact)
  {
    for (const double e : {1., 0.5})
      {
        Vector       reference, ignored;
        const double coarse = 1.2e-3 / 64.;
        error_after(e, coarse / 128., nullptr, reference);
        const double first  = error_after(e, coarse, &reference, ignored);
        const double second = error_after(e, coarse / 2., &reference, ignored);
        const double third  = error_after(e, coarse / 4., &reference, ignored);
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cout << "e = " << e << ": errors " << first << ' ' << second << ' '
                    << third << ", orders " << std::log2(first / second) << ' '
                    << std::log2(second / third) << std::endl;
        EXPECT_GE(std::log2(first / second), 1.8);
        EXPECT_GE(std::log2(second / third), 1.9);
      }
  }

  // Free fall is exact in velocity Verlet; then a sphere bounces to e^2 of its
  // height. Limit 2 %: time error of the impact at the default substep, and
  // gravity during contact.
  TEST(Motion, FreeFallAndBounce)
  {
    DemParameters p                    = SmallColumn::parameters();
    p.contact.wall_surface.restitution = 0.8;
    SmallColumn column(p);
    column.dem.insert({Point<3>(0., 0., 0.021)});
    column.dem.advance(0.03);
    EXPECT_NEAR(column.position(0)[2], 0.021 - 0.5 * 9.81 * 9e-4, 1e-12);

    const double fall = std::sqrt(2. * 0.02 / 9.81);
    column.dem.advance(fall + 0.8 * fall - 0.03);
    EXPECT_NEAR(column.position(0)[2] - 1e-3, 0.64 * 0.02, 0.02 * 0.0128);
    EXPECT_NEAR(column.velocity(0)[0], 0., 1e-15);
  }

  // A sphere at rest presses its weight on the bottom; pressed sideways it
  // presses that force on the tube. Limit 0.1 %: what is left of the motion.
  TEST(Motion, LoadsOnWalls)
  {
    SmallColumn column(SmallColumn::parameters());
    column.dem.insert({Point<3>(0.00395, 0., 0.00102)});
    const double weight = column.dem.weight();
    if (column.row(0) >= 0)
      column.dem.particles().external_force[column.row(0)] =
        Vector({3. * weight, 0., 0.});
    column.dem.advance(0.2);
    column.dem.advance(0.01);
    EXPECT_NEAR(
      column.dem.bottom_force() + column.dem.wall_force(), weight, 1e-3 * weight);
    EXPECT_NEAR(column.dem.force_on(lateral_wall)[0] +
                  column.dem.force_on(bottom_wall)[0],
                3. * weight,
                3e-3 * weight);
    EXPECT_EQ(column.dem.force_on(top_wall)[2], 0.);
  }

  // Law: on a plane that tilts to tan(angle), a sphere that cannot roll freely
  // (EPSD2 or constant torque) stays while tan < mu_r and rolls beyond. Gravity
  // is replaced by a tilted force; constant torque creeps, so the limit is on
  // the speed, against that of free rolling.
  TEST(Motion, RollingResistanceHoldsOnASlope)
  {
    for (const std::string model : {"spring-dashpot", "constant-torque"})
      for (const double slope : {0.05, 0.2})
        {
          DemParameters p                           = no_gravity("hertz-mindlin", 0.3);
          p.contact.rolling_model                   = model;
          p.contact.wall_surface.rolling_resistance = 0.1;
          SmallColumn column(p);
          column.dem.insert({Point<3>(-0.002, 0., 1e-3)});
          const double weight = p.particles.simulated_mass() * 9.81;
          if (column.row(0) >= 0)
            column.dem.particles().external_force[column.row(0)] =
              Vector({slope * weight, 0., -weight});
          column.dem.advance(0.04);
          const double rolling = 5. / 7. * slope * 9.81 * 0.04;
          const double beyond  = 5. / 7. * (slope - 0.1) * 9.81 * 0.04;
          if (slope < 0.1)
            EXPECT_LE(std::abs(column.velocity(0)[0]), 0.2 * rolling) << model;
          else
            EXPECT_NEAR(column.velocity(0)[0], beyond, 0.1 * beyond) << model;
        }
  }

  // Beyond 30 % of the radius the contact law has no meaning: all ranks stop
  // and the message names particle and place.
  TEST(Motion, TooMuchOverlapStops)
  {
    SmallColumn column(no_gravity("hertz-mindlin", 0.5));
    launch(column, Vector({0., 0., 40.}), Vector({0., 0., -40.}));
    try
      {
        column.dem.advance(1e-3);
        FAIL() << "no exception";
      }
    catch (const DemError &error)
      {
        EXPECT_NE(std::string(error.what()).find("overlaps"), std::string::npos)
          << error.what();
        EXPECT_NE(std::string(error.what()).find("Try"), std::string::npos);
      }
  }

  // Law: I ds/dt = T. A constant torque is integrated exactly, up to rounding, and does
  // not move the center.
  TEST(Motion, TorqueFromOutsideSpinsAFreeSphere)
  {
    SmallColumn column(no_gravity("hertz-mindlin", 0.5));
    column.dem.insert({Point<3>(0., 0., 0.015)});
    const double inertia =
      0.4 * column.dem.parameters().particles.simulated_mass() * 1e-6;
    const Vector torque({1e-9, -2e-9, 3e-9});
    if (column.row(0) >= 0)
      column.dem.particles().external_torque[column.row(0)] = torque;
    column.dem.advance(0.01);
    column.dem.advance(0.02);
    if (const int row = column.row(0); row >= 0)
      {
        const Body  &body     = column.dem.particles().body[row];
        const Vector expected = 0.03 / inertia * torque;
        EXPECT_LE((body.spin - expected).norm(), 1e-10 * expected.norm()) << body.spin;
        EXPECT_EQ(body.velocity.norm(), 0.);
      }
  }

  TEST(Motion, ForceThatIsNotANumberStops)
  {
    SmallColumn column(no_gravity("hertz-mindlin", 0.5));
    launch(column, Vector(), Vector());
    if (column.row(0) >= 0)
      column.dem.particles().external_force[column.row(0)][1] = std::nan("");
    EXPECT_THROW(column.dem.advance(1e-3), DemError);
  }

  TEST(Motion, InsertionOutsideTheVesselIsRefused)
  {
    SmallColumn column(SmallColumn::parameters());
    try
      {
        column.dem.insert({Point<3>(0.006, 0., 0.01)});
        FAIL() << "no exception";
      }
    catch (const DemError &error)
      {
        EXPECT_NE(std::string(error.what()).find("no cell of the mesh holds"),
                  std::string::npos);
      }
  }
} // namespace
