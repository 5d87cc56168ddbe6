// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/shell_word.h>
#include <graupel/base/version.h>

#include <graupel_revision.h>

#include <ctime>
#include <sstream>
#include <unistd.h>

namespace graupel
{
  namespace
  {
    std::string
    date()
    {
      const std::time_t now = std::time(nullptr);
      char              text[64];
      std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", std::gmtime(&now));
      return text;
    }

    std::string
    host()
    {
      char name[256] = "";
      ::gethostname(name, sizeof name - 1);
      return name;
    }

    // As a shell takes it, quoted only where it must be.
    std::string
    word(const std::string &argument)
    {
      const bool is_plain =
        !argument.empty() &&
        argument.find_first_of(" \t\n'\"\\$`&;|<>*?()[]{}~#!") == std::string::npos;
      return is_plain ? argument : shell_quoted(argument);
    }
  } // namespace

  std::string
  version()
  {
    const std::string revision = GRAUPEL_REVISION;
    return GRAUPEL_VERSION + (revision.empty() ? "" : ", revision " + revision);
  }

  std::string
  opening_lines(const std::vector<std::string> &arguments, const unsigned int n_ranks)
  {
    std::ostringstream text;
    text << "graupel " << version() << ", " << date() << ", on " << host() << ", "
         << n_ranks << (n_ranks == 1 ? " rank" : " ranks") << "\ncommand:";
    for (const std::string &argument : arguments)
      text << ' ' << word(argument);
    return text.str();
  }
} // namespace graupel
