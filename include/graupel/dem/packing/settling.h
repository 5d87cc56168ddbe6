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
    /** @p dem must outlive this object. Puts the materials of packing in force. */
    Settling(const SettlingParameters &parameters, Dem &dem);

    /**
     * Goes on by about one interval. Returns false, doing nothing, when the
     * bed has settled. Throws DemError if it has not after the maximum time.
     * Collective.
     */
    bool step();

    /** Time since the beginning of the phase [s]. */
    double
    time() const
    {
      return elapsed;
    }

    /** Taps so far. */
    unsigned int
    n_taps() const
    {
      return taps;
    }

    /** What is going on, for a progress line: "settling", "tapping", ... */
    const char *activity() const;

  private:
    enum class Phase
    {
      packing,
      tapping,
      relaxing,
      settled
    };

    bool at_rest();
    void leave_packing();
    void tap();
    void finish_if_too_late() const;

    const SettlingParameters input;
    Dem                     &dem;
    const BedObservables     observables;

    Phase        phase    = Phase::packing;
    double       elapsed  = 0.;
    unsigned int taps     = 0;
    double       tap_time = 0.;
    double       amplitude;
    double       void_fraction = 1.;
  };
} // namespace graupel

#endif
