// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_files_may_change_h
#define graupel_simulation_files_may_change_h

#include <map>
#include <string>
#include <vector>

namespace graupel
{
  /** Values by the paths of their parameters. */
  using ParameterTexts = std::map<std::string, std::string>;

  /** Where an earlier run stands that is gone on from. */
  enum class Standing
  {
    /** A settled bed, for another run (Filling/start from). */
    settled_bed,
    /** A checkpoint between two phases (--resume). */
    between_phases,
    /** A checkpoint within a phase (--resume). */
    within_phase
  };

  /**
   * What a run that goes on from @p there may have otherwise: throws InputError naming
   * the first parameter of @p here that differs and may not; gives a sentence for each
   * other difference. @p where names the file of the earlier run. The table is that of
   * doc/going-on.md.
   */
  std::vector<std::string> check_changes(const ParameterTexts &here,
                                         const ParameterTexts &there,
                                         const Standing        standing,
                                         const std::string    &where);

  /** The table of doc/going-on.md, as Markdown. */
  std::string table_of_changes();
} // namespace graupel

#endif
