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
    namespace fs = std::filesystem;

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

    // The version goes first; false if the file is another's.
    bool
    check_version(boost::archive::binary_iarchive &archive)
    {
      std::string version;
      archive    &version;
      return version == GRAUPEL_VERSION;
    }

    const char *const another_version =
      " was written by another version of the program and cannot be read";
    const char *const damaged = " is cut off or damaged";
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
    const bool is_writer = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    const std::string unfinished = folder + ".new", last = folder + ".old";
    if (is_writer)
      {
        fs::remove_all(unfinished);
        fs::create_directory(unfinished);
      }
    MPI_Barrier(communicator);
    std::ostringstream head;
    {
      boost::archive::binary_oarchive archive(head);
      const std::string               version = GRAUPEL_VERSION;
      archive << version;
      RunState copy(state);
      exchange(archive, copy);
      archive << particles.common;
    }
    write_particles(unfinished + "/state.bin", head.str(), particles, communicator);
    write_more(checkpoint_fields(unfinished));
    MPI_Barrier(communicator);
    if (is_writer)
      {
        fs::remove_all(last);
        if (fs::exists(folder))
          fs::rename(folder, last);
        fs::rename(unfinished, folder);
        fs::remove_all(last);
      }
    MPI_Barrier(communicator);
  }

  void
  finish_checkpoint(const std::string &folder, MPI_Comm communicator)
  {
    // It is whole once the last one has another name.
    const std::string unfinished = folder + ".new";
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0 &&
        !fs::exists(folder) && fs::exists(folder + ".old") && fs::exists(unfinished))
      fs::rename(unfinished, folder);
    MPI_Barrier(communicator);
  }

  std::pair<RunState, DemState>
  read_checkpoint(const std::string        &folder,
                  const RunParameters      &parameters,
                  std::vector<std::string> &changes,
                  MPI_Comm                  communicator)
  {
    const std::string             file = folder + "/state.bin";
    std::ifstream                 stream(file, std::ios::binary);
    std::pair<RunState, DemState> result;
    require(static_cast<bool>(stream),
            "Output/directory",
            "there is no checkpoint " + folder +
              " to resume from; run without --resume, or name the directory of the run "
              "that stopped with --output");
    try
      {
        boost::archive::binary_iarchive archive(stream);
        require(check_version(archive), "Output/directory", file + another_version);
        exchange(archive, result.first);
        archive >> result.second.common;
      }
    catch (const boost::archive::archive_exception &)
      {
        throw InputError("Output/directory", file + damaged);
      }
    require(read_particles(stream, result.second, communicator),
            "Output/directory",
            file + damaged);
    changes = check_changes(parameters.texts,
                            result.first.parameters,
                            result.first.phase.empty() ? Standing::between_phases
                                                       : Standing::within_phase,
                            "the checkpoint " + folder);
    return result;
  }

  void
  write_bed(const std::string   &file,
            const RunParameters &parameters,
            const DemState      &particles,
            MPI_Comm             communicator)
  {
    std::ostringstream head;
    {
      boost::archive::binary_oarchive archive(head);
      const std::string               version = GRAUPEL_VERSION;
      archive << version << parameters.texts << particles.common;
    }
    write_particles(file, head.str(), particles, communicator);
  }

  DemState
  read_bed(const std::string   &file,
           const RunParameters &parameters,
           MPI_Comm             communicator)
  {
    const std::string parameter = "Filling/start from";
    std::ifstream     stream(file, std::ios::binary);
    require(static_cast<bool>(stream),
            parameter,
            "there is no settled bed " + file +
              "; name the output directory of a run whose bed has settled");
    ParameterTexts there;
    DemState       result;
    try
      {
        boost::archive::binary_iarchive archive(stream);
        require(check_version(archive), parameter, file + another_version);
        archive >> there >> result.common;
      }
    catch (const boost::archive::archive_exception &)
      {
        throw InputError(parameter, file + damaged);
      }
    require(read_particles(stream, result, communicator), parameter, file + damaged);
    check_changes(parameters.texts, there, Standing::settled_bed, "the bed " + file);
    return result;
  }
} // namespace graupel
