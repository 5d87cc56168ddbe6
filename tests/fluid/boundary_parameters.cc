// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/fluid/boundary_parameters.h>

#include <gtest/gtest.h>

using namespace graupel;

TEST(BoundaryCondition, AWordEndsAtABlank)
{
  const auto read = [](const std::string &text) {
    return BoundaryCondition::read(text, "Boundary conditions/top");
  };
  EXPECT_EQ(read("pressure 100").expressions, std::vector<std::string>{"100"});
  EXPECT_EQ(read(" pressure\t100 ").expressions, std::vector<std::string>{"100"});
  EXPECT_EQ(read("velocity 0; 0; V").kind, BoundaryCondition::velocity);
  EXPECT_EQ(read("no-slip").kind, BoundaryCondition::no_slip);
  EXPECT_EQ(read("pressure 1/(t - 1)").kind, BoundaryCondition::pressure);
  EXPECT_EQ(read("velocity 0; 0; sqrt(x - 0.05)").kind, BoundaryCondition::velocity);
  for (const char *text : {"pressure100",
                           "pressure(100)",
                           "pressures 100",
                           "velocity0; 0; V",
                           "mass flow rate1e-4",
                           "plugs",
                           "slippery",
                           "pressure",
                           "plug 3",
                           "velocity 0; 0",
                           "velocity 0; 0; W",
                           "velocity 0; 0; sqrt(-1)",
                           "pressure 1e400",
                           "pressure nan",
                           ""})
    try
      {
        read(text);
        ADD_FAILURE() << text << " passed";
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.parameter, "Boundary conditions/top");
      }
}
