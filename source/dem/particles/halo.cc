#include <graupel/dem/particles/halo.h>

#include <deal.II/base/mpi.h>

#include <cstring>

namespace graupel
{
  namespace
  {
    constexpr int identity_tag = 4101;
    constexpr int refresh_tag  = 4102;

    // A ghost's body, and its id and type, as doubles.
    constexpr unsigned int n_numbers    = sizeof(Body) / sizeof(double);
    constexpr unsigned int n_identities = 2;
  } // namespace

  Halo::Halo(const Cylinder &cylinder,
             const double    reach,
             const bool      periodic,
             MPI_Comm        communicator)
    : communicator(communicator)
    , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
    , corner(-cylinder.diameter / 2., -cylinder.diameter / 2., 0.)
    , height(cylinder.height)
    , bin_size(reach)
    , shifts(periodic ? std::vector<double>{0., height, -height}
                      : std::vector<double>{0.})
    , n_bins{}
  {
    const std::array<double, 3> extent{
      {cylinder.diameter, cylinder.diameter, cylinder.height}};
    for (unsigned int d = 0; d < 3; ++d)
      n_bins[d] = static_cast<unsigned int>(std::ceil(extent[d] / bin_size));
  }

  Halo::~Halo()
  {
    free_requests();
  }

  unsigned int
  Halo::bin(const dealii::Point<3> &x) const
  {
    // Points outside the box count to its outermost bins, which keeps
    // neighbours neighbours.
    std::array<unsigned int, 3> b;
    for (unsigned int d = 0; d < 3; ++d)
      b[d] = static_cast<unsigned int>(
        std::clamp(std::floor((x[d] - corner[d]) / bin_size), 0., n_bins[d] - 1.));
    return (b[2] * n_bins[1] + b[1]) * n_bins[0] + b[0];
  }

  std::vector<unsigned char>
  Halo::occupied_bins(const ParticleArrays &particles) const
  {
    const unsigned int         n = n_bins[0] * n_bins[1] * n_bins[2];
    std::vector<unsigned char> mine(n, 0), all(n * n_ranks);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      mine[bin(particles.body[i].position)] = 1;
    const int ierr =
      MPI_Allgather(mine.data(), n, MPI_BYTE, all.data(), n, MPI_BYTE, communicator);
    AssertThrowMPI(ierr);
    return all;
  }

  std::vector<unsigned char>
  Halo::bins_near(const unsigned char *occupied) const
  {
    std::vector<unsigned char> near(n_bins[0] * n_bins[1] * n_bins[2], 0);
    const auto                 around = [](const int x, const unsigned int n) {
      return std::make_pair(std::max(x - 1, 0), std::min(x + 1, static_cast<int>(n) - 1));
    };
    const int n[3] = {int(n_bins[0]), int(n_bins[1]), int(n_bins[2])};
    for (int z = 0, b = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x, ++b)
          if (occupied[b])
            {
              const auto [x0, x1] = around(x, n[0]);
              const auto [y0, y1] = around(y, n[1]);
              const auto [z0, z1] = around(z, n[2]);
              for (int w = z0; w <= z1; ++w)
                for (int v = y0; v <= y1; ++v)
                  for (int u = x0; u <= x1; ++u)
                    near[(w * n[1] + v) * n[0] + u] = 1;
            }
    return near;
  }

