// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_cost_sheet_h
#define graupel_base_cost_sheet_h

#include <array>
#include <chrono>
#include <cstdint>

namespace graupel
{
  /**
   * Where the time went: wall-clock seconds of this rank by activity, and the
   * counts of steps. Cheap enough (two reads of the clock) for a section of
   * some microseconds inside a substep.
   */
  class CostSheet
  {
  public:
    enum Section
    {
      contact,
      neighbor,
      halo,
      void_fraction,
      exchange,
      fluid,
      mesh,
      output,
      n_sections
    };

    /** Adds the time from construction to destruction to one section. */
    class Scope
    {
    public:
      Scope(CostSheet &sheet, const Section section)
        : seconds(sheet.seconds[section])
        , start(std::chrono::steady_clock::now())
      {
      }

      ~Scope()
      {
        seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      }

      Scope(const Scope &)            = delete;
      Scope &operator=(const Scope &) = delete;

    private:
      double                                     &seconds;
      const std::chrono::steady_clock::time_point start;
    };

    /** Seconds of this rank in each section [s]. */
    std::array<double, n_sections> seconds{};

    /** Owned particles times substeps, of this rank. */
    std::uint64_t particle_steps = 0;
    /** Touching pairs (walls included) times substeps, of this rank. */
    std::uint64_t contact_steps = 0;
    /** Steps of the fluid. */
    std::uint64_t fluid_steps = 0;
  };

  /** Name of a section as in summary.json, e.g. "void_fraction". */
  const char *section_name(const CostSheet::Section section);
} // namespace graupel

#endif
