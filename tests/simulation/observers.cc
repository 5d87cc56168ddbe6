// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/files/may_change.h>
#include <graupel/simulation/observers/case_result.h>
#include <graupel/simulation/observers/probes.h>
#include <graupel/simulation/observers/steady_monitor.h>

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <set>

using namespace graupel;

namespace
{
  // A row whose monitors have no value but for those given by name.
  MonitorRow
  row_at(const double time, const std::map<std::string, double> &given)
  {
    std::vector<double> numbers(monitors().size(),
                                std::numeric_limits<double>::quiet_NaN());
    for (const auto &[name, value] : given)
      numbers[place_of(name, monitors())] = value;
    return {time, "flow", 1, Values::of_numbers(numbers)};
  }

  MonitorRow
  resting_row(const double time, const double pressure_drop)
  {
    return row_at(
      time,
      {{"pressure_drop", pressure_drop}, {"bed_height", 0.15}, {"bottom_force", 1.}});
  }

  std::string
  text_of(const std::string &file)
  {
    std::ifstream     stream(GRAUPEL_SOURCE_DIR "/doc/" + file);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
} // namespace

TEST(SteadyMonitor, WaitsForAWholeWindow)
{
  SteadyMonitor monitor(0.1, 1e-3, 1.);
  for (int n = 0; n < 10; ++n)
    {
      monitor.record(resting_row(0.01 * n, 100.));
      EXPECT_FALSE(monitor.is_steady()) << "after " << n + 1 << " rows";
    }
  monitor.record(resting_row(0.1, 100.));
  EXPECT_TRUE(monitor.is_steady());
}

TEST(SteadyMonitor, SeesAChangeAnywhereInTheWindow)
{
  SteadyMonitor monitor(0.1, 1e-3, 1.);
  for (int n = 0; n <= 60; ++n)
    {
      // A step of 1 % at t = 0.3 s: not steady until the window has passed it.
      monitor.record(resting_row(0.01 * n, n < 30 ? 100. : 101.));
      if (n >= 30 && n < 39)
        {
          EXPECT_FALSE(monitor.is_steady()) << n;
        }
      else if (n > 40)
        {
          EXPECT_TRUE(monitor.is_steady()) << n;
        }
    }
}

TEST(SteadyMonitor, DoesNotWaitForWhatHasNoValue)
{
  SteadyMonitor monitor(0.1, 1e-3, 0.);
  for (int n = 0; n <= 20; ++n)
    monitor.record(row_at(0.01 * n, {{"pressure_drop", 3.}}));
  EXPECT_TRUE(monitor.is_steady());
}

TEST(MeanSince, AveragesTheLastRowsThatHaveAValue)
{
  std::vector<MonitorRow> rows;
  for (int n = 1; n <= 4; ++n)
    rows.push_back(resting_row(n, 10. * n));
  rows.push_back(row_at(5., {}));
  EXPECT_DOUBLE_EQ(*mean_since(rows, 2.5, "pressure_drop"), 35.);
  EXPECT_FALSE(mean_since(rows, 5., "pressure_drop"));
  EXPECT_FALSE(mean_since(rows, 0., "fluid_force"));
}

// A value that is not there is an empty cell, and comes back from a checkpoint as such.
TEST(Quantities, WriteWhatThereIsAndNothingElse)
{
  EXPECT_EQ(cell_text({}, "m"), "");
  EXPECT_EQ(cell_text(std::numeric_limits<double>::infinity(), "m"), "");
  EXPECT_EQ(cell_text(0.125, "m"), "0.125");
  EXPECT_EQ(cell_text(1., "flag"), "true");
  EXPECT_EQ(cell_text(0., "flag"), "false");
  const MonitorRow row  = row_at(1., {{"weight", 2.}});
  const Values     back = Values::of_numbers(row.values.numbers());
  EXPECT_EQ(csv_row(monitors(), back), csv_row(monitors(), row.values));
  EXPECT_EQ(told_text("drop", 12.3456, 1., "Pa"), "drop 12.35 Pa");
  EXPECT_EQ(told_text("drop", {}, 1., "Pa"), "");
  EXPECT_EQ(told_text("force", -0., 1., "N"), "force 0 N");
}

TEST(Quantities, HaveNamesOfTheirOwn)
{
  std::set<std::string> names;
  for (const auto &quantity : monitors())
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
  names.clear();
  for (const auto &quantity : case_quantities())
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
  names.clear();
  for (const auto &quantity : bin_quantities())
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
}

// The documentation is what graupel --print-columns prints.
TEST(Quantities, AreDocumentedAsTheyAre)
{
  const std::string columns = text_of("output-files.md");
  EXPECT_NE(columns.find(documentation(monitors())), std::string::npos);
  EXPECT_NE(columns.find(documentation(case_quantities())), std::string::npos);
  EXPECT_NE(columns.find(documentation(bin_quantities())), std::string::npos);
  EXPECT_NE(text_of("going-on.md").find(table_of_changes()), std::string::npos);
}

TEST(Probes, AreReadByName)
{
  const auto points = read_probes("low: 0 0 0.01 | high: 1e-3 0 0.15");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1].name, "high");
  EXPECT_DOUBLE_EQ(points[1].place[2], 0.15);
  for (const char *bad :
       {"0 0 0", "a: 0 0", "a: 0 0 0 0", ": 0 0 0", "a: 0 0 0 | a: 0 0 1"})
    EXPECT_THROW(read_probes(bad), InputError) << bad;
}

TEST(GoingOn, RefusesByNameWhatMayNotChange)
{
  const ParameterTexts there{{"Particles/diameter", "2e-3"},
                             {"Fluid/density", "1.2"},
                             {"Flow/time step", "1e-3"},
                             {"Geometry/diameter", "0.012"}};
  ParameterTexts       here  = there;
  here["Particles/diameter"] = "0.002";
  EXPECT_TRUE(check_changes(here, there, Standing::within_phase, "x").empty());
  here["Flow/time step"] = "5e-4";
  EXPECT_EQ(check_changes(here, there, Standing::within_phase, "x").size(), 1u);
  here["Fluid/density"] = "998";
  EXPECT_EQ(check_changes(here, there, Standing::settled_bed, "x").size(), 2u);
  for (const Standing standing : {Standing::between_phases, Standing::within_phase})
    try
      {
        check_changes(here, there, standing, "x");
        FAIL() << "another fluid within a run";
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.parameter, "Fluid/density");
      }
}
