#include <graupel/simulation/files/contact_output.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace graupel;

namespace
{
  // What follows @p keyword in a file, as numbers.
  std::vector<double>
  numbers_after(const std::string &text, const std::string &keyword, const unsigned int n)
  {
    const auto found = text.find(keyword);
    if (found == std::string::npos)
      return {};
    std::istringstream  stream(text.substr(found + keyword.size()));
    std::vector<double> numbers(n);
    for (double &number : numbers)
      stream >> number;
    return stream ? numbers : std::vector<double>();
  }

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

// One line for each contact, its ends and values as given; the legacy format is
// plain text, the numbers are printed with six digits or more.
TEST(ContactOutput, IsALinePerContact)
{
  std::ostringstream stream;
  ContactOutput(two_contacts()).write_vtk(stream);
  const std::string text = stream.str();
  EXPECT_EQ(numbers_after(text, "CELLS ", 2), (std::vector<double>{2, 6}));
  EXPECT_EQ(numbers_after(text, "CELL_TYPES 2", 2), (std::vector<double>{3, 3}));
  const auto points = numbers_after(text, "POINTS 4 double", 12);
  ASSERT_EQ(points.size(), 12u) << text;
  const std::vector<double> ends{
    0., 0., 0.01, 2e-3, 0., 0.01, 2e-3, 0., 1e-3, 2e-3, 0., 0.};
  for (unsigned int i = 0; i < 12; ++i)
    EXPECT_NEAR(points[i], ends[i], 1e-8) << i;

  for (const std::string values :
       {"normal_force double 1\nLOOKUP_TABLE default\n5 5 7 7",
        "tangential_force double 1\nLOOKUP_TABLE default\n3 3 0 0",
        "overlap double 1\nLOOKUP_TABLE default\n1e-05 1e-05 2e-05 2e-05",
        "with_wall double 1\nLOOKUP_TABLE default\n0 0 1 1"})
    EXPECT_NE(text.find("SCALARS " + values), std::string::npos) << values;
  EXPECT_EQ(numbers_after(text, "VECTORS force double", 6),
            (std::vector<double>{-5., 0., 3., -5., 0., 3.}));
}

TEST(ContactOutput, VtuHasTheCellsAndNoContactsAreNoError)
{
  std::ostringstream two, none;
  ContactOutput(two_contacts()).write_vtu(two);
  EXPECT_NE(two.str().find("NumberOfPoints=\"4\" NumberOfCells=\"2\""),
            std::string::npos);
  EXPECT_NO_THROW(ContactOutput({}).write_vtu(none));
  EXPECT_NE(none.str().find("</VTKFile>"), std::string::npos);
}
