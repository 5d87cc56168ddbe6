// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_packing_settling_h
#define graupel_dem_packing_settling_h

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/dem.h>

namespace graupel
{
  /** When a bed counts as settled, and how dense it shall be. */
  struct SettlingParameters
  {
    /** Mean kinetic energy of the centers per particle below which the bed is at rest
     * [J]. */
    double kinetic_energy = 1e-12;
    /** Speed of the fastest particle below which the bed is at rest [m/s]. */
    double speed = 2e-3;
    /** Time between two looks at the bed [s]. */
    double interval = 5e-3;
    /** Simulated time after which settling is given up [s]. */
    double maximum_time = 10.;
    /** Mean void fraction to reach by tapping [-]; 0: take what comes. */
    double target_void_fraction = 0.;

    /** Declares the section "Settling". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;

    /** Whether the bed is at rest. Collective. */
    bool is_met_by(const Dem &dem) const;
  };

  /**
   * The phase after filling: waits until the bed is at rest; if it is looser
   * than the target, taps it (shakes gravity for two periods, ever harder or
   * softer as the last tap taught) and waits again; then puts the materials of
   * the flow in force and waits once more.
   */
  class Settling
  {
  public:
    /** All that settling goes on from, beside the particles. */
    struct State
    {
      enum class Phase
      {
        packing,
        tapping,
        relaxing,
        settled
      };

      Phase        phase   = Phase::packing;
      double       elapsed = 0.; // [s]
      unsigned int taps    = 0;
      // Since the last tap began [s], its amplitude over gravity [-], and the mean void
      // fraction before it [-].
      double tap_time      = 0.;
      double amplitude     = 0.;
      double void_fraction = 1.;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &phase &elapsed &taps &tap_time &amplitude &void_fraction;
      }
    };

    /** @p dem must outlive this object. Puts the materials of packing in force. */
    Settling(const SettlingParameters &parameters, Dem &dem);

    /** The same on every rank. */
    const State &
    state() const
    {
      return at;
    }

    /**
     * Goes on from @p state, with the particles that belong to it in the Dem and the
     * materials of its phase: the same bed, bit by bit, as without a stop.
     */
    void restore(const State &state);

    /**
     * Goes on by about one interval. Returns false, doing nothing, when the
     * bed has settled, or if there are no particles. Throws DemError if it has not after
     * the maximum time. Collective.
     */
    bool step();

    /** Time since the beginning of the phase [s]. */
    double
    time() const
    {
      return at.elapsed;
    }

    /** Taps so far. */
    unsigned int
    n_taps() const
    {
      return at.taps;
    }

    /** What is going on, for a progress line: "settling", "tapping", ... */
    const char *activity() const;

  private:
    using Phase = State::Phase;

    bool at_rest();
    void leave_packing();
    void end();
    void tap();
    void finish_if_too_late() const;

    const SettlingParameters input;
    Dem                     &dem;
    const BedObservables     observables;

    State at;
  };
} // namespace graupel

#endif
