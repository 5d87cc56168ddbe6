// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/contact_list.h>
#include <graupel/dem/walls/walls.h>

#include <gtest/gtest.h>

#include <set>

namespace
{
  using namespace graupel;

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
          const double         rho = relative * 0.0125;
          const Triple<double> x{rho * std::cos(angle), rho * std::sin(angle), 0.1};
          const auto           g = walls[lateral_wall].at(x);
          EXPECT_NEAR(g.distance, 0.0125 - rho, 1e-16);
          EXPECT_NEAR(g.normal.x, std::cos(angle), 1e-12);
          EXPECT_NEAR(g.normal.y, std::sin(angle), 1e-12);
          EXPECT_EQ(g.normal.z, 0.);
        }
  }

  TEST(Walls, TubeOnItsAxisHasSomeUnitNormal)
  {
    const auto g = vessel_walls(vessel())[lateral_wall].at(Triple<double>{0., 0., 0.05});
    EXPECT_NEAR(g.distance, 0.0125, 1e-16);
    EXPECT_NEAR(g.normal.norm(), 1., 1e-15);
  }

  // Bottom at z = 0 with normal down, top at z = height with normal up.
  TEST(Walls, BottomAndTop)
  {
    const auto           walls = vessel_walls(vessel());
    const Triple<double> x{0.003, -0.002, 0.0012};
    EXPECT_NEAR(walls[bottom_wall].at(x).distance, 0.0012, 1e-16);
    EXPECT_EQ(walls[bottom_wall].at(x).normal.z, -1.);
    EXPECT_NEAR(walls[top_wall].at(x).distance, 0.1678, 1e-15);
    EXPECT_EQ(walls[top_wall].at(x).normal.z, 1.);
  }

  // Contacts without holes: whatever is removed, the others keep their springs.
  TEST(ContactList, RemovesAndKeepsTheRest)
  {
    ContactList list;
    for (unsigned int k = 0; k < 3 * n_lanes + 1; ++k)
      list.add(k, 100 + k, {{1. * k, 0., 0.}, {0., 0., -1. * k}});
    list.begin(77, 78);
    EXPECT_EQ(list.first_fresh(), 3 * n_lanes + 1);
    list.age();
    list.remove(3 * n_lanes + 1);
    std::set<unsigned int> left;
    for (unsigned int k = 0; k < 3 * n_lanes + 1; ++k)
      left.insert(k);
    while (list.size() > 0)
      {
        const unsigned int k = (list.size() * 7) % list.size();
        left.erase(list.first(k));
        list.remove(k);
        ASSERT_EQ(list.size(), left.size());
        EXPECT_EQ(list.blocks.size(), (list.size() + n_lanes - 1) / n_lanes);
        for (std::size_t m = 0; m < list.size(); ++m)
          {
            EXPECT_EQ(left.count(list.first(m)), 1u);
            EXPECT_EQ(list.second(m), 100 + list.first(m));
            EXPECT_EQ(list.springs(m).tangential.x, list.first(m));
            EXPECT_EQ(list.springs(m).rolling.z, -1. * list.first(m));
          }
      }
  }
} // namespace
