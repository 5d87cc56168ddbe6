#include <graupel/simulation/report.h>

#include <cstdlib>
#include <iostream>

namespace graupel
{
  namespace
  {
    std::string
    shell_quoted(const std::string &text)
    {
      std::string quoted = "'";
      for (const char c : text)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return quoted + "'";
    }
  } // namespace

  bool
  make_report(const std::string &directory)
  {
    // Debian's own Python: it has Debian's matplotlib, whatever else is on the PATH.
    const std::string command = "/usr/bin/python3 " +
                                shell_quoted(GRAUPEL_REPORT_SCRIPT) + " " +
                                shell_quoted(directory);
    if (std::system(command.c_str()) == 0)
      return true;
    std::cerr
      << "The report could not be made (is python3-matplotlib installed?). The results "
         "are complete; make it later with\n  "
      << command << std::endl;
    return false;
  }
} // namespace graupel
