// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_packing_filling_h
#define graupel_dem_packing_filling_h

#include <graupel/dem/packing/random_insertion.h>

namespace graupel
{
  /** How the bed is filled. */
  struct FillingParameters
  {
    /** "rain", "packing", "volume", "list" or "none". */
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
    /** Number of the one type that is filled in; 0: all, by mass fractions [-]. */
    unsigned int type = 0;
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
    /**
     * Throws InputError for values that cannot be, alone or together; reads the file of
     * the method list.
     */
    void check(const Cylinder &cylinder, const DemParameters &particles) const;

    /** Particles that will be filled in; 0 where another run's bed is taken, whose file
     * says it. */
    double n_expected_particles(const Cylinder      &cylinder,
                                const DemParameters &particles) const;

    /**
     * Gives each particle of the method list to @p take. Throws InputError, with the
     * line, for what cannot be read, has no size of its type, or lies beyond one of the
     * @p vessel's walls.
     */
    void read_list(const Cylinder                                 &cylinder,
                   const DemParameters                            &particles,
                   const std::vector<Wall>                        &vessel,
                   const std::function<void(const NewParticle &)> &take) const;

  private:
    void check_method(const Cylinder &cylinder, const DemParameters &particles) const;
    void check_amount(const Cylinder &cylinder, const DemParameters &particles) const;
    void check_rate(const Cylinder       &cylinder,
                    const DemParameters  &particles,
                    const ParticleSource &source) const;
    // Volume of what is to be filled in, before there is a bed [m^3].
    double solid_volume(const Cylinder &cylinder, const ParticleSource &source) const;
  };

  /**
   * The phase that fills the column, by one of these methods:
   * - rain: in intervals a layer of spheres appears below the top, each at random
   *   where it overlaps nothing, and falls; or so many a second, whatever the layers;
   * - packing: all the space above the bed is filled at once with a loose random
   *   packing that falls down on it, again and again, as fast as if it came from the
   *   top; the same bed in less time;
   * - volume: a loose random packing in a section, once;
   * - list: from a file;
   * - none: nothing is filled in.
   * The places are the same on any number of ranks. What leaves meanwhile through an
   * open end counts as filled in.
   *
   * Constructing it puts the materials of packing in force.
   */
  class Filling
  {
  public:
    /** @p dem must outlive this object. Reads the file of the method list. */
    Filling(const FillingParameters &parameters, Dem &dem);

    /** All that filling goes on from, beside the particles. */
    struct State
    {
      RandomInsertion::State insertion;
      double                 elapsed = 0., next_drop = 0.; // [s]
      unsigned int           barren_layers = 0;
      bool                   finished      = false;
      unsigned long          n_dropped     = 0;
      // Of the watch over growth, when it began [s], and what was in and out then.
      double        watch_begin  = 0.;
      unsigned long watch_put_in = 0;
      unsigned long watch_left   = 0;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &insertion &elapsed &next_drop &barren_layers &finished &n_dropped
          &watch_begin &watch_put_in &watch_left;
      }
    };

    /** The same on every rank. */
    State state() const;

    /**
     * Goes on from @p state, with the particles that belong to it in the Dem: the same
     * bed, bit by bit, as without a stop.
     */
    void restore(const State &state);

    /**
     * Goes on by about a millisecond. Returns false, doing nothing, when all
     * particles are in. Throws DemError if the column is full before that, if there is
     * no room below the top for the rate, and if a bed to be filled up to a height
     * loses what it gains. Collective.
     */
    bool step();

    /** Time since the beginning of the phase [s]. */
    double
    time() const
    {
      return at.elapsed;
    }

    /** How much of the particles is in [-], 0 to 1; an estimate if by height. */
    double progress() const;

    /**
     * Height that the bed would have if all particles now in the column rested
     * at the bulk density of the bed [m]. Collective.
     */
    double expected_height() const;

  private:
    // Particles that ever were put in, and their mass [kg].
    unsigned long n_put_in() const;
    double        mass_put_in() const;
    unsigned int  n_missing() const;
    void          fill_at_once();
    void          fill_from_list();
    // Particles that have fallen due at the rate and are not in.
    unsigned int n_due() const;
    void         rain_by_rate();
    unsigned int drop_due(const unsigned int at_most);
    void         drop_layer(const unsigned int at_most);
    void         drop_batch(const unsigned int at_most);
    void         fill_volume();
    void         move_on(const double duration);
    void         watch_growth();
    // Speed at a height of what has rained from the top [m/s].
    double fallen_speed(const double z) const;
    // One that fills the section, with particles at the speed of the drop.
    RandomInsertion::Request request(const Section     &section,
                                     const unsigned int at_most,
                                     const double       solid_fraction) const;
    unsigned int             tries_below_top() const;

    const FillingParameters input;
    Dem                    &dem;
    RandomInsertion         insertion;
    const double            radius;       // the largest
    const double            time_to_fall; // of a layer, until the next has room [s]
    State                   at;
  };
} // namespace graupel

#endif
