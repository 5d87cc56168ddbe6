// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/stop_request.h>

#include <csignal>
#include <ctime>

#include <unistd.h>

namespace graupel
{
  namespace
  {
    // What a shell reports of a process that a signal has ended.
    constexpr int ended_by_signal = 128;

    // Signals within so many seconds are one request: mpirun and queues may send several.
    constexpr std::time_t one_request = 2;

    volatile std::sig_atomic_t noted      = 0;
    volatile std::time_t       noted_time = 0;

    extern "C" void
    note(const int signal)
    {
      const std::time_t now = std::time(nullptr);
      if (noted == 0)
        {
          noted_time = now;
          noted      = signal;
        }
      else if (now - noted_time >= one_request)
        _exit(ended_by_signal + signal);
    }
  } // namespace

  void
  note_signals()
  {
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1})
      std::signal(signal, note);
  }

  int
  noted_signal()
  {
    return noted;
  }
} // namespace graupel
