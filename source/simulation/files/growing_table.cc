// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/simulation/files/growing_table.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Times are written with ten digits.
    constexpr double same_time = 1e-9;
  } // namespace

  GrowingTable::GrowingTable(const std::string &path)
    : path(path)
  {
  }

  void
  GrowingTable::add(const std::string &header, const std::string &row)
  {
    append_to_file(path, (has_begun ? "" : header + '\n') + row + '\n');
    has_begun = true;
  }

  void
  GrowingTable::continue_from(const double time)
  {
    std::ifstream before(path);
    if (!before)
      return;
    std::ostringstream kept;
    bool               is_header = true;
    // A line without an end is a row that was not written whole.
    for (std::string line; std::getline(before, line) && !before.eof(); is_header = false)
      if (is_header || std::strtod(line.c_str(), nullptr) <= time * (1. + same_time))
        kept << line << '\n';
    write_file(path, [&](std::ostream &file) { file << kept.str(); });
    has_begun = !kept.str().empty();
  }
} // namespace graupel
