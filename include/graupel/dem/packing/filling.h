#ifndef graupel_dem_packing_filling_h
#define graupel_dem_packing_filling_h

#include <graupel/dem/dem.h>
#include <graupel/dem/packing/random_places.h>

#include <random>

namespace graupel
{
  /** How the bed is filled. */
  struct FillingParameters
  {
    /** "rain", "packing", "volume" or "list". */
    std::string method = "rain";
    /** Number of simulated particles [-]; 0: not by number. */
    unsigned int count = 0;
    /** Mass of all particles [kg]; 0: not by mass. */
    double mass = 0.;
    /** Height of the bed [m]; 0: not by height. */
    double bed_height = 0.152;
    /** Downward speed at which particles start [m/s]. */
    double drop_speed = 1.;
    /** Time between two layers of the rain [s]; 0: as soon as there is room. */
    double interval = 0.;
    /** Particles that rain in a second [1/s]; 0: as many as there is room for. */
    double rate = 0.;
    /** Section for the method volume [m]; an upper end of 0 is the top. */
    double lower = 0., upper = 0.;
    /** CSV file of the method list. */
    std::string file;
    /** Output directory of another run, whose settled bed is taken; empty: fill. */
    std::string start_from;
    /** Start of the random numbers [-]. */
    unsigned int seed = 1;

    /** Declares the section "Filling". */
    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError for values that cannot be, alone or together. */
    void check(const Cylinder &cylinder, const DemParameters &particles) const;

  private:
    void check_amount(const Cylinder &cylinder, const DemParameters &particles) const;
  };

  /**
   * The phase that fills the column, by one of four methods:
   * - rain: in intervals a layer of spheres appears below the top, each at random
   *   where it overlaps nothing, and falls;
   * - packing: all the space above the bed is filled at once with a loose random
   *   packing that falls down on it, again and again, as fast as if it came from the
   *   top; the same bed in less time;
   * - volume: a loose random packing in a section, once;
   * - list: from a file.
   * The places are the same on any number of ranks.
   *
   * Constructing it puts the materials of packing in force.
   */
  class Filling
  {
  public:
    /** @p dem must outlive this object. Reads the file of the method list. */
    Filling(const FillingParameters &parameters, Dem &dem);

    /**
     * Goes on by about a millisecond. Returns false, doing nothing, when all
     * particles are in. Throws DemError if the column is full before that.
     * Collective.
     */
    bool step();

    /** Time since the beginning of the phase [s]. */
    double
    time() const
    {
      return elapsed;
    }

    /** How much of the particles is in [-], 0 to 1; an estimate if by height. */
    double progress() const;

    /**
     * Height that the bed would have if all particles now in the column rested
     * at the bulk density of the bed [m]. Collective.
     */
    double expected_height() const;

  private:
    unsigned int n_missing();
    void         drop_layer(const unsigned int at_most);
    void         drop_batch(const unsigned int at_most);
    void         fill_volume();
    // Speed at a height of what has rained from the top [m/s].
    double fallen_speed(const double z) const;
    // Fills a section up to a solid fraction; how many found a place.
    unsigned int fill_section(const double       lower,
                              const double       upper,
                              const unsigned int at_most,
                              const unsigned int n_tries,
                              const double       solid_fraction,
                              const bool         fallen_from_top);
    void         add_obstacles(RandomPlaces &places, const double above) const;
    double       next_random();

    const FillingParameters input;
    Dem                    &dem;
    const ParticleSource    source;
    const double            radius; // the largest
    const double            layer_interval;
    std::mt19937_64         generator;

    double       elapsed       = 0.;
    double       next_drop     = 0.;
    unsigned int barren_layers = 0;
    bool         finished      = false;
  };
} // namespace graupel

#endif
