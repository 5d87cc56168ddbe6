// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/checksum.h>
#include <graupel/base/even_share.h>
#include <graupel/base/files.h>
#include <graupel/simulation/files/particle_records.h>

#include <filesystem>
#include <fstream>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    using Particle = DemState::Particle;
    static_assert(std::is_trivially_copyable_v<Particle>);
    static_assert(std::is_trivially_copyable_v<LooseContact>);

    struct Numbers
    {
      std::int64_t particles = 0, contacts = 0;
    };

    template <class Record>
    std::string_view
    bytes(const Record *records, const std::size_t n)
    {
      return {reinterpret_cast<const char *>(records), n * sizeof(Record)};
    }

    template <class Record>
    void
    read(std::istream &stream, const std::int64_t at, std::vector<Record> &records)
    {
      stream.seekg(at);
      stream.read(reinterpret_cast<char *>(records.data()),
                  records.size() * sizeof(Record));
    }
  } // namespace

  void
  write_particles(const std::string &file,
                  const std::string &head,
                  const DemState    &state,
                  MPI_Comm           communicator)
  {
    const Numbers      mine{static_cast<std::int64_t>(state.particles.size()),
                       static_cast<std::int64_t>(state.contacts.size())};
    const Numbers      below{on_lower_ranks(mine.particles, communicator),
                        on_lower_ranks(mine.contacts, communicator)};
    const Numbers      all{mpi::sum(mine.particles, communicator),
                      mpi::sum(mine.contacts, communicator)};
    const std::int64_t length =
      mpi::broadcast(communicator, static_cast<std::int64_t>(head.size()), 0);

    auto particles = state.particles;
    for (Particle &particle : particles)
      particle.first_contact += below.contacts;

    const std::uint64_t   of_particles = length + sizeof(Numbers);
    const std::uint64_t   of_contacts  = of_particles + all.particles * sizeof(Particle);
    std::vector<FilePart> parts{{of_particles + below.particles * sizeof(Particle),
                                 bytes(particles.data(), particles.size())},
                                {of_contacts + below.contacts * sizeof(LooseContact),
                                 bytes(state.contacts.data(), state.contacts.size())}};
    Checksum              whole(head);
    whole.add(Checksum(bytes(&all, 1)));
    whole.add(joined(Checksum(parts[0].bytes), communicator));
    whole.add(joined(Checksum(parts[1].bytes), communicator));
    if (mpi::this_mpi_process(communicator) == 0)
      {
        parts.push_back({0, head});
        parts.push_back({static_cast<std::uint64_t>(length), bytes(&all, 1)});
        parts.push_back({whole.length, bytes(&whole, 1)});
      }
    write_file(file, parts, communicator);
  }

  std::string
  problem_of_records(const std::string &file, MPI_Comm communicator)
  {
    if (const bool exists = std::filesystem::exists(file);
        mpi::min(exists ? 1 : 0, communicator) == 0)
      return file + " is missing";
    const auto here = checksum_of_file(file, sizeof(Checksum), communicator);
    Checksum   written;
    if (here)
      {
        std::ifstream stream(file, std::ios::binary);
        stream.seekg(here->length);
        stream.read(reinterpret_cast<char *>(&written), sizeof(written));
      }
    const bool is_whole = here && *here == written;
    return mpi::min(is_whole ? 1 : 0, communicator) == 1
             ? ""
             : file + " is cut off or damaged";
  }

  void
  read_particles(std::istream &stream, DemState &state, MPI_Comm communicator)
  {
    Numbers all;
    stream.read(reinterpret_cast<char *>(&all), sizeof(all));
    const std::int64_t of_particles = stream.tellg();
    const std::int64_t of_contacts  = of_particles + all.particles * sizeof(Particle);
    const auto [first, last]        = even_share(all.particles, communicator);
    // With the one behind, which tells where the contacts of the last one end.
    std::vector<Particle> &particles = state.particles;
    particles.resize(std::min(last + 1, all.particles) - first);
    read(stream, of_particles + first * sizeof(Particle), particles);
    const std::int64_t first_contact =
      particles.empty() ? all.contacts : particles.front().first_contact;
    const std::int64_t end_of_contacts =
      last < all.particles ? particles.back().first_contact : all.contacts;
    particles.resize(last - first);
    for (Particle &particle : particles)
      particle.first_contact -= first_contact;
    state.contacts.resize(end_of_contacts - first_contact);
    read(stream, of_contacts + first_contact * sizeof(LooseContact), state.contacts);
    AssertThrow(stream, dealii::ExcIO());
  }
} // namespace graupel
