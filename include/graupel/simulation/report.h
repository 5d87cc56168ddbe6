// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_report_h
#define graupel_simulation_report_h

#include <string>

namespace graupel
{
  /**
   * Makes report.html from the files of an output directory with the Python @p script.
   * Returns whether it is there now. A failure, such as a missing matplotlib, loses
   * nothing; it is told with the way out on standard error and in log.txt. To be called
   * by one process, outside of MPI.
   */
  bool make_report(const std::string &directory, const std::string &script);

  /**
   * Where the program looks for that script: graupel-report beside itself, in the folder
   * of the build as where it is installed. It need not be there.
   */
  std::string report_script();
} // namespace graupel

#endif
