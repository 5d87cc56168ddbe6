// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/halo.h>

#include <cstring>
#include <sstream>

namespace graupel
{
  namespace
  {
    constexpr int body_tag        = 4101;
    constexpr int description_tag = 4102;
    constexpr int hand_over_tag   = 4103;
    constexpr int tags_of_a_shift = 10;

    // All as doubles; ids are whole numbers far below 2^53, exact as such.
    constexpr unsigned int n_body = sizeof(Body) / sizeof(double);
    // A ghost's id and type, before its body.
    constexpr unsigned int n_identity = 2;
    // A cache line, so that the bodies behind it begin at one.
    constexpr unsigned int n_header = 8;
    constexpr double       no_news  = -1.;

    void
    check(const int ierr)
    {
      AssertThrowMPI(ierr);
    }
  } // namespace

  Halo::Halo(const Subdomains &subdomains, const Period &period, MPI_Comm communicator)
    : subdomains(subdomains)
    , period(period)
    , communicator(communicator)
  {
    reset();
  }

  Halo::~Halo()
  {
    free_requests();
  }

  void
  Halo::free_requests()
  {
    for (auto &to : outgoing)
      MPI_Request_free(&to.request);
    for (auto &from : incoming)
      MPI_Request_free(&from.request);
  }

  void
  Halo::reset()
  {
    free_requests();
    outgoing.clear();
    incoming.clear();
    leaving.clear();
    givers.clear();
    for (const auto &receiver : subdomains.receivers())
      {
        outgoing.emplace_back();
        outgoing.back().to = receiver;
        prepare(outgoing.back());
      }
    for (const auto &sender : subdomains.senders())
      {
        incoming.emplace_back();
        incoming.back().from = sender;
        prepare(incoming.back());
      }
  }

  int
  Halo::tag(const int base, const unsigned int shift) const
  {
    return base + tags_of_a_shift * static_cast<int>(shift);
  }

  void
  Halo::prepare(Outgoing &to) const
  {
    if (to.request != MPI_REQUEST_NULL)
      check(MPI_Request_free(&to.request));
    to.buffer.resize(n_header + n_body * to.rows.size());
    check(MPI_Send_init(to.buffer.data(),
                        to.buffer.size(),
                        MPI_DOUBLE,
                        to.to.rank,
                        tag(body_tag, to.to.shift),
                        communicator,
                        &to.request));
  }

  void
  Halo::prepare(Incoming &from) const
  {
    if (from.request != MPI_REQUEST_NULL)
      check(MPI_Request_free(&from.request));
    from.buffer.resize(n_header + n_body * from.ids.size());
    check(MPI_Recv_init(from.buffer.data(),
                        from.buffer.size(),
                        MPI_DOUBLE,
                        from.from.rank,
                        tag(body_tag, from.from.shift),
                        communicator,
                        &from.request));
  }

  Halo::Outgoing &
  Halo::outgoing_to(const Subdomains::Neighbor &neighbor)
  {
    return *std::lower_bound(
      outgoing.begin(),
      outgoing.end(),
      neighbor,
      [](const Outgoing &a, const Subdomains::Neighbor &b) { return a.to < b; });
  }

  std::string
  Halo::select(const ParticleArrays &particles)
  {
    const unsigned int me = dealii::Utilities::MPI::this_mpi_process(communicator);
    leaving.clear();
    for (auto &to : outgoing)
      to.rows.clear();
    for (std::uint32_t row = 0; row < particles.n_owned; ++row)
      {
        const auto &x      = particles.body[row].position;
        auto        inside = x;
        inside[2]          = period.within(x[2]);
        const auto *home   = subdomains.surroundings(inside);
        if (home == nullptr)
          {
            std::ostringstream text;
            text
              << "particle " << particles.id[row] << " at (" << x
              << ") m has gone too far for its neighbours to know: out of the mesh, or "
                 "further than its size within a substep. Try a smaller substep";
            return text.str();
          }
        if (!home->is_home && home->home_of != Subdomains::nobody)
          leaving[home->home_of].push_back(row);
        for (unsigned int shift = 0; shift < subdomains.shifts().size(); ++shift)
          {
            auto image = x;
            image[2] += subdomains.shifts()[shift];
            if (!subdomains.is_near_vessel(image, shift))
              continue;
            if (const auto *at = subdomains.surroundings(image))
              for (const unsigned int rank : at->seen_by)
                if (rank != me || shift > 0)
                  outgoing_to({rank, shift}).rows.push_back(row);
          }
      }

    std::vector<std::int64_t> ids;
    for (auto &to : outgoing)
      {
        ids.clear();
        for (const auto row : to.rows)
          ids.push_back(particles.id[row]);
        to.is_new = all_changed || ids != to.ids;
        to.ids    = ids;
      }
    all_changed = false;
    return {};
  }

  void
  Halo::fill(Outgoing             &to,
             const ParticleArrays &particles,
             const News           &own,
             const bool            is_first) const
  {
    const auto   rows = leaving.find(to.to.rank);
    const Header header{to.is_new ? to.rows.size() : no_news,
                        is_first && rows != leaving.end() ? rows->second.size() : 0.,
                        own.speed_square,
                        own.has_stopped ? 1. : 0.};
    std::memcpy(to.buffer.data(), &header, sizeof(header));
    // The bodies of a new choice come with their description; those of a rank that has
    // stopped mean nothing.
    if (to.is_new || own.has_stopped)
      return;
    double *out = to.buffer.data() + n_header;
    for (const auto row : to.rows)
      {
        std::memcpy(out, &particles.body[row], sizeof(Body));
        out[2] += subdomains.shifts()[to.to.shift];
        out += n_body;
      }
  }

