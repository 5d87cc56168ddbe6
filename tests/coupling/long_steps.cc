// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "tube.h"

// Steps of the fluid ten and twenty times as long as an explicit drag would bear.

using namespace graupel;

namespace
{
  // Glass in a tube of twenty diameters with a fluid that rises through it.
  Tube::Settings
  glass(const FluidProperties &fluid,
        const std::string     &law,
        const double           diameter,
        const double           height,
        const double           velocity)
  {
    Tube::Settings settings;
    settings.diameter = 20. * diameter;
    settings.height   = height;
    settings.cell     = 2.5 * diameter;
    settings.particle = diameter;
    settings.density  = 2500.;
    settings.fluid    = fluid;
    settings.law      = law;
    settings.velocity = velocity;
    return settings;
  }

  // Layers of spheres that nearly touch, from wall to wall.
  std::vector<dealii::Point<3>>
  layers_of(const double diameter, const unsigned int n_layers)
  {
    const double                  spacing = 1.03 * diameter;
    std::vector<dealii::Point<3>> positions;
    for (unsigned int k = 0; k < n_layers; ++k)
      for (int i = -9; i <= 9; ++i)
        for (int j = -9; j <= 9; ++j)
          if (std::hypot(i, j) * spacing < 9.4 * diameter)
            positions.emplace_back(
              i * spacing, j * spacing, 0.6 * diameter + k * spacing);
    return positions;
  }
} // namespace

TEST(LongSteps, AFreeParticleAnswersAndOneInBalanceStays)
{
  // 0.1 mm glass in air, at ten times the limit of an explicit drag in a dense bed.
  const double dt     = 17e-3;
  const auto settings = glass(FluidProperties{1.2, 1.8e-5}, "gidaspow", 1e-4, 4e-3, 0.01);
  const auto &gravity = settings.gravity;
  Tube        tube(settings, {{0., 0., 2e-3}});
  auto       &particles = tube.dem.particles();
  if (particles.n_owned == 0)
    return;
  const double mass     = particles.mass[0];
  const auto   weight   = mass * gravity;
  const auto   buoyancy = -settings.fluid.density * settings.volume() * gravity;
  const auto   answer   = [&](const double carried) {
    const auto contact = [&](const unsigned int) {
      return -carried * (particles.external_force[0] + weight);
    };
    return particle_response(particles, contact, gravity, settings.fluid.density, dt);
  };
  // Free: v + dt g', and all of dt / m.
  particles.external_force[0] = -0.5 * weight;
  const auto free             = answer(0.);
  EXPECT_NEAR(free.mobility[0], dt / mass, 1e-12 * dt / mass);
  EXPECT_NEAR(free.velocity[0][2], dt / mass * (weight + buoyancy)[2], 1e-12);
  // In balance far from lifting: at rest, and no force moves it.
  const auto held = answer(1.);
  EXPECT_EQ(held.mobility[0], 0.);
  EXPECT_EQ(held.velocity[0].norm(), 0.);
  // It comes loose where the force has turned around, and not before.
  auto       response = answer(1.);
  const auto released = [&](const double part) {
    return release(
      response,
      particles,
      [](const unsigned int) { return dealii::Tensor<1, 3>(); },
      {-part * weight},
      gravity,
      settings.fluid.density,
      MPI_COMM_SELF);
  };
  EXPECT_EQ(released(0.99), 0u);
  EXPECT_EQ(response.mobility[0], 0.);
  EXPECT_EQ(released(1.01), 1u);
  EXPECT_EQ(response.mobility[0], free.mobility[0]);
  EXPECT_NEAR(response.velocity[0][2], free.velocity[0][2], 1e-12);
  EXPECT_EQ(released(2.), 0u);
}

