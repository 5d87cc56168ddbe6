// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/report.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

using namespace graupel;

// A script that is not there, as after the source tree has moved, and one that fails:
// both are told on standard error and in log.txt, with the command that makes the report
// later.
TEST(Report, FailureIsToldWithTheWayOut)
{
  // As any rank of several, each in a folder of its own.
  const auto directory = std::filesystem::path(testing::TempDir()) /
                         ("graupel-report-test-" + std::to_string(::getpid()));
  std::filesystem::create_directories(directory);
  const auto failing = directory / "failing.py";
  std::ofstream(failing) << "import sys\nsys.exit(1)\n";
  for (const auto &[script, word] :
       {std::make_pair(directory / "moved.py", "is not there"),
        std::make_pair(failing, "has failed")})
    {
      std::filesystem::remove(directory / "log.txt");
      testing::internal::CaptureStderr();
      EXPECT_FALSE(make_report(directory.string(), script.string()));
      const std::string  said = testing::internal::GetCapturedStderr();
      std::ostringstream log;
      log << std::ifstream(directory / "log.txt").rdbuf();
      for (const std::string &text : {said, log.str()})
        {
          EXPECT_NE(text.find(word), std::string::npos) << text;
          EXPECT_NE(text.find("/usr/bin/python3 '" + script.string() + "' '"),
                    std::string::npos)
            << text;
        }
    }
  std::filesystem::remove_all(directory);
}
