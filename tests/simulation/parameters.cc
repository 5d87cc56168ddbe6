// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameter_entries.h>
#include <graupel/base/parameters.h>
#include <graupel/simulation/parameters/run_size.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

using namespace graupel;

namespace
{
  // The explanation that a user gets for the example with one value changed, or
  // "accepted".
  std::string
  verdict_on(const std::string &assignment)
  {
    RunParameters            parameters;
    dealii::ParameterHandler prm;
    parameters.declare(prm);
    ParameterFile file(prm);
    try
      {
        file.read(GRAUPEL_SOURCE_DIR "/prm/packed-bed/ricklick-2x.prm");
        file.set(assignment);
        parameters.check();
      }
    catch (const InputError &error)
      {
        return file.explain(error);
      }
    return "accepted";
  }

  // Of the bubbling bed with changes, in diameters of its spheres.
  double
  filter_deviation(const std::vector<std::string> &assignments)
  {
    RunParameters            parameters;
    dealii::ParameterHandler prm;
    parameters.declare(prm);
    ParameterFile file(prm);
    file.read(GRAUPEL_SOURCE_DIR "/prm/fluidised-bed/bubbling.prm");
    for (const std::string &assignment : assignments)
      file.set(assignment);
    return std::sqrt(2.) * parameters.filter_length() / 1.2e-3;
  }
} // namespace

// Ergun's onset is at 0.358 m/s there.
TEST(Parameters, AutoMakesTheFilterTwoDiametersWideWhereBubblesOfAGasMove)
{
  EXPECT_NEAR(filter_deviation({}), 2., 1e-12);
  EXPECT_NEAR(filter_deviation({"Flow/superficial velocities=0.2, 0.4"}), 2., 1e-12);
  EXPECT_NEAR(filter_deviation({"Flow/superficial velocities=0.2, 0.25"}), 1., 1e-12);
  EXPECT_NEAR(filter_deviation({"Flow/mode=steady"}), 1., 1e-12);
  EXPECT_NEAR(filter_deviation({"Flow/mode=automatic"}), 1., 1e-12);
  EXPECT_NEAR(filter_deviation({"Fluid/density=900"}), 1., 1e-12);
  // Slugs: two would be more than a quarter of the vessel.
  EXPECT_NEAR(filter_deviation({"Geometry/diameter=9.5e-3"}), 1., 1e-12);
  EXPECT_NEAR(filter_deviation({"Coupling/filter length=1.2e-3"}), std::sqrt(2.), 1e-12);
}

TEST(Parameters, EveryNumberHasAUnit)
{
  RunParameters            parameters;
  dealii::ParameterHandler prm;
  parameters.declare(prm);
  const auto unitless = entries_without_unit(prm);
  EXPECT_TRUE(unitless.empty()) << unitless.front();
}

TEST(Parameters, EveryExampleIsAccepted)
{
  unsigned int n_examples = 0;
  for (const auto &entry :
       std::filesystem::recursive_directory_iterator(GRAUPEL_SOURCE_DIR "/prm"))
    if (entry.path().extension() == ".prm")
      {
        RunParameters            parameters;
        dealii::ParameterHandler prm;
        parameters.declare(prm);
        ParameterFile file(prm);
        EXPECT_NO_THROW({
          file.read(entry.path().string());
          parameters.check();
        }) << entry.path();
        EXPECT_GT(parameters.describe().size(), 100u);
        ++n_examples;
      }
  EXPECT_GE(n_examples, 2u);
}

TEST(Parameters, DefaultsAreAccepted)
{
  EXPECT_NO_THROW(RunParameters().check());
}

// Each of these cannot be; the message must name the parameter and the value.
class Impossible : public testing::TestWithParam<std::string>
{
};

TEST_P(Impossible, ValueIsRefusedByName)
{
  const std::string assignment = GetParam();
  const auto        equals     = assignment.find('=');
  const std::string answer     = verdict_on(assignment);
  EXPECT_NE(answer, "accepted") << assignment;
  EXPECT_NE(answer.find(assignment.substr(0, equals)), std::string::npos) << answer;
  EXPECT_NE(answer.find(assignment.substr(equals + 1)), std::string::npos) << answer;
}

