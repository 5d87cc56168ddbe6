// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_growing_table_h
#define graupel_simulation_files_growing_table_h

#include <string>

namespace graupel
{
  /**
   * A CSV file that gains a row from time to time; its first column is a time. It is made
   * when its first row comes. Both functions throw FileError where it cannot be written.
   */
  class GrowingTable
  {
  public:
    explicit GrowingTable(const std::string &path);

    /** Adds @p row, whole or not at all, after @p header where the file is new. */
    void add(const std::string &header, const std::string &row);

    /** Goes on behind the rows of an earlier run up to @p time [s]; later ones are
     * dropped. */
    void continue_from(const double time);

  private:
    const std::string path;
    bool              has_begun = false;
  };
} // namespace graupel

#endif
