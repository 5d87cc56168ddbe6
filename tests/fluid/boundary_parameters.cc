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
