// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_particles_halo_h
#define graupel_dem_particles_halo_h

#include <graupel/base/rank_messages.h>
#include <graupel/dem/particles/particle_arrays.h>
#include <graupel/dem/particles/subdomains.h>

#include <string>
#include <vector>

namespace graupel
{
  /**
   * Copies of other ranks' particles near this rank's own (ghosts), chosen by distance
   * and not by cells: on a locally refined mesh one layer of ghost cells can be thinner
   * than a particle. On one rank without periodic ends nothing is done.
   *
   * A particle goes to every rank whose cells touch its bin or one next to it (see
   * Subdomains). Which those are is the sender's choice alone, made anew by select() when
   * its particles have gone far; the receiver learns it from the next message. So ranks
   * wait for their neighbours only, and with every exchange() each tells its neighbours
   * how fast its particles are and whether it has met with an error.
   */
  class Halo
  {
  public:
    /** @p subdomains must outlive the halo; @p period is that of its ends. */
    Halo(const Subdomains &subdomains, const Period &period, MPI_Comm communicator);
    ~Halo();

    Halo(const Halo &)            = delete;
    Halo &operator=(const Halo &) = delete;

    /** Whether there can be ghosts at all. */
    bool
    is_needed() const
    {
      return subdomains.is_needed();
    }

    /** Forgets all neighbours and takes those of subdomains that have changed. */
    void reset();

    /**
     * Chooses anew which own rows go where, for the next exchange(). Those that have left
     * the own bins and are to be handed over go into leaving(). Returns the problem with
     * a particle that is nowhere near own cells, or nothing.
     */
    std::string select(const ParticleArrays &particles);

    /** Makes the next exchange() tell all receivers of their ghosts anew: a particle has
     * jumped from one end of the vessel to the other. */
    void
    expect_jumps()
    {
      all_changed = true;
    }

    /** Own rows by the rank that they are to be handed over to, as of the last select().
     * Empty when they have been. */
    ByRank<std::vector<std::uint32_t>> leaving;

    /** What a rank tells its neighbours beside the bodies. */
    struct News
    {
      /** Largest square of a drift [m^2/s^2]. */
      double speed_square = 0.;
      /** An error has been met with, here or by a neighbour. */
      bool has_stopped = false;
    };

    /**
     * Sends own bodies as chosen and receives those of the ghosts. Returns the news of
     * all senders together. Collective among neighbours.
     */
    News exchange(const ParticleArrays &particles, const News &own);

    /** Whether the last exchange() has brought other ghosts than the one before. */
    bool
    has_other_ghosts() const
    {
      return ghosts_changed;
    }

    /** Ranks that will hand over particles, as of the last exchange(). */
    const std::set<unsigned int> &
    giving() const
    {
      return givers;
    }

    /** Brings the bodies of the ghost rows up to date with the last exchange(). */
    void refresh(ParticleArrays &particles) const;

    /** Replaces the ghost rows by those of the last exchange(). */
    void place_ghosts(ParticleArrays &particles);

    /**
     * Sends what belongs to the rows that leave, by rank, and receives what others give.
     * Collective among those that announced it in the last exchange().
     */
    ByRank<std::vector<char>> hand_over(const ByRank<std::vector<char>> &parts);

  private:
    // Begin of a message, before the bodies.
    struct Header
    {
      double n_new; // ghosts of a new choice, which follow by themselves; or no_news
      double n_leaving;
      double speed_square;
      double has_stopped;
    };
    struct Outgoing
    {
      Subdomains::Neighbor       to;
      std::vector<std::uint32_t> rows;
      std::vector<std::int64_t>  ids; // of the rows
      bool                       is_new = false;
      std::vector<double>        buffer, description;
      MPI_Request                request = MPI_REQUEST_NULL;
    };
    struct Incoming
    {
      Subdomains::Neighbor       from;
      std::vector<std::int64_t>  ids;
      std::vector<unsigned char> types;
      unsigned int               first_ghost = 0;
      std::vector<double>        buffer, description;
      MPI_Request                request = MPI_REQUEST_NULL;
    };

    void      prepare(Outgoing &to) const;
    void      prepare(Incoming &from) const;
    void      free_requests();
    void      fill(Outgoing             &to,
                   const ParticleArrays &particles,
                   const News           &own,
                   const bool            is_first) const;
    void      describe(Outgoing &to, const ParticleArrays &particles) const;
    void      take_description(Incoming &from) const;
    void      exchange_descriptions(const ParticleArrays &particles);
    Outgoing &outgoing_to(const Subdomains::Neighbor &neighbor);
    Header    header_of(const Incoming &from) const;
    int       tag(const int base, const unsigned int shift) const;

    const Subdomains      &subdomains;
    const Period           period;
    const MPI_Comm         communicator;
    std::vector<Outgoing>  outgoing;
    std::vector<Incoming>  incoming;
    std::set<unsigned int> givers;
    bool                   all_changed    = false;
    bool                   ghosts_changed = false;
  };
} // namespace graupel

#endif
