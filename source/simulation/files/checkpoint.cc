// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/checksum.h>
#include <graupel/base/files.h>
#include <graupel/base/parameters.h>
#include <graupel/simulation/files/checkpoint.h>
#include <graupel/simulation/files/may_change.h>
#include <graupel/simulation/files/particle_records.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace graupel
{
  namespace
  {
    namespace fs  = std::filesystem;
    namespace mpi = dealii::Utilities::MPI;

    // Numbers only, by their bytes: a checkpoint is read by the same version.
    template <class Archive, class Record>
    void
    raw(Archive &archive, Record &record)
    {
      static_assert(std::is_trivially_copyable_v<Record>);
      auto     bytes = boost::serialization::make_binary_object(&record, sizeof(Record));
      archive &bytes;
    }

    template <class Archive, class Record>
    void
    raw(Archive &archive, std::vector<Record> &records)
    {
      std::size_t n = records.size();
      archive    &n;
      records.resize(n);
      for (Record &record : records)
        raw(archive, record);
    }

    template <class Archive>
    void
    exchange(Archive &archive, std::vector<CaseResult> &cases)
    {
      std::size_t n = cases.size();
      archive    &n;
      cases.resize(n);
      for (CaseResult &result : cases)
        {
          std::vector<double> numbers = result.values.numbers();
          archive            &numbers;
          result.values = Values::of_numbers(numbers);
        }
    }

    template <class Archive>
    void
    exchange(Archive &archive, RunState &state)
    {
      archive &state.parameters &state.time &state.next_output &state.next_adaption;
      archive                                                  &state.next_observation;
      raw(archive, state.rest);
      exchange(archive, state.cases);
      archive &state.last_velocity &state.has_begun &state.feeds;
      raw(archive, state.ledger);
      raw(archive, state.costs);
      archive &state.wall_seconds &state.cpu_seconds;
      archive &state.written.fields &state.written.particles &state.written.contacts;
      archive                                                &state.written.averages;
      archive &state.phase_number &state.phase &state.has_fluid;
      raw(archive, state.velocity);
      raw(archive, state.fluid);
      archive &state.stable_step &state.averaged_time &state.partition;
    }

    // The first line of what the program writes for itself.
    // The last number is raised whenever a record changes between two versions.
    const std::string first_line = "Graupel " GRAUPEL_VERSION ", records 3";

    // The particles in a file behind a first line and what @p write_head puts into an
    // archive. Collective.
    template <class WriteHead>
    void
    write_records(const std::string &file,
                  const WriteHead   &write_head,
                  const DemState    &particles,
                  MPI_Comm           communicator)
    {
      std::ostringstream head;
      head << first_line << '\n';
      boost::archive::binary_oarchive archive(head);
      write_head(archive);
      archive << particles.common;
      write_particles(file, head.str(), particles, communicator);
    }

    // A file of write_records() behind its first line.
    std::ifstream
    open_records(const std::string &file)
    {
      std::ifstream stream(file, std::ios::binary);
      stream.ignore(first_line.size() + 1);
      return stream;
    }

    template <class ReadHead>
    void
    read_records(const std::string &file,
                 const ReadHead    &read_head,
                 DemState          &particles,
                 MPI_Comm           communicator)
    {
      std::ifstream                   stream = open_records(file);
      boost::archive::binary_iarchive archive(stream);
      read_head(archive);
      archive >> particles.common;
      read_particles(stream, particles, communicator);
    }

    // What is wrong with such a file, to be asked before it is read; empty if nothing.
    // Collective.
    std::string
    problem_of_file(const std::string &file, MPI_Comm communicator)
    {
      if (const auto problem = problem_of_records(file, communicator); !problem.empty())
        return problem;
      std::ifstream stream(file, std::ios::binary);
      std::string   line;
      std::getline(stream, line);
      return line == first_line
               ? ""
               : file +
                   " was written by another version of the program and cannot be read";
    }

    // A file of a checkpoint beside state.bin, and what was written to it.
    struct FileEntry
    {
      std::string name;
      Checksum    checksum;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &name &checksum;
      }
    };

    // All that there are in a folder. Collective.
    std::vector<FileEntry>
    entries_of(const std::string &folder, MPI_Comm communicator)
    {
      std::vector<FileEntry> entries;
      if (mpi::this_mpi_process(communicator) == 0)
        for (const auto &file : fs::directory_iterator(folder))
          entries.push_back({file.path().filename().string(), {}});
      entries = mpi::broadcast(communicator, entries, 0);
      for (FileEntry &entry : entries)
        {
          const std::string file = folder + "/" + entry.name;
          const auto        sum  = checksum_of_file(file, 0, communicator);
          if (!sum)
            throw FileError(file, "it cannot be read again");
          entry.checksum = *sum;
        }
      return entries;
    }

    std::string
    state_file(const std::string &folder)
    {
      return folder + "/state.bin";
    }

    // What is wrong with a checkpoint; empty if nothing. Collective.
    std::string
    problem_of_checkpoint(const std::string &folder, MPI_Comm communicator)
    {
      const std::string file = state_file(folder);
      if (const auto problem = problem_of_file(file, communicator); !problem.empty())
        return problem;
      std::vector<FileEntry> entries;
      {
        std::ifstream                   stream = open_records(file);
        boost::archive::binary_iarchive archive(stream);
        archive >> entries;
      }
      for (const FileEntry &entry : entries)
        {
          const std::string path = folder + "/" + entry.name;
          const auto        sum  = checksum_of_file(path, 0, communicator);
          if (!sum)
            return path + " is missing";
          if (sum->length != entry.checksum.length)
            return path + " has " + std::to_string(sum->length) + " bytes, and had " +
                   std::to_string(entry.checksum.length);
          if (!(*sum == entry.checksum))
            return path + " is damaged";
        }
      return {};
    }

    std::string
    unfinished(const std::string &folder)
    {
      return folder + ".new";
    }

    std::string
    earlier(const std::string &folder)
    {
      return folder + ".old";
    }

    // The unfinished checkpoint, which is whole, becomes the last one, and the last one
    // the one before. Collective.
    void
    move_on(const std::string &folder, MPI_Comm communicator)
    {
      if (mpi::this_mpi_process(communicator) == 0)
        {
          if (fs::exists(folder))
            {
              fs::remove_all(earlier(folder));
              fs::rename(folder, earlier(folder));
            }
          fs::rename(unfinished(folder), folder);
        }
      MPI_Barrier(communicator);
    }

    // Whether there is such a folder, as the first rank sees it.
    bool
    is_there(const std::string &folder, MPI_Comm communicator)
    {
      return mpi::broadcast(communicator, fs::is_directory(folder), 0);
    }
  } // namespace

  std::string
  checkpoint_fields(const std::string &folder)
  {
    return folder + "/fields";
  }

  void
  write_checkpoint(const std::string                              &folder,
                   const RunState                                 &state,
                   const DemState                                 &particles,
                   const std::function<void(const std::string &)> &write_more,
                   MPI_Comm                                        communicator)
  {
    const std::string next = unfinished(folder);
    if (mpi::this_mpi_process(communicator) == 0)
      {
        fs::remove_all(next);
        fs::create_directory(next);
      }
    MPI_Barrier(communicator);
    write_more(checkpoint_fields(next));
    MPI_Barrier(communicator);
    // With state.bin, which comes last, the checkpoint is whole.
    const auto entries = entries_of(next, communicator);
    if (mpi::this_mpi_process(communicator) == 0)
      for (const FileEntry &entry : entries)
        send_to_disk(next + "/" + entry.name);
    write_records(
      state_file(next),
      [&](auto &archive) {
        archive << entries;
        RunState copy(state);
        exchange(archive, copy);
      },
      particles,
      communicator);
    move_on(folder, communicator);
  }

  Checkpoint
  read_checkpoint(const std::string   &folder,
                  const RunParameters &parameters,
                  MPI_Comm             communicator)
  {
    // It was killed before it had its name.
    if (is_there(unfinished(folder), communicator) &&
        problem_of_checkpoint(unfinished(folder), communicator).empty())
      move_on(folder, communicator);

    Checkpoint  result;
    std::string problems;
    for (const std::string &candidate : {folder, earlier(folder)})
      if (result.folder.empty() && is_there(candidate, communicator))
        {
          const auto problem = problem_of_checkpoint(candidate, communicator);
          if (problem.empty())
            result.folder = candidate;
          else
            problems += (problems.empty() ? "" : "; ") + problem;
        }
    if (result.folder.empty())
      throw InputError(
        "Output/directory",
        problems.empty()
          ? "there is no checkpoint " + folder +
              " to resume from; run without --resume, or name the directory of the run "
              "that stopped with --output"
          : problems + "; begin anew without --resume");
    if (!problems.empty())
      result.told.push_back("warning: " + problems +
                            "; the run goes on from the checkpoint before");

    read_records(
      state_file(result.folder),
      [&](auto &archive) {
        std::vector<FileEntry> entries;
        archive >> entries;
        exchange(archive, result.state);
      },
      result.particles,
      communicator);
    for (const std::string &change : check_changes(
           parameters.texts,
           result.state.parameters,
           result.state.phase.empty() ? Standing::between_phases : Standing::within_phase,
           "the checkpoint " + result.folder))
      result.told.push_back("changed: " + change);
    return result;
  }

  void
  write_bed(const std::string   &file,
            const RunParameters &parameters,
            const DemState      &particles,
            MPI_Comm             communicator)
  {
    write_records(
      file, [&](auto &archive) { archive << parameters.texts; }, particles, communicator);
  }

  DemState
  read_bed(const std::string   &file,
           const RunParameters &parameters,
           MPI_Comm             communicator)
  {
    const std::string parameter = "Filling/start from";
    const bool        exists    = mpi::broadcast(communicator, fs::exists(file), 0);
    require(exists,
            parameter,
            "there is no settled bed " + file +
              "; name the output directory of a run whose bed has settled");
    const auto problem = problem_of_file(file, communicator);
    require(problem.empty(), parameter, problem + "; let the bed settle anew");
    ParameterTexts there;
    DemState       result;
    read_records(
      file, [&](auto &archive) { archive >> there; }, result, communicator);
    check_changes(parameters.texts, there, Standing::settled_bed, "the bed " + file);
    return result;
  }
} // namespace graupel
