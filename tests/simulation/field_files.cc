// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/studies/study_runs.h>

#include <deal.II/base/hdf5.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

using namespace graupel;

namespace
{
  // deal.II keeps what it writes in single precision.
  constexpr double single = 2e-7;

  const auto directory =
    std::filesystem::temp_directory_path() / "graupel-test-field-files";

  bool
  is_first()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  // The manufactured solution of prm/studies on one mesh, its fields as HDF5.
  void
  write_fields()
  {
    dealii::ParameterHandler prm;
    RunParameters            parameters;
    parameters.declare(prm);
    ParameterFile file(prm);
    file.read(GRAUPEL_SOURCE_DIR "/prm/studies/manufactured-solution.prm");
    file.set("Output/field format=hdf5");
    file.set("Mesh/cell size=0.0833");
    parameters.check();
    Progress silent;
    manufactured_level(parameters, directory.string(), silent, MPI_COMM_WORLD);
  }

  struct Fields
  {
    std::vector<double>       nodes, void_fraction, pressure, flux, velocity;
    std::vector<unsigned int> cells;
  };

  Fields
  read_fields()
  {
    const dealii::HDF5::File file((directory / "h5" / "solution_0000.h5").string(),
                                  dealii::HDF5::File::FileAccessMode::open,
                                  MPI_COMM_WORLD);
    const auto read = [&](const std::string &name) {
      return file.open_dataset(name).read<std::vector<double>>();
    };
    return {read("nodes"),
            read("void_fraction"),
            read("pressure"),
            read("flux"),
            read("velocity"),
            file.open_dataset("cells").read<std::vector<unsigned int>>()};
  }
} // namespace

// Each node once, with the values of the given flow there, and XDMF that names the file.
TEST(FieldFiles, HoldTheFieldsAtTheNodesInHdf5)
{
  write_fields();
  const Fields fields = read_fields();

  const unsigned int n = fields.void_fraction.size();
  ASSERT_GT(n, 1000u);
  ASSERT_EQ(fields.nodes.size(), 3 * n);
  ASSERT_EQ(fields.pressure.size(), n);
  ASSERT_EQ(fields.flux.size(), 3 * n);
  // Eight corners a cell would be six times as many; nodes between ranks are there twice.
  EXPECT_LT(n, 1.6 * fields.cells.size() / 8);
  EXPECT_EQ(*std::max_element(fields.cells.begin(), fields.cells.end()), n - 1);

  std::vector<double> off(n);
  for (unsigned int k = 0; k < n; ++k)
    {
      const double x = fields.nodes[3 * k], y = fields.nodes[3 * k + 1],
                   z = fields.nodes[3 * k + 2], alpha = fields.void_fraction[k];
      EXPECT_NEAR(alpha, 0.6 + 0.2 * std::sin(2 * x) * std::cos(2 * z), single);
      EXPECT_NEAR(fields.velocity[3 * k + 2], 1 + 0.3 * std::sin(x + y + 2 * z), 0.03);
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(fields.velocity[3 * k + i] * alpha, fields.flux[3 * k + i], single);
      off[k] = fields.pressure[k] -
               (std::sin(2 * x) * std::cos(2 * y) + std::cos(2 * z));
    }
  // The level of the pressure is of no consequence.
  const double level = std::accumulate(off.begin(), off.end(), 0.) / n;
  for (const double difference : off)
    EXPECT_NEAR(difference, level, 0.1);

  if (is_first())
    {
      std::ifstream     stream(directory / "solution.xdmf");
      std::stringstream xdmf;
      xdmf << stream.rdbuf();
      const std::string text = xdmf.str();
      EXPECT_NE(text.find("h5/solution_0000.h5:/pressure"), std::string::npos) << text;
      EXPECT_NE(text.find("<Time Value=\"0"), std::string::npos) << text;
      EXPECT_NE(text.find(std::to_string(n) + " 3"), std::string::npos) << text;
    }
  MPI_Barrier(MPI_COMM_WORLD);
  if (is_first())
    std::filesystem::remove_all(directory);
}
