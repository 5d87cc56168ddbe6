#include <graupel/coupling/exchange.h>
#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

// Steps of the fluid ten and twenty times as long as an explicit drag would bear.

using namespace graupel;

namespace
{
  const dealii::Tensor<1, 3> gravity{{0., 0., -9.81}};

  FluidProperties
  fluid_of(const double density, const double viscosity)
  {
    FluidProperties result;
    result.density   = density;
    result.viscosity = viscosity;
    return result;
  }

  DemParameters
  spheres(const double diameter, const double density)
  {
    DemParameters result;
    result.particles.diameter = diameter;
    result.particles.density  = density;
    return result;
  }

  DragOfType
  drag_of(const std::string &law, const FluidProperties &fluid, const double diameter)
  {
    DragParameters choice;
    choice.law = law;
    return {Drag(choice, fluid, diameter, 1.), 0.5 * diameter};
  }

  // Spheres in a tube of twenty diameters with a fluid that rises through it.
  struct Column
  {
    Column(const FluidProperties               &fluid,
           const std::string                   &law,
           const double                         diameter,
           const double                         density,
           const double                         height,
           const double                         velocity,
           const std::vector<dealii::Point<3>> &positions)
      : fluid(fluid)
      , drag(drag_of(law, fluid, diameter))
      , mesh({20. * diameter, height}, {2.5 * diameter, 0.}, MPI_COMM_WORLD)
      , nodes(mesh)
      , dem(spheres(diameter, density), mesh, costs)
      , exchange(diameter / std::sqrt(2.), true, {}, {drag}, nodes, costs)
      , flow({}, fluid.density, fluid.viscosity, nodes, costs)
    {
      flow.set_superficial_velocity(velocity);
      dem.insert(positions);
      look();
    }

    void
    look()
    {
      dem.synchronise();
      exchange.update_bed(dem.store(), dem.particles());
    }

    // The force of the fluid after a step past particles that contacts hold in balance.
    void
    step_past_held(const double dt)
    {
      const auto contact = [&](const unsigned int row) {
        return -(dem.particles().external_force[row] +
                 dem.particles().mass[row] * gravity);
      };
      if (std::isfinite(dt))
        exchange.update_drag(
          dem.particles(),
          particle_response(dem.particles(), contact, gravity, fluid.density, dt));
      else
        exchange.update_drag(dem.particles());
      flow.step(exchange.medium(), dt);
      dem.particles().external_force =
        exchange.forces(dem.particles(), flow, fluid.density, gravity);
      EXPECT_LE(exchange.momentum_imbalance(), 1e-10);
    }

    double
    pressure_drop() const
    {
      return flow.mean_pressure(VesselMesh::bottom) - flow.mean_pressure(VesselMesh::top);
    }

    const FluidProperties fluid;
    const DragOfType      drag;
    CostSheet             costs;
    VesselMesh            mesh;
    NodalSpace            nodes;
    Dem                   dem;
    Exchange              exchange;
    FlowSolver            flow;
  };

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
  const double dt = 17e-3;
  Column       column(
    fluid_of(1.2, 1.8e-5), "gidaspow", 1e-4, 2500., 4e-3, 0.01, {{0., 0., 2e-3}});
  auto &particles = column.dem.particles();
  if (particles.n_owned == 0)
    return;
  const double mass     = particles.mass[0];
  const auto   weight   = mass * gravity;
  const auto   buoyancy = -column.fluid.density * sphere_volume(5e-5) * gravity;
  const auto   answer   = [&](const double carried) {
    const auto contact = [&](const unsigned int) {
      return -carried * (particles.external_force[0] + weight);
    };
    return particle_response(particles, contact, gravity, column.fluid.density, dt);
  };
  // Free: v + dt g', and all of dt / m.
  particles.external_force[0] = -0.5 * weight;
  const auto free             = answer(0.);
  EXPECT_NEAR(free.mobility[0], dt / mass, 1e-12 * dt / mass);
  EXPECT_NEAR(free.velocity[0][2], dt / mass * (weight + buoyancy)[2], 1e-12);
  EXPECT_EQ(free.yielding[0], 0.);
  // In balance far from lifting: at rest, and no force moves it.
  const auto held = answer(1.);
  EXPECT_EQ(held.mobility[0], 0.);
  EXPECT_EQ(held.velocity[0].norm(), 0.);
  EXPECT_EQ(held.yielding[0], 0.);
  // About to lift: it yields, with enough for a bed that comes loose unforeseen. With
  // x = yielding K (1 - alpha) m / dt, K = dt beta / (m alpha^2), the product of the
  // roots of (1 + x) z^2 - (1 + 2 x - K) z + x is below 1, so they leave the circle at
  // -1.
  particles.external_force[0] = -0.99 * weight;
  const double part           = answer(1.).yielding[0] * mass / dt;
  EXPECT_EQ(answer(1.).mobility[0], 0.);
  for (const double alpha : {0.3, 0.4, 0.45})
    for (const double K : {1., 10., 100.})
      {
        const double x = part * K * (1. - alpha);
        EXPECT_GT(1. + x + (1. + 2. * x - K) + x, 0.) << alpha << ' ' << K;
      }
}

TEST(LongSteps, ABedAtRestHasTheSameFlowWithAnyStep)
{
  // Glass in air and in water, at up to twenty times the limit. 1e-4: the slip of the
  // drag is that of the last step, and the sixth has forgotten how the flow began.
  for (const auto &[fluid, law, diameter, velocity, dt] :
       {std::tuple(fluid_of(1.2, 1.8e-5), "gidaspow", 1e-4, 0.006, 0.1),
        std::tuple(fluid_of(998., 1e-3), "wen-yu", 3e-3, 0.02, 0.5)})
    {
      double drops[2];
      for (const bool is_steady : {true, false})
        {
          Column column(fluid,
                        law,
                        diameter,
                        2500.,
                        20. * diameter,
                        velocity,
                        layers_of(diameter, 8));
          for (unsigned int n = 0; n < 20; ++n)
            column.step_past_held(is_steady ? FlowSolver::steady : dt);
          drops[is_steady] = column.pressure_drop();
          if (!is_steady)
            {
              EXPECT_GT(dt, 10. * column.exchange.stable_step(column.dem.particles()));
            }
        }
      std::cout << "steps of " << dt << " s: " << drops[0] << " Pa, steady " << drops[1]
                << " Pa" << std::endl;
      EXPECT_NEAR(drops[0], drops[1], 1e-4 * drops[1]);
    }
}