  void
  Halo::choose_rows(const ParticleArrays &particles)
  {
    const auto         occupied = occupied_bins(particles);
    const unsigned int n        = n_bins[0] * n_bins[1] * n_bins[2];
    const unsigned int me       = dealii::Utilities::MPI::this_mpi_process(communicator);

    neighbors.clear();
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        const auto near = bins_near(&occupied[rank * n]);
        for (unsigned int shift = 0; shift < shifts.size(); ++shift)
          {
            if (rank == me && shift == 0)
              continue;
            Neighbor neighbor;
            neighbor.rank  = rank;
            neighbor.shift = shift;
            for (unsigned int i = 0; i < particles.n_owned; ++i)
              {
                auto x = particles.body[i].position;
                x[2] += shifts[shift];
                const bool outside =
                  shift > 0 && (x[2] < -bin_size || x[2] > height + bin_size);
                if (!outside && near[bin(x)])
                  neighbor.rows.push_back(i);
              }
            neighbors.push_back(std::move(neighbor));
          }
      }
  }

  void
  Halo::exchange_identities(ParticleArrays &particles)
  {
    const unsigned int n_shifts = shifts.size();
    std::vector<int>   n_sent(n_ranks * n_shifts, 0), n_received(n_ranks * n_shifts, 0);
    for (const auto &neighbor : neighbors)
      n_sent[neighbor.rank * n_shifts + neighbor.shift] = neighbor.rows.size();
    int ierr = MPI_Alltoall(n_sent.data(),
                            n_shifts,
                            MPI_INT,
                            n_received.data(),
                            n_shifts,
                            MPI_INT,
                            communicator);
    AssertThrowMPI(ierr);

    unsigned int n_rows = particles.n_owned;
    for (auto &neighbor : neighbors)
      {
        neighbor.first_ghost = n_rows;
        neighbor.n_ghosts    = n_received[neighbor.rank * n_shifts + neighbor.shift];
        n_rows += neighbor.n_ghosts;
      }
    particles.resize(n_rows);

    for (auto &neighbor : neighbors)
      {
        // Ids are whole numbers far below 2^53, exact as doubles.
        neighbor.outgoing.clear();
        for (const unsigned int i : neighbor.rows)
          {
            neighbor.outgoing.push_back(particles.id[i]);
            neighbor.outgoing.push_back(particles.type[i]);
          }
        neighbor.incoming.resize(n_identities * neighbor.n_ghosts);
        ierr = MPI_Sendrecv(neighbor.outgoing.data(),
                            neighbor.outgoing.size(),
                            MPI_DOUBLE,
                            neighbor.rank,
                            identity_tag + 10 * neighbor.shift,
                            neighbor.incoming.data(),
                            neighbor.incoming.size(),
                            MPI_DOUBLE,
                            neighbor.rank,
                            identity_tag + 10 * neighbor.shift,
                            communicator,
                            MPI_STATUS_IGNORE);
        AssertThrowMPI(ierr);
        for (unsigned int g = 0; g < neighbor.n_ghosts; ++g)
          {
            const unsigned int row = neighbor.first_ghost + g;
            particles.id[row]      = static_cast<std::int64_t>(neighbor.incoming[2 * g]);
            particles.type[row] =
              static_cast<unsigned char>(neighbor.incoming[2 * g + 1]);
          }
      }
  }

  void
  Halo::rebuild(ParticleArrays &particles)
  {
    if (!is_needed())
      return;
    free_requests();
    choose_rows(particles);
    exchange_identities(particles);
    neighbors.erase(std::remove_if(neighbors.begin(),
                                   neighbors.end(),
                                   [](const Neighbor &neighbor) {
                                     return neighbor.rows.empty() &&
                                            neighbor.n_ghosts == 0;
                                   }),
                    neighbors.end());
    start_requests();
    refresh(particles);
  }

  void
  Halo::start_requests()
  {
    for (auto &neighbor : neighbors)
      {
        neighbor.outgoing.resize(n_numbers * neighbor.rows.size());
        neighbor.incoming.resize(n_numbers * neighbor.n_ghosts);
        MPI_Request send, receive;
        int         ierr = MPI_Recv_init(neighbor.incoming.data(),
                                 neighbor.incoming.size(),
                                 MPI_DOUBLE,
                                 neighbor.rank,
                                 refresh_tag + 10 * neighbor.shift,
                                 communicator,
                                 &receive);
        AssertThrowMPI(ierr);
        ierr = MPI_Send_init(neighbor.outgoing.data(),
                             neighbor.outgoing.size(),
                             MPI_DOUBLE,
                             neighbor.rank,
                             refresh_tag + 10 * neighbor.shift,
                             communicator,
                             &send);
        AssertThrowMPI(ierr);
        requests.push_back(receive);
        requests.push_back(send);
      }
  }

  void
  Halo::free_requests()
  {
    for (auto &request : requests)
      MPI_Request_free(&request);
    requests.clear();
  }

  void
  Halo::refresh(ParticleArrays &p)
  {
    if (requests.empty())
      return;
    for (auto &neighbor : neighbors)
      {
        double *out = neighbor.outgoing.data();
        for (const unsigned int i : neighbor.rows)
          {
            std::memcpy(out, &p.body[i], sizeof(Body));
            out[2] += shifts[neighbor.shift];
            out += n_numbers;
          }
      }
    int ierr = MPI_Startall(requests.size(), requests.data());
    AssertThrowMPI(ierr);
    ierr = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(ierr);
    for (const auto &neighbor : neighbors)
      if (neighbor.n_ghosts > 0)
        std::memcpy(static_cast<void *>(&p.body[neighbor.first_ghost]),
                    neighbor.incoming.data(),
                    neighbor.n_ghosts * sizeof(Body));
  }
} // namespace graupel
