#ifndef graupel_simulation_report_h
#define graupel_simulation_report_h

#include <string>

namespace graupel
{
  /**
   * Makes report.html from the files of an output directory with the script
   * scripts/report.py. Returns true on success; a failure, such as a missing
   * matplotlib, is told on standard error and loses nothing. To be called by one
   * process, outside of MPI.
   */
  bool make_report(const std::string &directory);
} // namespace graupel

#endif
