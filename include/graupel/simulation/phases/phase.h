// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_phases_phase_h
#define graupel_simulation_phases_phase_h

#include <graupel/simulation/observers/monitors.h>

#include <string>

namespace graupel
{
  /**
   * A part of a run: filling, settling, a flow case. It begins, goes on step by step, and
   * ends; between two steps it can be saved, and resumed by another run.
   */
  class Phase
  {
  public:
    virtual ~Phase() = default;

    /** The word in the column phase of monitors.csv. */
    virtual const char *kind() const = 0;

    /** Starts the phase, unless it is resumed. Collective, as all that follows. */
    virtual void
    begin()
    {
    }

    /** Goes on by a piece, and the run's clock with it. False when it has ended. */
    virtual bool step() = 0;

    /** What there is to do when the phase has ended. */
    virtual void
    end()
    {
    }

    /** The run after a step, as the monitors see it. */
    virtual Moment moment() const = 0;

    /** Takes note of the row that a step gave. */
    virtual void
    note(const MonitorRow &)
    {
    }

    /** Number of the flow case from 1; 0 for others. */
    virtual unsigned int
    flow_case() const
    {
      return 0;
    }

    /** Where the phase is, beside particles and fluid, for resume(). */
    virtual std::string save() const = 0;

    /** Takes the place of begin(): goes on where save() was. */
    virtual void resume(const std::string &saved) = 0;
  };
} // namespace graupel

#endif
