// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/particles/particle_types.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // What is said of a list of sizes; "" if it can be used.
  std::string
  complaint(const std::string &list)
  {
    SizeDistribution sizes;
    sizes.kind = "list";
    sizes.list = list;
    try
      {
        sizes.check(1.6e-3, "Particles");
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.parameter, "Particles/size list");
        return error.what();
      }
    return "";
  }
} // namespace

TEST(SizeList, IsRefusedByName)
{
  EXPECT_EQ(complaint("1e-3: 0.4, 2e-3: 0.6"), "");
  EXPECT_EQ(complaint("1e-3 : 1"), "");
  EXPECT_EQ(complaint("1e-3: abc"),
            "Particles/size list: \"1e-3: abc\" is not a diameter and its share; write "
            "diameters and shares, \"1e-3: 0.4, 2e-3: 0.6\"");
  for (const char *list : {"",
                           "1e-3",
                           "1e-3: 0.4: 2",
                           "1e-3: 0.4, 2e-3",
                           "1e-3 m: 1",
                           "nan: 1",
                           "1e-3: inf",
                           "0: 1",
                           "-1e-3: 1",
                           "1e-3: -1",
                           "1e-3: 0, 2e-3: 0"})
    EXPECT_NE(complaint(list), "") << list;
}

TEST(SizeList, SortsAndScalesItsShares)
{
  SizeDistribution sizes;
  sizes.kind = "list";
  sizes.list = "2e-3: 3, 1e-3: 1";
  EXPECT_EQ(sizes.smallest_diameter(1.6e-3), 1e-3);
  EXPECT_EQ(sizes.largest_diameter(1.6e-3), 2e-3);
  EXPECT_EQ(sizes.quantile(0.24, 1.6e-3), 1e-3);
  EXPECT_EQ(sizes.quantile(0.26, 1.6e-3), 2e-3);
}
