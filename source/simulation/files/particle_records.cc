#include <graupel/simulation/files/particle_records.h>

#include <limits>

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

    // The sum of the numbers on the lower ranks.
    Numbers
    on_lower_ranks(const Numbers &mine, MPI_Comm communicator)
    {
      Numbers   below;
      const int ierr = MPI_Exscan(&mine, &below, 2, MPI_INT64_T, MPI_SUM, communicator);
      AssertThrowMPI(ierr);
      return mpi::this_mpi_process(communicator) == 0 ? Numbers() : below;
    }

    // Files report errors by what their functions return; they must all be called on all
    // ranks.
    class OutputFile
    {
    public:
      OutputFile(const std::string &name, MPI_Comm communicator)
      {
        is_open = take(MPI_File_open(communicator,
                                     name.c_str(),
                                     MPI_MODE_CREATE | MPI_MODE_WRONLY,
                                     MPI_INFO_NULL,
                                     &file));
        if (is_open)
          take(MPI_File_set_size(file, 0));
      }

      template <class Record>
      void
      write(const std::int64_t at, const Record *records, const std::size_t n)
      {
        if (!is_open)
          return;
        MPI_Datatype type;
        take(MPI_Type_contiguous(sizeof(Record), MPI_BYTE, &type));
        take(MPI_Type_commit(&type));
        take(MPI_File_write_at_all(
          file, at, records, static_cast<int>(n), type, MPI_STATUS_IGNORE));
        take(MPI_Type_free(&type));
      }

      // False if something went wrong.
      bool
      close()
      {
        if (is_open)
          take(MPI_File_close(&file));
        return is_well;
      }

    private:
      bool
      take(const int ierr)
      {
        is_well = is_well && ierr == MPI_SUCCESS;
        return ierr == MPI_SUCCESS;
      }

      MPI_File file    = MPI_FILE_NULL;
      bool     is_open = false, is_well = true;
    };

    // The n-th of so many even shares begins here.
    std::int64_t
    begin_of_share(const std::int64_t n, const std::int64_t all, MPI_Comm communicator)
    {
      const std::int64_t n_ranks = mpi::n_mpi_processes(communicator);
      return all / n_ranks * n + std::min(n, all % n_ranks);
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
    const Numbers      below = on_lower_ranks(mine, communicator);
    const Numbers      all{mpi::sum(mine.particles, communicator),
                      mpi::sum(mine.contacts, communicator)};
    const std::int64_t length =
      mpi::broadcast(communicator, static_cast<std::int64_t>(head.size()), 0);
    const bool is_first = mpi::this_mpi_process(communicator) == 0;

    auto particles = state.particles;
    for (Particle &particle : particles)
      particle.first_contact += below.contacts;

    OutputFile         output(file, communicator);
    const std::int64_t of_particles = length + sizeof(Numbers);
    const std::int64_t of_contacts  = of_particles + all.particles * sizeof(Particle);
    output.write(0, head.data(), is_first ? head.size() : 0);
    output.write(length, &all, is_first ? 1 : 0);
    output.write(of_particles + below.particles * sizeof(Particle),
                 particles.data(),
                 particles.size());
    output.write(of_contacts + below.contacts * sizeof(LooseContact),
                 state.contacts.data(),
                 state.contacts.size());
    const int failed = output.close() ? 0 : 1;
    if (mpi::max(failed, communicator) > 0)
      throw std::runtime_error("Cannot write " + file + ": is the disk full?");
  }

  bool
  read_particles(std::istream &stream, DemState &state, MPI_Comm communicator)
  {
    Numbers all;
    stream.read(reinterpret_cast<char *>(&all), sizeof(all));
    const std::int64_t of_particles = stream.tellg();
    const std::int64_t of_contacts  = of_particles + all.particles * sizeof(Particle);
    const std::int64_t end          = of_contacts + all.contacts * sizeof(LooseContact);
    stream.seekg(0, std::ios::end);
    if (!stream || stream.tellg() != end)
      return false;

    const std::int64_t rank  = mpi::this_mpi_process(communicator);
    const std::int64_t first = begin_of_share(rank, all.particles, communicator);
    const std::int64_t last  = begin_of_share(rank + 1, all.particles, communicator);
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
    return static_cast<bool>(stream);
  }
} // namespace graupel
