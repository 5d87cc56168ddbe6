#include <graupel/base/stop_request.h>

#include <csignal>

#include <unistd.h>

namespace graupel
{
  namespace
  {
    // What a shell reports of a process that a signal has ended.
    constexpr int ended_by_signal = 128;

    volatile std::sig_atomic_t noted = 0;

    extern "C" void
    note(const int signal)
    {
      if (noted != 0)
        _exit(ended_by_signal + signal);
      noted = signal;
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
