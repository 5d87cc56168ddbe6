// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/simulation.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

using namespace graupel;

namespace
{
  // tests/cases/shallow.prm with @p overrides, run whole on all ranks.
  Summary
  run(const std::vector<std::string> &overrides)
  {
    dealii::ParameterHandler prm;
    RunParameters            parameters;
    parameters.declare(prm);
    ParameterFile file(prm);
    file.read(GRAUPEL_SOURCE_DIR "/tests/cases/shallow.prm");
    for (const std::string &assignment : overrides)
      file.set(assignment);
    parameters.texts = file.texts();
    parameters.check();
    const auto directory =
      std::filesystem::temp_directory_path() / "graupel-test-adaptive-run";
    Summary summary;
    {
      ResultFiles files(directory.string(), MPI_COMM_WORLD);
      Progress    silent;
      Simulation  simulation(parameters, "shallow.prm", files, silent, MPI_COMM_WORLD);
      files.begin();
      simulation.run();
      summary = simulation.result();
    }
    MPI_Barrier(MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(directory);
    MPI_Barrier(MPI_COMM_WORLD);
    return summary;
  }
} // namespace

// A mesh that follows the bed while the gas flows loses nothing, and gives what the
// mesh that is fine everywhere gives.
TEST(AdaptiveRun, LosesNothingAndGivesThePressureDropOfTheFineMesh)
{
  const std::vector<std::string> common{"Flow/superficial velocities=0.5",
                                        "Coupling/filter length=3e-3"};
  const auto                     with = [&](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return run(more);
  };
  const Summary fine     = with({"Mesh/cell size=2.1e-3"});
  const Summary coarse   = with({"Mesh/cell size=4.2e-3"});
  const Summary adaptive = with({"Mesh/cell size=4.2e-3",
                                 "Mesh adaption/initial passes=2",
                                 "Mesh adaption/interval=0.02",
                                 "Mesh adaption/surface threshold=0.1",
                                 "Mesh adaption/at the wall=true"});
  const auto    error    = [&](const Summary &run) {
    return *run.cases[0]["pressure_drop"] / *fine.cases[0]["pressure_drop"] - 1.;
  };
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << "cells " << coarse.cells << ", " << adaptive.cells << ", " << fine.cells
              << "; pressure drop against the finest: " << error(coarse) << ", "
              << error(adaptive) << '\n';
  EXPECT_GT(adaptive.cells, coarse.cells);
  EXPECT_LT(adaptive.cells, fine.cells);
  // The inside of the bed stays coarse.
  EXPECT_LE(std::abs(error(adaptive)), 0.015);
  EXPECT_LT(std::abs(error(adaptive)), 0.5 * std::abs(error(coarse)));
  EXPECT_EQ(adaptive.bed.particle_count, 150u);
  EXPECT_LE(adaptive.ledger.max_solid_volume_error, 1e-12);
  EXPECT_LE(adaptive.ledger.max_mass_imbalance, 1e-8);
  EXPECT_LE(adaptive.ledger.max_momentum_imbalance, 1e-10);
}
