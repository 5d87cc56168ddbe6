// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_parameter_entries_h
#define graupel_base_parameter_entries_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace graupel
{
  /** One declared entry of a ParameterHandler, as text. */
  struct ParameterEntry
  {
    /** Sections and name, "Section/name". */
    std::string path;
    /** The sentence that explains it. */
    std::string documentation;
    /** deal.II's own description of the values that fit, "[Double 0...1 (inclusive)]". */
    std::string pattern;
  };

  /** Every entry declared in @p handler, sorted by path. */
  std::vector<ParameterEntry> parameter_entries(const dealii::ParameterHandler &handler);

  /**
   * What a pattern of deal.II's accepts, in words that follow "expected":
   * "a number", "one of a | b | c". A pattern without words of its own here is
   * returned as it is.
   */
  std::string expected_by(const std::string &pattern);

  /**
   * Paths of the entries that hold a number (real or whole, or a list of them)
   * and whose documentation does not end in a unit in brackets, as "... [m]."
   * A pure number has the unit [-].
   */
  std::vector<std::string> entries_without_unit(const dealii::ParameterHandler &handler);
} // namespace graupel

#endif
