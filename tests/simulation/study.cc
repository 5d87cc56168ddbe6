// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/studies/study.h>
#include <graupel/simulation/studies/study_levels.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace graupel;

namespace
{
  LevelResult
  level(const double scale, const double value)
  {
    LevelResult result;
    result.scale        = scale;
    result.measurements = {{"pressure drop", value}};
    return result;
  }

  LevelResult
  hole()
  {
    LevelResult result;
    result.has_failed = true;
    return result;
  }

  // A bed whose steps are varied; short enough to be checked only.
  RunParameters
  study_of_time_steps()
  {
    RunParameters parameters;
    parameters.study.vary   = "time step";
    parameters.study.values = {8e-3, 4e-3, 2e-3, 1e-3};
    return parameters;
  }

  // The reason why a level cannot run; "" if all can.
  std::string
  complaint(const RunParameters &parameters)
  {
    try
      {
        check_levels(parameters);
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.parameter, "Refinement study/values");
        return error.what();
      }
    return "";
  }
} // namespace

TEST(Study, RepeatedLevelsGiveMeanAndStandardError)
{
  const auto mean = mean_of({level(2., 10.), level(2., 12.), level(2., 14.)});
  EXPECT_DOUBLE_EQ(mean.measurements[0].value.value(), 12.);
  EXPECT_DOUBLE_EQ(mean.measurements[0].standard_error, 2. / std::sqrt(3.));
  EXPECT_DOUBLE_EQ(mean_of({level(2., 10.)}).measurements[0].standard_error, 0.);
}

TEST(Study, LadderEndsAtScaleOne)
{
  const auto value = [](const double s) { return 500. - 60. * s - 3. * s * s; };
  const auto rows =
    evaluate_ladder({level(4., value(4.)), level(3., value(3.)), level(2., value(2.))});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_FALSE(rows[1].extrapolated);
  ASSERT_TRUE(rows[2].extrapolated && rows[2].index);
  EXPECT_NEAR(*rows[2].extrapolated, value(1.), 1e-10);
  // The line through the two smallest scales misses it by 3 (1 - 2) (1 - 3).
  EXPECT_NEAR(*rows[2].index, 1.25 * 6. / value(1.), 1e-12);
}

// A drop that is a smooth ratio times a value of the original bed which every level tells
// with an error of its own: the ratio is extrapolated, the value averaged.
TEST(Study, ALadderMultipliesWhatItsFactorsComeTo)
{
  const auto ratio = [](const double s) { return 0.98 + 0.005 * s; };
  const auto at    = [&](const double s, const double original) {
    LevelResult result = level(s, 0.);
    Measurement over{"over", ratio(s)}, value{"original", original};
    value.at_scale_one = AtScaleOne::mean;
    Measurement drop{"drop", ratio(s) * (500. - 60. * s)};
    drop.at_scale_one   = AtScaleOne::product;
    drop.factors        = {"over", "original"};
    result.measurements = {drop, over, value};
    return result;
  };
  const auto rows = evaluate_ladder({at(4., 430.), at(3., 430.), at(2., 430.)});
  ASSERT_EQ(rows.size(), 9u);
  EXPECT_NEAR(rows[2].extrapolated.value(), ratio(1.) * 430., 1e-10);
  EXPECT_NEAR(rows[2].index.value(), 0., 1e-12);
  EXPECT_NEAR(rows[8].extrapolated.value(), 430., 1e-12);
  EXPECT_FALSE(rows[1].extrapolated);
  const auto scattered = evaluate_ladder({at(4., 430.), at(3., 430.), at(2., 439.)});
  EXPECT_NEAR(
    scattered[2].extrapolated.value(), ratio(1.) * (430. + 9. * 36. / 49.), 1e-9);
  EXPECT_GT(scattered[2].index.value(), 0.005);
}

// A level at scale 1 is its own value, whatever larger spheres tell.
TEST(Study, ALadderDownToScaleOneNeedsNoMean)
{
  LevelResult levels[3] = {level(3., 5.), level(2., 6.), level(1., 7.)};
  for (LevelResult &one : levels)
    one.measurements[0].at_scale_one = AtScaleOne::mean;
  const auto rows = evaluate_ladder({levels[0], levels[1], levels[2]});
  EXPECT_DOUBLE_EQ(rows[2].extrapolated.value(), 7.);
}

TEST(Study, NothingIsComputedAcrossAHole)
{
  // f = 3 + h^2 / 4 has order 2 and the value 3 at h = 0.
  const auto at    = [](const double h) { return level(1., 3. + h * h / 4.); };
  const auto whole = evaluate_study({at(8.), at(4.), at(2.), at(1.)}, {8., 4., 2., 1.});
  ASSERT_EQ(whole.size(), 4u);
  EXPECT_NEAR(whole[3].observed_order.value(), 2., 1e-10);
  EXPECT_NEAR(whole[3].extrapolated.value(), 3., 1e-10);

  for (const unsigned int failed : {0u, 1u, 2u, 3u})
    {
      std::vector<LevelResult> levels{at(8.), at(4.), at(2.), at(1.)};
      levels[failed]  = hole();
      const auto rows = evaluate_study(levels, {8., 4., 2., 1.});
      ASSERT_EQ(rows.size(), 4u);
      for (unsigned int n = 0; n < 4; ++n)
        {
          EXPECT_EQ(rows[n].level, n + 1);
          EXPECT_EQ(rows[n].measurement.quantity, "pressure drop");
          EXPECT_EQ(rows[n].measurement.value.has_value(), n != failed);
          const unsigned int neighbours = n < failed ? n + 1 : n - failed;
          EXPECT_EQ(rows[n].error_or_change.has_value(), neighbours >= 2);
          EXPECT_EQ(rows[n].extrapolated.has_value(), neighbours >= 3);
        }
    }
}

