// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/checksum.h>
#include <graupel/base/even_share.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include <zlib.h>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    constexpr std::uint64_t chunk = 1 << 22; // that is read at a time [bytes]

    // For MPI: what is on the lower ranks goes first.
    void
    join(void *lower, void *higher, int *n, MPI_Datatype *)
    {
      for (int k = 0; k < *n; ++k)
        {
          Checksum whole = static_cast<Checksum *>(lower)[k];
          whole.add(static_cast<Checksum *>(higher)[k]);
          static_cast<Checksum *>(higher)[k] = whole;
        }
    }

    // None where the file ends before.
    std::optional<Checksum>
    checksum_of_part(const std::string  &path,
                     const std::uint64_t begin,
                     const std::uint64_t end)
    {
      std::ifstream     file(path, std::ios::binary);
      Checksum          result;
      std::vector<char> bytes(std::min(chunk, end - begin));
      file.seekg(begin);
      for (std::uint64_t at = begin; at < end && file; at += bytes.size())
        {
          bytes.resize(std::min(chunk, end - at));
          if (file.read(bytes.data(), bytes.size()))
            result.add(Checksum({bytes.data(), bytes.size()}));
        }
      return file ? std::make_optional(result) : std::nullopt;
    }
  } // namespace

  Checksum::Checksum(const std::string_view bytes)
    : length(bytes.size())
    , crc(crc32_z(0, reinterpret_cast<const unsigned char *>(bytes.data()), bytes.size()))
  {
  }

  void
  Checksum::add(const Checksum &behind)
  {
    crc = crc32_combine(crc, behind.crc, behind.length);
    length += behind.length;
  }

  Checksum
  joined(const Checksum &mine, MPI_Comm communicator)
  {
    MPI_Datatype type;
    MPI_Op       operation;
    MPI_Type_contiguous(sizeof(Checksum), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    MPI_Op_create(join, /*commutes=*/0, &operation);
    Checksum  all;
    const int ierr = MPI_Allreduce(&mine, &all, 1, type, operation, communicator);
    MPI_Op_free(&operation);
    MPI_Type_free(&type);
    AssertThrowMPI(ierr);
    return all;
  }

  std::optional<Checksum>
  checksum_of_file(const std::string  &path,
                   const std::uint64_t at_end,
                   MPI_Comm            communicator)
  {
    // As the first rank sees it; another that cannot read its share says so.
    std::error_code problem;
    std::uint64_t   size = std::filesystem::file_size(path, problem);
    if (problem)
      size = 0;
    size = mpi::broadcast(communicator, size, 0);
    if (mpi::max(problem ? 1 : 0, communicator) > 0 || size < at_end)
      return {};
    const Share share = even_share(size - at_end, communicator);
    const auto  mine  = checksum_of_part(path, share.begin, share.end);
    if (mpi::max(mine ? 0 : 1, communicator) > 0)
      return {};
    return joined(*mine, communicator);
  }
} // namespace graupel
