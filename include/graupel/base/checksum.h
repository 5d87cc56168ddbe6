// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_checksum_h
#define graupel_base_checksum_h

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace graupel
{
  /**
   * Length and CRC-32 of bytes (by zlib). Bytes that are changed within 32 bits, or in
   * up to three bits of 11 kB, never have the same; others with a chance of 2e-10.
   */
  struct Checksum
  {
    std::uint64_t length = 0;
    std::uint64_t crc    = 0;

    Checksum() = default;
    explicit Checksum(const std::string_view bytes);

    /** Becomes that of these bytes and those of @p behind, which follow. */
    void add(const Checksum &behind);

    bool
    operator==(const Checksum &other) const
    {
      return length == other.length && crc == other.crc;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &length &crc;
    }
  };

  /** That of the bytes of all ranks, one behind another in their order. Collective. */
  Checksum joined(const Checksum &mine, MPI_Comm communicator);

  /** That of the file @p path without its last @p at_end bytes, of which each rank reads
   * an even share; none where the file cannot be read or is shorter. Collective. */
  std::optional<Checksum> checksum_of_file(const std::string  &path,
                                           const std::uint64_t at_end,
                                           MPI_Comm            communicator);
} // namespace graupel

#endif
