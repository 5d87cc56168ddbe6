// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/progress.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <ostream>

#include <unistd.h>

namespace graupel
{
  namespace
  {
    constexpr double seconds_between_rewrites = 0.2;
    constexpr double seconds_between_lines    = 10.;

    template <typename... Numbers>
    std::string
    formatted(const char *const format, const Numbers... numbers)
    {
      std::array<char, 128> buffer;
      std::snprintf(buffer.data(), buffer.size(), format, numbers...);
      return buffer.data();
    }
  } // namespace

  Progress::Progress(std::ostream &out,
                     const bool    rewrites,
                     std::ostream *log,
                     const Clock  &clock)
    : out(&out)
    , log(log)
    , rewrites(rewrites)
    , clock(clock)
  {
  }

  double
  Progress::steady_seconds()
  {
    return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  void
  Progress::start_phase(const std::string &name, const Way &way)
  {
    phase = name;
    go_on(way);
    wall_at_begin = clock();
    last_rewrite  = wall_at_begin;
    last_plain    = wall_at_begin;
  }

  void
  Progress::go_on(const Way &way)
  {
    this->way = way;
    time      = way.begin;
    has_moved = false;
  }

  void
  Progress::update(const double time)
  {
    if (out == nullptr)
      return;
    this->time       = time;
    const double now = clock();
    if (!has_moved)
      {
        has_moved  = true;
        first_time = time;
        first_wall = now;
      }
    if (rewrites && now - last_rewrite >= seconds_between_rewrites)
      {
        // The escape clears what a longer line left behind.
        *out << '\r' << line() << "\033[K" << std::flush;
        last_rewrite = now;
        line_open    = true;
      }
    if (now - last_plain >= seconds_between_lines)
      {
        if (!rewrites)
          write_plain(*out);
        if (log != nullptr)
          write_plain(*log);
        last_plain = now;
      }
  }

  void
  Progress::finish_phase(const std::string &done)
  {
    say(phase + ": " + done + "; took " + spoken_duration(clock() - wall_at_begin));
  }

  void
  Progress::say(const std::string &line)
  {
    if (out == nullptr)
      return;
    if (line_open)
      *out << "\r\033[K";
    line_open = false;
    *out << line << std::endl;
    if (log != nullptr)
      *log << line << std::endl;
  }

  std::string
  Progress::line() const
  {
    const double wall = clock() - first_wall;
    const char  *unit = way.unit.c_str();
    std::string  text = phase;
    if (way.end_is_limit)
      text += formatted("  %.4g %s, at most %.4g %s", time, unit, way.end, unit);
    else if (!way.unit.empty())
      text += formatted("  %.4g of %.4g %s", time, way.end, unit);
    if (!way.end_is_limit && way.end > way.begin)
      text += formatted("  %.0f %%", 100. * (time - way.begin) / (way.end - way.begin));
    if (!has_moved || !(wall > 0.) || !(time > first_time))
      return text;
    const double rate = (time - first_time) / wall;
    if (!way.unit.empty())
      text += formatted("  %.3g %s/s", rate, unit);
    if (!way.end_is_limit)
      text += "  " + spoken_duration(std::max(0., way.end - time) / rate) + " left";
    return text;
  }

  void
  Progress::write_plain(std::ostream &stream) const
  {
    stream << line() << std::endl;
  }

  bool
  stdout_is_terminal()
  {
    if (!isatty(STDOUT_FILENO))
      return false;
    if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr)
      return true;

    // No answer means mpirun runs on another machine: plain lines do no harm.
    std::error_code   unknown;
    const std::string target = std::filesystem::read_symlink(
      "/proc/" + std::to_string(getppid()) + "/fd/1", unknown);
    return target.rfind("/dev/pts/", 0) == 0 || target.rfind("/dev/tty", 0) == 0;
  }

  std::string
  spoken_duration(const double seconds)
  {
    if (!(seconds >= 0. && seconds < 1e9))
      return "an unknown time";
    const long whole = std::lround(seconds);
    if (whole < 60)
      return formatted("%ld s", whole);
    if (whole < 3600)
      return formatted("%ld min %02ld s", whole / 60, whole % 60);
    if (whole < 86400)
      return formatted("%ld h %02ld min", whole / 3600, whole % 3600 / 60);
    return formatted("%ld d %ld h", whole / 86400, whole % 86400 / 3600);
  }
} // namespace graupel
