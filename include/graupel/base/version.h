// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_version_h
#define graupel_base_version_h

#include <string>
#include <vector>

namespace graupel
{
  /** The version of this program and, where it was built from a repository, the revision:
   * "0.5.0, revision 1a2b3c4", with "and changes" where files differed from it. */
  std::string version();

  /**
   * What a log opens with: version, date and time (UTC), host and number of ranks, and
   * the command line. Two lines. The @p arguments begin with the program. Of one rank.
   */
  std::string opening_lines(const std::vector<std::string> &arguments,
                            const unsigned int              n_ranks);
} // namespace graupel

#endif