TEST(Study, ALadderBeginsAnewBehindAHole)
{
  const auto at   = [](const double s) { return level(s, 500. - 60. * s); };
  const auto rows = evaluate_ladder({at(5.), hole(), at(3.), at(2.), at(1.5)});
  ASSERT_EQ(rows.size(), 5u);
  for (unsigned int n = 0; n < 4; ++n)
    EXPECT_FALSE(rows[n].extrapolated) << n;
  EXPECT_NEAR(rows[4].extrapolated.value(), 440., 1e-10);
}

TEST(Study, WithoutANumberThereIsNone)
{
  LevelResult none  = level(1., 0.);
  none.measurements = {{"pressure drop", {}}};
  EXPECT_FALSE(mean_of({level(1., 2.), none}).measurements[0].value);
  const auto rows = evaluate_study({hole(), hole()}, {2., 1.});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(rows[1].result.has_failed);
  EXPECT_FALSE(rows[1].measurement.value);
}

TEST(Study, EveryLevelIsCheckedBeforehand)
{
  RunParameters parameters = study_of_time_steps();
  EXPECT_EQ(complaint(parameters), "");
  parameters.study.vary   = "filter length";
  parameters.study.values = {2. * parameters.cylinder.diameter, 1e-3};
  EXPECT_NE(complaint(parameters)
              .find("level 1, filter length 0.05, cannot run. "
                    "Coupling/filter length"),
            std::string::npos)
    << complaint(parameters);
  parameters.study.vary   = "time step";
  parameters.study.values = {2e-3, 1e-3};
  EXPECT_EQ(complaint(parameters), "");
}

TEST(Study, ACaseMustOutlastItsRamp)
{
  RunParameters parameters                = study_of_time_steps();
  parameters.sweep.superficial_velocities = {0.2, 0.4};
  // The faster of them is over after 0.3 * 0.04 / 0.4 = 0.03 s.
  parameters.cylinder.height     = 0.04;
  parameters.filling.bed_height  = 0.02;
  parameters.sweep.flow_throughs = 0.3;
  parameters.sweep.ramp_time     = 0.04;
  EXPECT_NE(complaint(parameters)
              .find("Flow/ramp time: the case of 0.4 m/s ends after "
                    "0.03 s"),
            std::string::npos)
    << complaint(parameters);
  parameters.sweep.mode = "steady";
  EXPECT_EQ(complaint(parameters), "");
  parameters.sweep.mode      = "transient";
  parameters.sweep.ramp_time = 0.;
  EXPECT_EQ(complaint(parameters), "");
}

TEST(Study, FailedLevelsAreToldOnAllRanks)
{
  namespace mpi    = dealii::Utilities::MPI;
  const bool first = mpi::this_mpi_process(MPI_COMM_WORLD) == 0;
  const auto folder =
    std::filesystem::temp_directory_path() /
    ("graupel-test-study-" +
     std::to_string(mpi::broadcast(MPI_COMM_WORLD, static_cast<int>(::getpid()))));
  std::filesystem::create_directories(folder);
  std::ostringstream said;
  Progress           progress(said, false, nullptr);

  RunParameters parameters     = study_of_time_steps();
  parameters.study.repetitions = 2;
  std::vector<std::string> directories;
  const auto run = [&](const RunParameters &own, const std::string &directory) {
    directories.push_back(std::filesystem::path(directory).filename());
    if (own.sweep.fixed_step() == 4e-3 && own.filling.seed != parameters.filling.seed)
      throw std::runtime_error("The second bed is lost.");
    return level(1., own.sweep.longest_step());
  };
  EXPECT_FALSE(run_study(parameters, run, folder.string(), progress, MPI_COMM_WORLD));
  EXPECT_EQ(directories,
            (std::vector<std::string>{"level-1",
                                      "level-1-2",
                                      "level-2",
                                      "level-2-2",
                                      "level-3",
                                      "level-3-2",
                                      "level-4",
                                      "level-4-2"}));
  EXPECT_NE(said.str().find("level 2 of 4: time step 0.004 has failed: The second bed"),
            std::string::npos)
    << said.str();

  MPI_Barrier(MPI_COMM_WORLD);
  std::ifstream            file(folder / "study.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    lines.push_back(line);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_NE(lines[0].find(",status"), std::string::npos);
  EXPECT_NE(lines[1].find(",finished"), std::string::npos);
  EXPECT_NE(lines[2].find(",pressure drop,,,,"), std::string::npos) << lines[2];
  EXPECT_NE(lines[2].find(",failed"), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);

  parameters.study.values = {8e-3, 1e-3};
  EXPECT_TRUE(run_study(parameters, run, folder.string(), progress, MPI_COMM_WORLD));
  MPI_Barrier(MPI_COMM_WORLD);
  if (first)
    std::filesystem::remove_all(folder);
}