  Halo::Header
  Halo::header_of(const Incoming &from) const
  {
    Header header;
    std::memcpy(&header, from.buffer.data(), sizeof(header));
    return header;
  }

  Halo::News
  Halo::exchange(const ParticleArrays &particles, const News &own)
  {
    std::vector<MPI_Request> requests;
    for (std::size_t k = 0; k < outgoing.size(); ++k)
      {
        // A rank is told once of what is handed over to it.
        const bool is_first = k == 0 || outgoing[k].to.rank != outgoing[k - 1].to.rank;
        fill(outgoing[k], particles, own, is_first);
        requests.push_back(outgoing[k].request);
      }
    for (const auto &from : incoming)
      requests.push_back(from.request);
    check(MPI_Startall(requests.size(), requests.data()));
    check(MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE));

    News all = own;
    givers.clear();
    for (const auto &from : incoming)
      {
        const Header header = header_of(from);
        all.speed_square    = std::max(all.speed_square, header.speed_square);
        all.has_stopped     = all.has_stopped || header.has_stopped > 0.;
        if (header.n_leaving > 0.)
          givers.insert(from.from.rank);
      }
    exchange_descriptions(particles);
    return all;
  }

  void
  Halo::describe(Outgoing &to, const ParticleArrays &particles) const
  {
    to.description.clear();
    for (const auto row : to.rows)
      {
        to.description.push_back(particles.id[row]);
        to.description.push_back(particles.type[row]);
        const auto *body = reinterpret_cast<const double *>(&particles.body[row]);
        to.description.insert(to.description.end(), body, body + n_body);
        to.description[to.description.size() - n_body + 2] +=
          subdomains.shifts()[to.to.shift];
      }
  }

  void
  Halo::take_description(Incoming &from) const
  {
    const std::size_t n = from.description.size() / (n_identity + n_body);
    from.ids.resize(n);
    from.types.resize(n);
    prepare(from);
    const double *in = from.description.data();
    for (std::size_t k = 0; k < n; ++k, in += n_identity + n_body)
      {
        from.ids[k]   = static_cast<std::int64_t>(in[0]);
        from.types[k] = static_cast<unsigned char>(in[1]);
        std::memcpy(
          from.buffer.data() + n_header + n_body * k, in + n_identity, sizeof(Body));
      }
  }

  void
  Halo::exchange_descriptions(const ParticleArrays &particles)
  {
    std::vector<MPI_Request> requests;
    std::vector<Incoming *>  described;
    for (auto &from : incoming)
      if (const double n = header_of(from).n_new; n != no_news)
        {
          from.description.resize((n_identity + n_body) * static_cast<std::size_t>(n));
          described.push_back(&from);
          requests.emplace_back();
          check(MPI_Irecv(from.description.data(),
                          from.description.size(),
                          MPI_DOUBLE,
                          from.from.rank,
                          tag(description_tag, from.from.shift),
                          communicator,
                          &requests.back()));
        }
    ghosts_changed = !described.empty();
    for (auto &to : outgoing)
      if (to.is_new)
        {
          describe(to, particles);
          requests.emplace_back();
          check(MPI_Isend(to.description.data(),
                          to.description.size(),
                          MPI_DOUBLE,
                          to.to.rank,
                          tag(description_tag, to.to.shift),
                          communicator,
                          &requests.back()));
        }
    check(MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE));
    for (auto *from : described)
      take_description(*from);
    for (auto &to : outgoing)
      if (to.is_new)
        {
          prepare(to);
          to.is_new = false;
        }
  }

  void
  Halo::refresh(ParticleArrays &particles) const
  {
    for (const auto &from : incoming)
      if (!from.ids.empty())
        std::memcpy(static_cast<void *>(&particles.body[from.first_ghost]),
                    from.buffer.data() + n_header,
                    from.ids.size() * sizeof(Body));
  }

  void
  Halo::place_ghosts(ParticleArrays &particles)
  {
    unsigned int n_rows = particles.n_owned;
    for (auto &from : incoming)
      {
        from.first_ghost = n_rows;
        n_rows += from.ids.size();
      }
    particles.resize(n_rows);
    for (const auto &from : incoming)
      {
        std::copy(
          from.ids.begin(), from.ids.end(), particles.id.begin() + from.first_ghost);
        std::copy(from.types.begin(),
                  from.types.end(),
                  particles.type.begin() + from.first_ghost);
      }
    refresh(particles);
    ghosts_changed = false;
  }

  ByRank<std::vector<char>>
  Halo::hand_over(const ByRank<std::vector<char>> &parts)
  {
    std::vector<MPI_Request> requests;
    for (const auto &[rank, part] : parts)
      {
        requests.emplace_back();
        check(MPI_Isend(part.data(),
                        part.size(),
                        MPI_CHAR,
                        rank,
                        hand_over_tag,
                        communicator,
                        &requests.back()));
      }
    ByRank<std::vector<char>> received;
    for (const unsigned int rank : givers)
      {
        MPI_Status status;
        int        n = 0;
        check(MPI_Probe(rank, hand_over_tag, communicator, &status));
        check(MPI_Get_count(&status, MPI_CHAR, &n));
        auto &part = received[rank];
        part.resize(n);
        check(MPI_Recv(part.data(),
                       n,
                       MPI_CHAR,
                       rank,
                       hand_over_tag,
                       communicator,
                       MPI_STATUS_IGNORE));
      }
    check(MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE));
    leaving.clear();
    givers.clear();
    return received;
  }
} // namespace graupel