INSTANTIATE_TEST_SUITE_P(Values,
                         Impossible,
                         testing::Values("Geometry/diameter=-0.025",

                                         "Geometry/height=0",
                                         "Geometry/height=nan",
                                         "Particles/diameter=0",
                                         "Particles/scale=0.5",

                                         "Particles/density=-1",
                                         "Contact/substep=1e-3",
                                         "Contact/particle friction=-0.1",
                                         "Contact/particle restitution=1.5",
                                         "Filling/count=100000000",
                                         "Mesh/cell size=0",
                                         "Mesh/cell height=-1",
                                         "Fluid/viscosity=0",
                                         "Coupling/filter length=-1e-3",
                                         "Coupling/filter length=short",
                                         "Coupling/filter length=1",
                                         "Coupling/drag law=erggun",
                                         "Coupling/scaling=exakt",
                                         "Flow/time step=0",
                                         "Flow/superficial velocities=0.3, -0.4",
                                         "Flow/flow-throughs=0",
                                         "Flow solver/linear tolerance=0",
                                         "Walls/top=periodic",
                                         "Walls/planes=1 2 3",
                                         "Contact/pairs=1-9 friction 0.1",
                                         "Output/annuli=1"));

TEST(Parameters, ParticlesMustFitIntoTheVessel)
{
  for (const std::string assignment : {"Geometry/diameter=0.003", "Particles/scale=20"})
    {
      const std::string answer = verdict_on(assignment);
      EXPECT_NE(answer.find("no bed fits"), std::string::npos) << answer;
    }
}

TEST(Parameters, UnknownNamesProposeTheNearest)
{
  const std::string answer = verdict_on("Geometri/diameter=0.1");
  EXPECT_NE(answer.find("Geometry/diameter"), std::string::npos) << answer;
}

TEST(Parameters, ExpressionsAreCheckedBeforeTheRun)
{
  RunParameters parameters;
  parameters.drag.scaling = "expression";
  for (const std::string formula : {"s*(Cd", "-Cd", "sqrt(-1)*Cd", "Cd + nothing"})
    {
      parameters.drag.expression = formula;
      EXPECT_THROW(parameters.check(), InputError) << formula;
    }
  parameters.drag.expression = "s*s*Cd";
  EXPECT_NO_THROW(parameters.check());
}

namespace
{
  RunParameters
  example(const std::string &name, const std::vector<std::string> &assignments)
  {
    RunParameters            parameters;
    dealii::ParameterHandler prm;
    parameters.declare(prm);
    ParameterFile file(prm);
    file.read(GRAUPEL_SOURCE_DIR "/prm/" + name);
    for (const std::string &assignment : assignments)
      file.set(assignment);
    parameters.check();
    return parameters;
  }
} // namespace

TEST(RunSize, CellsAreThoseOfTheMesh)
{
  for (const char *name : {"packed-bed/ricklick-2x.prm", "vessels/side-inlet.prm"})
    for (const char *cell_size : {"4e-3", "2.3e-3", "1.6e-3"})
      {
        const RunParameters parameters =
          example(name, {std::string("Mesh/cell size=") + cell_size});
        const VesselMesh mesh(parameters.cylinder, parameters.mesh, MPI_COMM_WORLD);
        EXPECT_EQ(expected_size(parameters).cells,
                  mesh.triangulation().n_global_active_cells())
          << name << ' ' << cell_size;
      }
}

TEST(RunSize, ParticlesAndStepsAreThoseThatAreAskedFor)
{
  const RunSize size = expected_size(example("packed-bed/ricklick-2x.prm",
                                             {"Filling/count=1234",
                                              "Flow/mode=transient",
                                              "Flow/time step=1e-3",
                                              "Flow/duration=0.5",
                                              "Flow/superficial velocities=0.3, 0.4"}));
  EXPECT_EQ(size.particles, 1234.);
  EXPECT_NEAR(size.fluid_steps, 1000., 1e-6);
  const RunSize none = expected_size(
    example("packed-bed/ricklick-2x.prm", {"Filling/method=none", "Filling/count=0"}));
  EXPECT_EQ(none.particles, 0.);
  EXPECT_EQ(none.substeps, 0.);
}

TEST(RunSize, WhatNoMachineHasIsRefusedByName)
{
  const auto refusal = [](const std::string &assignment) -> std::string {
    try
      {
        check_size(example("packed-bed/ricklick-2x.prm", {assignment}), MPI_COMM_WORLD);
      }
    catch (const InputError &error)
      {
        return error.parameter + ": " + error.what();
      }
    return "accepted";
  };
  EXPECT_EQ(refusal("Filling/seed=2"), "accepted");
  for (const char *assignment : {"Contact/substep=5e-324",
                                 "Contact/substep=1e-12",
                                 "Flow/time step=1e-13",
                                 "Output/interval=1e-9",
                                 "Mesh/cell size=2.6e-5"})
    {
      const std::string name(assignment, std::strchr(assignment, '='));
      EXPECT_EQ(refusal(assignment).substr(0, name.size() + 2), name + ": ")
        << refusal(assignment);
    }
}
