// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_stop_request_h
#define graupel_base_stop_request_h

#include <stdexcept>

namespace graupel
{
  /** A run that was asked to stop, and has: what its text says. */
  class Stopped : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** From now on the first of the signals SIGINT, SIGTERM and SIGUSR1 is only noted, and
   * a further one some seconds later ends the process at once. */
  void note_signals();

  /** The signal that was noted; 0 for none. */
  int noted_signal();
} // namespace graupel

#endif
