// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_read_numbers_h
#define graupel_base_read_numbers_h

#include <optional>
#include <string>
#include <vector>

/**
 * @file
 * The one way from text to a number and back: whatever holds numbers in a text of its own
 * (a list of sizes, a plane, a row of a table) reads them here.
 */

namespace graupel
{
  /**
   * The number that the whole of @p text is, blanks around it aside, in decimal or
   * scientific notation. Nothing for any other text, which includes an empty one,
   * "nan", "inf" and what is too large for a double.
   */
  std::optional<double> number_in(const std::string &text);

  /**
   * The number that @p text is, a part of the value of @p parameter. Throws
   * InputError(parameter) where it is none.
   */
  double read_number(const std::string &parameter, const std::string &text);

  /**
   * The numbers in @p text, a part of the value of @p parameter, with blanks between
   * them. Throws InputError(parameter) where one is none.
   */
  std::vector<double> read_numbers(const std::string &parameter, const std::string &text);

  /** @p value with so many significant digits, for a sentence; 17 lose nothing. */
  std::string text_of(const double value, const int digits = 6);
} // namespace graupel

#endif
