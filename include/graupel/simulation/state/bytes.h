// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_state_bytes_h
#define graupel_simulation_state_bytes_h

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <sstream>
#include <string>

namespace graupel
{
  /** @p record, which boost's archives know, as bytes. */
  template <class Record>
  std::string
  to_bytes(const Record &record)
  {
    std::ostringstream              stream(std::ios::binary);
    boost::archive::binary_oarchive archive(stream);
    archive << record;
    return stream.str();
  }

  /** The record of to_bytes(). */
  template <class Record>
  Record
  from_bytes(const std::string &bytes)
  {
    std::istringstream              stream(bytes, std::ios::binary);
    boost::archive::binary_iarchive archive(stream);
    Record                          record;
    archive >> record;
    return record;
  }
} // namespace graupel

#endif
