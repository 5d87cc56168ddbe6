// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/base/shell_word.h>
#include <graupel/simulation/report.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace graupel
{
  namespace
  {
    // Says it where the user looks, now or later.
    void
    tell(const std::string &directory, const std::string &message)
    {
      std::cerr << message << std::endl;
      append_to_file(directory + "/log.txt", message + "\n");
    }
  } // namespace

  bool
  make_report(const std::string &directory, const std::string &script)
  {
    // Debian's own Python: it has Debian's matplotlib, whatever else is on the PATH.
    const std::string python = "/usr/bin/python3";
    const std::string command =
      python + " " + shell_quoted(script) + " " + shell_quoted(directory);
    std::string reason;
    for (const std::string &needed : {python, script})
      if (reason.empty() && !std::filesystem::exists(needed))
        reason = needed + " is not there";
    if (reason.empty())
      {
        std::cout.flush();
        if (std::system(command.c_str()) == 0)
          return true;
        reason = "its script has failed, as it says above; on Debian it needs "
                 "apt-get install python3-matplotlib";
      }
    tell(directory,
         "No report was made: " + reason +
           ".\nThe results are complete. Make the report later with\n  " + command +
           "\nor graupel-report of another copy of Graupel; Output/report = false goes "
           "without.");
    return false;
  }

  std::string
  report_script()
  {
    const auto program = std::filesystem::read_symlink("/proc/self/exe");
    return program.parent_path() / "graupel-report";
  }
} // namespace graupel
