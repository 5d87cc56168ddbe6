#include <graupel/dem/spring_table.h>
#include <graupel/dem/walls.h>

#include <gtest/gtest.h>

namespace
{
  using namespace graupel;
  using dealii::Point;

  Cylinder
  vessel()
  {
    return {0.025, 0.169};
  }

  // Distance and outward normal of the tube, at 0.99 of its radius and beyond,
  // all around: exact geometry, limit rounding.
  TEST(Walls, TubeNearAndBeyondTheWall)
  {
    const auto walls = vessel_walls(vessel());
    for (const double relative : {1e-3, 0.5, 0.99, 1., 1.01})
      for (double angle = 0.; angle < 6.2; angle += 0.3)
        {
          const double   rho = relative * 0.0125;
          const Point<3> x(rho * std::cos(angle), rho * std::sin(angle), 0.1);
          const auto     g = walls[lateral_wall].at(x);
          EXPECT_NEAR(g.distance, 0.0125 - rho, 1e-16);
          EXPECT_NEAR(g.normal[0], std::cos(angle), 1e-12);
          EXPECT_NEAR(g.normal[1], std::sin(angle), 1e-12);
          EXPECT_EQ(g.normal[2], 0.);
        }
  }

  TEST(Walls, TubeOnItsAxisHasSomeUnitNormal)
  {
    const auto g = vessel_walls(vessel())[lateral_wall].at(Point<3>(0., 0., 0.05));
    EXPECT_NEAR(g.distance, 0.0125, 1e-16);
    EXPECT_NEAR(g.normal.norm(), 1., 1e-15);
  }

  // Bottom at z = 0 with normal down, top at z = height with normal up.
  TEST(Walls, BottomAndTop)
  {
    const auto     walls = vessel_walls(vessel());
    const Point<3> x(0.003, -0.002, 0.0012);
    EXPECT_NEAR(walls[bottom_wall].at(x).distance, 0.0012, 1e-16);
    EXPECT_EQ(walls[bottom_wall].at(x).normal[2], -1.);
    EXPECT_NEAR(walls[top_wall].at(x).distance, 0.1678, 1e-15);
    EXPECT_EQ(walls[top_wall].at(x).normal[2], 1.);
  }

  // What goes into the slots comes out, through the packed form as well, bit
  // for bit; ids of walls and of particle 0 included. A full row refuses.
  TEST(SpringTable, KeepsAndRefuses)
  {
    SpringTable table;
    table.reset(2);
    for (std::int64_t k = 0; k < 14; ++k)
      EXPECT_TRUE(table.add(1,
                            k,
                            {dealii::Tensor<1, 3>({0.1 * k, 1. / 3., -1. * k}),
                             dealii::Tensor<1, 3>({k + 0.7, 0., 1e-30})}));
    EXPECT_TRUE(table.add(1, wall_id(lateral_wall), {}));
    EXPECT_TRUE(table.add(1, wall_id(bottom_wall), {}));
    EXPECT_FALSE(table.add(1, 99, {}));
    EXPECT_EQ(table.n_particle_contacts(1), 14u);
    EXPECT_EQ(table.n_particle_contacts(0), 0u);

    std::vector<double> numbers(SpringTable::n_numbers);
    table.pack(1, numbers.data());
    SpringTable copy;
    copy.reset(1);
    copy.unpack(0, numbers.data());
    for (std::int64_t k = 0; k < 14; ++k)
      {
        ASSERT_NE(copy.find(0, k), nullptr);
        EXPECT_EQ(copy.find(0, k)->tangential, table.find(1, k)->tangential);
        EXPECT_EQ(copy.find(0, k)->rolling, table.find(1, k)->rolling);
      }
    EXPECT_NE(copy.find(0, wall_id(bottom_wall)), nullptr);
    EXPECT_EQ(copy.find(0, wall_id(top_wall)), nullptr);
    EXPECT_EQ(copy.find(0, 99), nullptr);
  }
} // namespace
