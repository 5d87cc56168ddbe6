// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_files_h
#define graupel_base_files_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace graupel
{
  /** A file that cannot be written, with the cause that the system tells, such as a full
   * disk. */
  class FileError : public std::runtime_error
  {
  public:
    /** Of the file @p path. */
    FileError(const std::string &path, const std::string &cause);
  };

  /**
   * Writes the file @p path whole or not at all: what @p write says goes to PATH.part,
   * which takes the place of an earlier file once it is on the disk. Throws FileError
   * where it cannot; the earlier file is as it was then.
   */
  void write_file(const std::string                         &path,
                  const std::function<void(std::ostream &)> &write);

  /** Bytes, and where in a file they belong. */
  struct FilePart
  {
    std::uint64_t    begin = 0;
    std::string_view bytes;
  };

  /** The same for a file whose parts the ranks have. Collective; throws on all ranks. */
  void write_file(const std::string           &path,
                  const std::vector<FilePart> &parts,
                  MPI_Comm                     communicator);

  /** The same for parts that lie one behind another in the order of the ranks. */
  void write_file(const std::string &path,
                  const std::string &part,
                  MPI_Comm           communicator);

  /** The same for a file that a library writes, by all ranks together: @p write is told
   * its name. */
  void write_file(const std::string                              &path,
                  const std::function<void(const std::string &)> &write,
                  MPI_Comm                                        communicator);

  /** Bytes that the disk of the folder of @p path has room for, as the first rank sees it.
   * Collective. */
  std::uint64_t room_on_disk(const std::string &path, MPI_Comm communicator);

  /** Throws FileError on all ranks where the disk of the folder of @p path has no room for
   * @p bytes of each rank, before they are written by a library that would abort.
   * Collective. */
  void require_room(const std::string  &path,
                    const std::uint64_t bytes,
                    MPI_Comm            communicator);

  /** Returns when what was written to the file @p path is on the disk. Throws FileError
   * where that cannot be. */
  void send_to_disk(const std::string &path);

  /** Keeps Open MPI from semaphores that a crash leaves behind, on which later programs
   * hang when they open a file together: before MPI is initialised. What the user's own
   * environment says counts. */
  void prepare_mpi_files();

  /** Appends @p text to the file @p path, all of it or nothing. Throws FileError where
   * that cannot be. */
  void append_to_file(const std::string &path, const std::string &text);
} // namespace graupel

#endif
