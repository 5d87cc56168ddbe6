// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_packing_random_insertion_h
#define graupel_dem_packing_random_insertion_h

#include <graupel/dem/dem.h>
#include <graupel/dem/packing/random_places.h>

#include <functional>
#include <limits>
#include <random>
#include <string>

namespace graupel
{
  /** A part of the vessel between two heights [m]. */
  struct Section
  {
    double lower = 0., upper = 0.;

    double
    height() const
    {
      return upper - lower;
    }
  };

  /**
   * The section below the top in which particles appear, the largest of them of
   * @p radius [m]: they are at different heights so that they do not land as one raft.
   */
  Section section_below_top(const Cylinder &cylinder, const double radius);

  /**
   * Draws particles and puts them at random places of a section, where they touch
   * nothing. The places are the same on any number of ranks.
   *
   * A particle that is drawn and finds no place is the next one to be placed, so that
   * a mixture keeps its shares where large ones find less room than small ones.
   */
  class RandomInsertion
  {
  public:
    /** Distance kept between spheres and to walls, over a radius [-]. */
    static constexpr double gap = 0.05;
    /** Height of the section below the top beside that of a sphere with its gaps, in
     * diameters [-]. */
    static constexpr double zone_thickness = 0.5;

    /** What is to be put in. */
    struct Request
    {
      /** Where: bounds the spheres, not their centers. */
      Section section;
      /** At most so many particles [-]. */
      unsigned int number = std::numeric_limits<unsigned int>::max();
      /** No more once that much solid is in [m^3]. */
      double solid_volume = std::numeric_limits<double>::infinity();
      /** At most that mass [kg]. */
      double mass = std::numeric_limits<double>::infinity();
      /** Tries to find a place for a particle [-]. */
      unsigned int n_tries = 3000;
      /** Velocity of a particle that appears at this height [m/s]. */
      std::function<dealii::Tensor<1, 3>(double z)> velocity;
    };

    /** What has been put in. */
    struct Added
    {
      /** Particles, of all types and by type [-]. */
      unsigned int               number = 0;
      std::vector<unsigned long> by_type;
      /** Their mass [kg]. */
      double mass = 0.;
      /** Whether a particle that was to come found no place. */
      bool no_room = false;
    };

    /** All that the next places depend on beside the particles that are there. */
    struct State
    {
      std::string   generator;
      bool          is_drawn = false;
      unsigned char type     = 0;
      double        radius   = 0.; // [m]

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &generator &is_drawn &type &radius;
      }
    };

    /** @p dem must outlive this object; @p seed starts the random numbers. */
    RandomInsertion(const ParticleSource &source, const unsigned int seed, Dem &dem);

    /** Puts in as much as is wanted and finds room. Collective. */
    Added fill(const Request &request);

    State state() const;
    /** Goes on from @p state. */
    void restore(const State &state);

    const ParticleSource source;

  private:
    NewParticle next_particle(RandomPlaces &places);
    // Own spheres in and near the section, with their images through periodic ends.
    std::vector<NewParticle> obstacles(const Section &section) const;
    // Around these and own cells.
    std::optional<dealii::BoundingBox<3>> box_around(
      const std::vector<NewParticle> &obstacles) const;
    // What a sphere is through the ends of a periodic vessel.
    void add_images(RandomPlaces           &places,
                    const dealii::Point<3> &center,
                    const double            radius) const;

    Dem            &dem;
    std::mt19937_64 generator;
    // The next particle, if it is known already.
    bool          is_drawn = false;
    DrawnParticle drawn{};
  };
} // namespace graupel

#endif
