// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/cost_sheet.h>
#include <graupel/base/progress.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace graupel;

namespace
{
  // A run of 40 s by a clock that the test moves, 0.01 simulated s a second.
  struct TimedRun
  {
    explicit TimedRun(const bool rewrites)
      : progress(out, rewrites, &log, [this]() { return now; })
    {
    }

    void
    steps(const unsigned int n)
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          now += 1.;
          progress.update(0.01 * now);
        }
    }

    double             now = 0.;
    std::ostringstream out, log;
    Progress           progress;
  };
} // namespace

TEST(Progress, PlainLinesNowAndThen)
{
  TimedRun run(false);
  run.progress.start_phase("flow", {0., 0.4, "s", false});
  run.steps(25);
  const std::string expected = "flow  0.1 of 0.4 s  25 %  0.01 s/s  30 s left\n"
                               "flow  0.2 of 0.4 s  50 %  0.01 s/s  20 s left\n";
  EXPECT_EQ(run.out.str(), expected);
  EXPECT_EQ(run.log.str(), expected);
  run.progress.finish_phase("steady");
  EXPECT_EQ(run.out.str(), expected + "flow: steady; took 25 s\n");
}

// Nobody knows how much of a phase is left that may be done before its end, and what goes
// on by another measure has another speed.
TEST(Progress, ALimitIsNoAim)
{
  TimedRun run(false);
  run.progress.start_phase("flow", {0., 50., "linear systems", true});
  run.steps(10);
  run.progress.go_on({0., 0.4, "s", true});
  run.steps(10);
  EXPECT_EQ(run.out.str(),
            "flow  0.1 linear systems, at most 50 linear systems  0.01 linear systems/s\n"
            "flow  0.2 s, at most 0.4 s  0.01 s/s\n");
}

TEST(Progress, AShareOfTheWhole)
{
  TimedRun run(false);
  run.progress.start_phase("fill", {0., 1., "", false});
  run.steps(10);
  EXPECT_EQ(run.out.str(), "fill  10 %  1 min 30 s left\n");
}

TEST(Progress, TerminalLineIsRewritten)
{
  TimedRun run(true);
  run.progress.start_phase("flow", {0., 0.4, "s", false});
  run.steps(2);
  run.progress.say("remark");
  EXPECT_EQ(run.out.str(),
            "\rflow  0.01 of 0.4 s  2 %\033[K"
            "\rflow  0.02 of 0.4 s  5 %  0.01 s/s  38 s left\033[K"
            "\r\033[Kremark\n");
  EXPECT_EQ(run.log.str(), "remark\n");

  // Steps faster than the eye write nothing.
  const std::size_t written = run.out.str().size();
  run.now += 0.01;
  run.progress.update(0.0201);
  EXPECT_EQ(run.out.str().size(), written);
}

TEST(Progress, AResumedPhaseHasTheSpeedOfNow)
{
  TimedRun run(false);
  run.progress.start_phase("flow", {0., 100., "s", false});
  run.progress.update(90.);
  run.now += 10.;
  run.progress.update(91.);
  EXPECT_EQ(run.out.str(), "flow  91 of 100 s  91 %  0.1 s/s  1 min 30 s left\n");
}

TEST(Progress, OtherRanksAreSilent)
{
  Progress progress;
  progress.start_phase("flow", {});
  progress.update(0.5);
  progress.say("nothing");
  progress.finish_phase("");
}

TEST(Progress, DurationsAreSpoken)
{
  EXPECT_EQ(spoken_duration(7.6), "8 s");
  EXPECT_EQ(spoken_duration(200.), "3 min 20 s");
  EXPECT_EQ(spoken_duration(7500.), "2 h 05 min");
  EXPECT_EQ(spoken_duration(273600.), "3 d 4 h");
  EXPECT_EQ(spoken_duration(0. / 0.), "an unknown time");
}

TEST(CostSheet, ScopesAddUp)
{
  CostSheet sheet;
  for (unsigned int i = 0; i < 2; ++i)
    {
      const CostSheet::Scope scope(sheet, CostSheet::halo);
      const double           start = Progress::steady_seconds();
      while (Progress::steady_seconds() - start < 2e-3)
        {
        }
    }
  // Twice two milliseconds at least; a busy machine may make it longer.
  EXPECT_GE(sheet.seconds[CostSheet::halo], 4e-3);
  EXPECT_EQ(sheet.seconds[CostSheet::fluid], 0.);
  EXPECT_STREQ(section_name(CostSheet::contact), "contact");
  EXPECT_STREQ(section_name(CostSheet::output), "output");
}
