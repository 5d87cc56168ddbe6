// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/even_share.h>
#include <graupel/base/files.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace graupel
{
  namespace
  {
    constexpr mode_t readable_by_all = 0666; // less what the user's mask takes away

    [[noreturn]] void
    throw_cause()
    {
      throw std::system_error(errno, std::generic_category());
    }

    // An open file. Its functions throw std::system_error.
    class OpenFile
    {
    public:
      OpenFile(const std::string &path, const int flags)
        : descriptor(::open(path.c_str(), flags | O_CLOEXEC, readable_by_all))
      {
        if (descriptor < 0)
          throw_cause();
      }

      ~OpenFile()
      {
        ::close(descriptor);
      }

      OpenFile(const OpenFile &)            = delete;
      OpenFile &operator=(const OpenFile &) = delete;

      std::uint64_t
      size() const
      {
        struct stat status;
        if (::fstat(descriptor, &status) != 0)
          throw_cause();
        return status.st_size;
      }

      void
      write(const std::string_view text, const std::uint64_t begin)
      {
        for (std::size_t done = 0; done < text.size();)
          {
            const ssize_t n =
              ::pwrite(descriptor, text.data() + done, text.size() - done, begin + done);
            if (n < 0 && errno != EINTR)
              throw_cause();
            done += std::max<ssize_t>(n, 0);
          }
      }

      void
      cut(const std::uint64_t size)
      {
        if (::ftruncate(descriptor, size) != 0)
          throw_cause();
      }

      void
      send_to_disk()
      {
        // Some files, such as pipes, have no disk.
        if (::fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS)
          throw_cause();
      }

    private:
      const int descriptor;
    };

    std::string
    unfinished(const std::string &path)
    {
      return path + ".part";
    }

    void
    write_parts(const std::string           &path,
                const std::vector<FilePart> &parts,
                const int                    flags)
    {
      OpenFile file(unfinished(path), O_WRONLY | flags);
      for (const FilePart &part : parts)
        file.write(part.bytes, part.begin);
      file.send_to_disk();
    }

    void
    remove_part(const std::string &path)
    {
      std::error_code nobody_asks;
      std::filesystem::remove(unfinished(path), nobody_asks);
    }

    std::string
    cause(const std::system_error &error)
    {
      return error.code().message();
    }

    // A step towards the file @p path, of the ranks of which @p is_mine is true. Throws on
    // all of them, with what the first rank that has failed says, and leaves no part.
    template <class Action>
    void
    attempt(const std::string &path,
            MPI_Comm           communicator,
            const bool         is_mine,
            const Action      &action)
    {
      namespace mpi           = dealii::Utilities::MPI;
      const unsigned int rank = mpi::this_mpi_process(communicator);
      std::string        failure;
      try
        {
          if (is_mine)
            action();
        }
      catch (const std::system_error &error)
        {
          failure = cause(error);
        }
      catch (const dealii::ExceptionBase &)
        {
          failure = "the library that writes it has failed";
        }
      const unsigned int none  = mpi::n_mpi_processes(communicator),
                         first = mpi::min(failure.empty() ? none : rank, communicator);
      if (first == none)
        return;
      failure = mpi::broadcast(communicator, failure, first);
      if (rank == 0)
        remove_part(path);
      MPI_Barrier(communicator);
      throw FileError(path, failure);
    }
  } // namespace

  FileError::FileError(const std::string &path, const std::string &cause)
    : std::runtime_error("Cannot write " + path + ": " + cause + ".")
  {
  }

  void
  write_file(const std::string &path, const std::function<void(std::ostream &)> &write)
  {
    std::ostringstream stream;
    write(stream);
    const std::string text = stream.str();
    try
      {
        write_parts(path, {{0, text}}, O_CREAT | O_TRUNC);
        std::filesystem::rename(unfinished(path), path);
      }
    catch (const std::system_error &error)
      {
        remove_part(path);
        throw FileError(path, cause(error));
      }
  }

  void
  write_file(const std::string           &path,
             const std::vector<FilePart> &parts,
             MPI_Comm                     communicator)
  {
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    attempt(path, communicator, is_first, [&] {
      write_parts(path, {}, O_CREAT | O_TRUNC);
    });
    attempt(path, communicator, true, [&] { write_parts(path, parts, 0); });
    attempt(path, communicator, is_first, [&] {
      std::filesystem::rename(unfinished(path), path);
    });
  }

  void
  write_file(const std::string                              &path,
             const std::function<void(const std::string &)> &write,
             MPI_Comm                                        communicator)
  {
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    attempt(path, communicator, true, [&] { write(unfinished(path)); });
    attempt(path, communicator, is_first, [&] {
      OpenFile(unfinished(path), O_RDONLY).send_to_disk();
      std::filesystem::rename(unfinished(path), path);
    });
  }

  void
  write_file(const std::string &path, const std::string &part, MPI_Comm communicator)
  {
    const std::uint64_t begin = on_lower_ranks(part.size(), communicator);
    write_file(path, {{begin, part}}, communicator);
  }

  std::uint64_t
  room_on_disk(const std::string &path, MPI_Comm communicator)
  {
    std::error_code     nobody_asks; // the room is unlimited then
    const auto          folder = std::filesystem::path(path).parent_path();
    const std::uint64_t room   = std::filesystem::space(folder, nobody_asks).available;
    return dealii::Utilities::MPI::broadcast(communicator, room, 0);
  }

  void
  require_room(const std::string &path, const std::uint64_t bytes, MPI_Comm communicator)
  {
    const std::uint64_t all = dealii::Utilities::MPI::sum(bytes, communicator);
    if (all > room_on_disk(path, communicator))
      throw FileError(path,
                      std::make_error_code(std::errc::no_space_on_device).message() +
                        " for " + std::to_string(all) + " bytes");
  }

  void
  send_to_disk(const std::string &path)
  {
    try
      {
        OpenFile(path, O_RDONLY).send_to_disk();
      }
    catch (const std::system_error &error)
      {
        throw FileError(path, cause(error));
      }
  }

  void
  prepare_mpi_files()
  {
    // File pointers that ranks share are of no use here. The component sm keeps one in
    // shared memory, under a semaphore.
    ::setenv("OMPI_MCA_sharedfp", "^sm", 0);
  }

  void
  append_to_file(const std::string &path, const std::string &text)
  {
    try
      {
        OpenFile            file(path, O_WRONLY | O_CREAT);
        const std::uint64_t before = file.size();
        try
          {
            file.write(text, before);
          }
        catch (const std::system_error &)
          {
            file.cut(before);
            throw;
          }
      }
    catch (const std::system_error &error)
      {
        throw FileError(path, cause(error));
      }
  }
} // namespace graupel
