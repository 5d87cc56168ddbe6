// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_packing_feed_h
#define graupel_dem_packing_feed_h

#include <graupel/dem/packing/random_insertion.h>

#include <array>

namespace graupel
{
  /** One way by which particles come in while the fluid flows. */
  struct FeedParameters
  {
    /** Particles in a second [1/s]; 0: none, or by mass. */
    double rate = 0.;
    /** Mass in a second [kg/s]; 0: none, or by number. */
    double mass_rate = 0.;
    /** Number of the one type that comes; 0: all, by mass fractions [-]. */
    unsigned int type = 0;
    /** When it begins and ends on the clock of the flow [s]; an end of 0: never. */
    double from = 0., until = 0.;
    /** Section in which the particles appear [m]; both 0: below the top. */
    double lower = 0., upper = 0.;
    /** Velocity at which they appear [m/s]. */
    dealii::Tensor<1, 3> velocity{{0., 0., -1.}};
    /** Particles that may wait for a place before the run stops [-]. */
    unsigned int most_owed = 100;
    /** Start of the random numbers [-]. */
    unsigned int seed = 1;

    /** Declares the section @p name, "Feed" or "Feed 2". */
    void declare(dealii::ParameterHandler &prm, const std::string &name);
    /** Throws InputError for values that cannot be, alone or together. */
    void check(const Cylinder      &cylinder,
               const DemParameters &particles,
               const std::string   &name) const;

    /** Whether anything comes. */
    bool
    is_wanted() const
    {
      return rate > 0. || mass_rate > 0.;
    }
  };

  /** The sections "Feed", "Feed 2" and "Feed 3". */
  struct FeedsParameters
  {
    std::array<FeedParameters, 3> feeds;

    void declare(dealii::ParameterHandler &prm);
    void check(const Cylinder &cylinder, const DemParameters &particles) const;

    /** "Feed", "Feed 2", ... */
    static std::string name(const unsigned int number);

    /** Whether any of them brings anything. */
    bool is_wanted() const;
  };

  /**
   * Particles that come in at a rate, each at a random place of a section where it
   * touches nothing. After any time the number is that of the rate, within one
   * particle: what finds no place is owed and comes in as soon as there is one. The
   * places are the same on any number of ranks.
   */
  class Feed
  {
  public:
    /** All that the feed goes on from. */
    struct State
    {
      RandomInsertion::State     insertion;
      std::vector<unsigned long> inserted;  // by type
      double                     mass = 0.; // [kg]
      double                     owed = 0.; // [-]

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &insertion &inserted &mass &owed;
      }
    };

    /** @p dem must outlive this object. @p name of the section, for messages. */
    Feed(const FeedParameters &parameters,
         Dem                  &dem,
         const std::string    &name = FeedsParameters::name(0));

    /**
     * To be called before the particles move from @p t to @p t + @p dt [s]: puts in what
     * falls due until then. Rows of the Dem stay, new ones come behind them. Returns how
     * many came in. Throws DemError if too many wait for a place. Collective.
     */
    unsigned int advance(const double t, const double dt);

    /** Particles put in so far, by type. */
    const std::vector<unsigned long> &
    inserted() const
    {
      return at.inserted;
    }

    /** Particles put in so far, of all types. */
    unsigned long n_inserted() const;

    /** Their mass [kg]. */
    double
    inserted_mass() const
    {
      return at.mass;
    }

    /** Particles that have fallen due and found no place yet [-]. */
    double
    owed() const
    {
      return at.owed;
    }

    /** The same on every rank. */
    State state() const;
    /** Goes on from @p state, with the particles that belong to it in the Dem. */
    void restore(const State &state);

  private:
    const FeedParameters input;
    const std::string    name;
    Dem                 &dem;
    RandomInsertion      insertion;
    const Section        section;
    State                at;
  };

  /** All feeds of a run. */
  class Feeds
  {
  public:
    using State = std::vector<Feed::State>;

    Feeds(const FeedsParameters &parameters, Dem &dem);

    /** As Feed::advance(), for all. */
    unsigned int advance(const double t, const double dt);

    /** Particles put in so far, by type. */
    std::vector<unsigned long> inserted() const;
    /** Their mass [kg]. */
    double inserted_mass() const;
    /** Particles that wait for a place [-]. */
    double owed() const;

    State state() const;
    void  restore(const State &state);

  private:
    const unsigned int n_types;
    std::vector<Feed>  feeds;
  };
} // namespace graupel

#endif