TEST(LongSteps, TheDragIsThatOfTheSurroundingsInTheMiddleOfTheStep)
{
  // In a fluid so viscous that the drag knows no Reynolds number.
  const double dt       = 1e-3;
  auto         settings = glass(FluidProperties{1.2, 1e3}, "wen-yu", 3e-3, 60e-3, 1e-3);
  Tube         tube(settings, layers_of(3e-3, 8));
  auto        &particles = tube.dem.particles();
  tube.step_fluid(dt);
  tube.exchange.update_bed(tube.dem.store(), particles);
  const auto solid = tube.exchange.solid_fractions();
  // By what the force on a sphere falls where it moves by 1 m/s with the fluid.
  const auto coefficients = [&](const double step_before) {
    std::vector<double> result(particles.n_owned);
    for (const double velocity : {0., 1.})
      {
        auto response        = held_response(particles);
        response.step        = dt;
        response.step_before = step_before;
        for (auto &v : response.velocity)
          v[2] = velocity;
        tube.exchange.update_drag(particles, response);
        const auto force =
          tube.exchange.forces(particles, tube.flow, settings.fluid.density, {});
        for (unsigned int row = 0; row < result.size(); ++row)
          result[row] += (1. - 2. * velocity) * force[row][2];
      }
    return result;
  };
  const auto   before   = coefficients(0.);
  const auto   law      = settings.drag();
  const double radius   = 0.5 * settings.particle;
  const auto   of_solid = [&](const double phi) {
    const double alpha = 1. - phi;
    return law.beta(alpha, 1e-3, radius) / (alpha * alpha);
  };
  // What it was, over what it is; the step over the last one; what it will be.
  for (const auto &[was, steps, will_be] :
       {std::tuple(1.2, 1., 0.9), std::tuple(0.9, 2., 1.1), std::tuple(3., 1., 0.5)})
    {
      for (unsigned int row = 0; row < solid.size(); ++row)
        particles.solid_fraction[row] = was * solid[row];
      const auto after = coefficients(dt / steps);
      for (unsigned int row = 0; row < solid.size(); ++row)
        // Of those within, whose own mark the others hide.
        if (solid[row] > 0.4 && will_be * solid[row] < 0.64)
          EXPECT_NEAR(after[row] / before[row],
                      of_solid(will_be * solid[row]) / of_solid(solid[row]),
                      2e-3);
    }
  // Of a sphere that has just come nothing is known.
  for (double &phi : particles.solid_fraction)
    phi = 0.;
  EXPECT_EQ(coefficients(dt), before);
}

TEST(LongSteps, ABedAtRestHasTheSameFlowWithAnyStep)
{
  // Glass in air and in water, at up to twenty times the limit. 1e-4: the slip of the
  // drag is that of the last step, and the sixth has forgotten how the flow began.
  for (const auto &[fluid, law, diameter, velocity, dt] :
       {std::tuple(FluidProperties{1.2, 1.8e-5}, "gidaspow", 1e-4, 0.006, 0.1),
        std::tuple(FluidProperties{998., 1e-3}, "wen-yu", 3e-3, 0.02, 0.5)})
    {
      double drops[2];
      for (const bool is_steady : {true, false})
        {
          Tube       tube(glass(fluid, law, diameter, 20. * diameter, velocity),
                    layers_of(diameter, 8));
          const auto held = [&](const unsigned int row) {
            const auto &particles = tube.dem.particles();
            return -(particles.external_force[row] +
                     particles.mass[row] * tube.settings.gravity);
          };
          for (unsigned int n = 0; n < 20; ++n)
            if (is_steady)
              tube.step_fluid(FlowSolver::steady);
            else
              tube.step_fluid(dt, held);
          drops[is_steady] = tube.flow.mean_pressure(VesselMesh::bottom) -
                             tube.flow.mean_pressure(VesselMesh::top);
          if (!is_steady)
            {
              EXPECT_GT(dt, 10. * tube.exchange.stable_step(tube.dem.particles()));
            }
        }
      std::cout << "steps of " << dt << " s: " << drops[0] << " Pa, steady " << drops[1]
                << " Pa" << std::endl;
      EXPECT_NEAR(drops[0], drops[1], 1e-4 * drops[1]);
    }
}
