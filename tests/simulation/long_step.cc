// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/dem_error.h>
#include <graupel/simulation/state/coupled_flow.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // What becomes of a sphere of 3.2 mm above the bottom that is pushed down with
  // @p force [N] for @p step [s] of the fluid; "" if nothing does.
  std::string
  complaint(const double force, const double step)
  {
    RunParameters parameters;
    parameters.cylinder      = {0.025, 0.04};
    parameters.fluid.density = 998.;
    CostSheet  costs;
    VesselMesh mesh(parameters.cylinder, parameters.mesh, MPI_COMM_WORLD);
    Dem        dem(parameters.dem, mesh, costs);
    dem.insert({dealii::Point<3>(0., 0., 2e-3)});
    CoupledFlow flow(parameters, dem.original_sauter_diameter(), 1., mesh, dem, costs);
    for (unsigned int row = 0; row < dem.particles().n_owned; ++row)
      dem.particles().external_force[row][2] = -force;
    try
      {
        flow.move_particles(step);
      }
    catch (const DemError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(LongStep, AnOverlapThatItComesToIsItsOwn)
{
  // Its weight does not press it through the bottom; ten thousand times that does.
  EXPECT_EQ(complaint(0., 1e-2), "");
  const std::string text = complaint(1., 1.);
  for (const std::string word : {"steps of the fluid of 1 s are too long",
                                 "Try a smaller Flow/time step",
                                 "What it came to: "})
    EXPECT_NE(text.find(word), std::string::npos) << text;
}
