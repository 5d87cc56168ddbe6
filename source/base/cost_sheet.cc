// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/cost_sheet.h>

namespace graupel
{
  const char *
  section_name(const CostSheet::Section section)
  {
    static constexpr std::array<const char *, CostSheet::n_sections> names{
      {"contact",
       "neighbor",
       "halo",
       "void_fraction",
       "exchange",
       "fluid",
       "mesh",
       "output"}};
    return names[section];
  }
} // namespace graupel
