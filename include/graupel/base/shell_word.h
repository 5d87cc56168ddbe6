// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_shell_word_h
#define graupel_base_shell_word_h

#include <string>

namespace graupel
{
  /** @p text as one word of a shell, in single quotes whatever it holds. */
  inline std::string
  shell_quoted(const std::string &text)
  {
    std::string quoted = "'";
    for (const char c : text)
      quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
  }
} // namespace graupel

#endif
