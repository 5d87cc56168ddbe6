// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/files/contact_output.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace graupel;

namespace
{
  // A pair pressed with 5 N along x and sheared with 3 N, and a sphere on the bottom.
  std::vector<ContactState>
  two_contacts()
  {
    return {{0,
             1,
             {0., 0., 0.01},
             {2e-3, 0., 0.01},
             1e-5,
             dealii::Tensor<1, 3>({1., 0., 0.}),
             dealii::Tensor<1, 3>({-5., 0., 3.})},
            {1,
             -2,
             {2e-3, 0., 1e-3},
             {2e-3, 0., 0.},
             2e-5,
             dealii::Tensor<1, 3>({0., 0., -1.}),
             dealii::Tensor<1, 3>({0., 0., 7.})}};
  }
} // namespace

// What the file says of the arrays is read back by tests through the program; here the
// number of cells and points, and that there may be none.
TEST(ContactOutput, IsALinePerContact)
{
  std::ostringstream two, none;
  contact_output(two_contacts()).write_vtu(two);
  EXPECT_NE(two.str().find("NumberOfPoints=\"4\" NumberOfCells=\"2\""),
            std::string::npos);
  EXPECT_NO_THROW(contact_output({}).write_vtu(none));
  EXPECT_NE(none.str().find("</VTKFile>"), std::string::npos);
}
