// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/bed_correlations.h>
#include <graupel/coupling/exchange.h>

#include <gtest/gtest.h>

using namespace graupel;

// A bed of one void fraction with fixed spheres: the flow's pressure gradient
// must be the one that the closure has in closed form,
//
//   -dp/dz = n beta_p(alpha, V / alpha) V / alpha^2,   n = (1 - alpha) / V_p,
//
// for every law and every form of scaling. Only the linear solver's tolerance
// (1e-8) lies between the two.
TEST(UniformBed, EveryLawAndScalingGivesItsClosedForm)
{
  const FluidProperties fluid;
  const double          alpha = 0.4, velocity = 0.4, diameter = 1.6e-3, length = 0.05;
  CostSheet             costs;
  const VesselMesh      mesh({0.025, length}, {6.4e-3, 0.}, MPI_COMM_WORLD);
  const NodalSpace      nodes(mesh);
  FlowParameters        parameters;
  parameters.linear_tolerance = 1e-11;

  for (const DragLaw &law : drag_laws())
    for (const std::string scaling : {"exact", "ricklick-baran", "expression", "none"})
      for (const double scale : {1., 2., 3.})
        {
          DragParameters choice;
          choice.law        = law.name;
          choice.scaling    = scaling;
          choice.expression = "1.5*s*Cd + 0.1*alpha";
          const Drag   drag(choice, fluid, diameter, scale);
          const double n    = (1. - alpha) / sphere_volume(0.5 * scale * diameter);
          const double beta = drag.beta(alpha, velocity / alpha);

          const auto gradient_of = [&](const bool model_a) {
            Medium medium(nodes);
            medium.shares_pressure = model_a;
            medium.void_fraction   = alpha;
            medium.drag            = n * beta / (model_a ? 1. : alpha);
            medium.void_fraction.update_ghost_values();
            medium.drag.update_ghost_values();
            FlowSolver flow(parameters, fluid.density, fluid.viscosity, nodes, costs);
            flow.set_superficial_velocity(velocity);
            for (unsigned int step = 0; step < 4; ++step)
              flow.step(medium, 0.1);
            return (flow.mean_pressure(VesselMesh::bottom) -
                    flow.mean_pressure(VesselMesh::top)) /
                   length;
          };
          const double gradient = gradient_of(true);
          EXPECT_NEAR(gradient_of(false), gradient, 1e-6 * gradient)
            << "model B, " << law.name << ", " << scaling << ", scale " << scale;
          const double expected = n * beta * velocity / (alpha * alpha);
          EXPECT_NEAR(gradient, expected, 1e-8 * expected)
            << law.name << ", " << scaling << ", scale " << scale;
          if (law.name == "ergun" && scaling == "exact")
            {
              const double ergun =
                ergun_pressure_gradient(fluid, diameter, alpha, velocity);
              EXPECT_NEAR(gradient, ergun, 1e-8 * ergun) << "scale " << scale;
            }
        }
}
