// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_numbers_lanes_h
#define graupel_dem_numbers_lanes_h

#include <cmath>
#include <cstdint>
#include <cstring>
#include <experimental/simd>

/**
 * As many numbers as fit into one register of the processor, and their traffic
 * with records in memory. Formulas are templates over the type of a number,
 * Real: double for one contact, Lanes for as many as there are lanes.
 */
namespace graupel
{
  using Lanes      = std::experimental::native_simd<double>;
  using LaneMask   = Lanes::mask_type;
  using WholeLanes = std::experimental::rebind_simd_t<std::int64_t, Lanes>;

  /** Numbers in Lanes. */
  constexpr unsigned int n_lanes = Lanes::size();

  /** @p a where @p condition holds, else @p b; both are computed. */
  [[gnu::always_inline]] inline double
  select(const bool condition, const double a, const double b)
  {
    return condition ? a : b;
  }

  [[gnu::always_inline]] inline Lanes
  select(const LaneMask &condition, const Lanes &a, const Lanes &b)
  {
    Lanes result                                = b;
    std::experimental::where(condition, result) = a;
    return result;
  }

  /** Whether the condition holds in some lane. */
  inline bool
  some(const bool condition)
  {
    return condition;
  }

  inline bool
  some(const LaneMask &condition)
  {
    return std::experimental::any_of(condition);
  }

  /** The largest of all lanes. */
  inline double
  largest_lane(const Lanes &numbers)
  {
    return std::experimental::hmax(numbers);
  }

  /** Numbers 0, 1, 2, ... in the lanes. */
  inline Lanes
  lane_numbers()
  {
    return Lanes([](auto lane) { return static_cast<double>(lane); });
  }

  namespace internal
  {
    using Register [[gnu::vector_size(n_lanes * sizeof(double))]]      = double;
    using WholeRegister [[gnu::vector_size(n_lanes * sizeof(double))]] = long long;

    // Exchanges element l + h of register i with element l of register i + h, for
    // all i and l without the bit h; all bits in turn transpose the square.
    template <unsigned int h>
    [[gnu::always_inline]] inline void
    exchange_across(Register (&square)[n_lanes])
    {
      WholeRegister low, high;
      for (unsigned int l = 0; l < n_lanes; ++l)
        {
          low[l]  = (l & h) ? n_lanes + l - h : l;
          high[l] = (l & h) ? n_lanes + l : l + h;
        }
      for (unsigned int i = 0; i < n_lanes; ++i)
        if (!(i & h))
          {
            const Register a = square[i], b = square[i + h];
            square[i]     = __builtin_shuffle(a, b, low);
            square[i + h] = __builtin_shuffle(a, b, high);
          }
    }

    [[gnu::always_inline]] inline void
    transpose(Register (&square)[n_lanes])
    {
      if constexpr (n_lanes >= 2)
        exchange_across<1>(square);
      if constexpr (n_lanes >= 4)
        exchange_across<2>(square);
      if constexpr (n_lanes >= 8)
        exchange_across<4>(square);
      static_assert(n_lanes <= 8);
    }
  } // namespace internal

  /**
   * Numbers @p first to @p first + n - 1 of the records of @p rows, one record a
   * lane: whole registers are loaded and transposed. A record is an aligned
   * struct of doubles; n is a multiple of 8.
   */
  template <unsigned int n, class Record>
  [[gnu::always_inline]] inline void
  load_records(const Record        *records,
               const std::uint32_t *rows,
               const unsigned int   first,
               Lanes               *numbers)
  {
    static_assert(n % 8 == 0 && sizeof(Record) % 64 == 0);
    for (unsigned int tile = 0; tile < n; tile += n_lanes)
      {
        internal::Register square[n_lanes];
        for (unsigned int l = 0; l < n_lanes; ++l)
          std::memcpy(&square[l],
                      reinterpret_cast<const char *>(records + rows[l]) +
                        sizeof(double) * (first + tile),
                      sizeof(square[l]));
        internal::transpose(square);
        for (unsigned int l = 0; l < n_lanes; ++l)
          numbers[tile + l] = Lanes(square[l]);
      }
  }

  /** The reverse of load_records(); all rows must differ. */
  template <unsigned int n, class Record>
  [[gnu::always_inline]] inline void
  store_records(Record              *records,
                const std::uint32_t *rows,
                const unsigned int   first,
                const Lanes         *numbers)
  {
    static_assert(n % 8 == 0 && sizeof(Record) % 64 == 0);
    for (unsigned int tile = 0; tile < n; tile += n_lanes)
      {
        internal::Register square[n_lanes];
        for (unsigned int l = 0; l < n_lanes; ++l)
          square[l] = static_cast<internal::Register>(numbers[tile + l]);
        internal::transpose(square);
        for (unsigned int l = 0; l < n_lanes; ++l)
          std::memcpy(reinterpret_cast<char *>(records + rows[l]) +
                        sizeof(double) * (first + tile),
                      &square[l],
                      sizeof(square[l]));
      }
  }

  /**
   * Adds 8 whole numbers a lane, @p numbers, to the records of @p rows, of 8
   * whole numbers each; rows may occur more than once.
   */
  template <class Record>
  [[gnu::always_inline]] inline void
  add_to_records(Record *records, const std::uint32_t *rows, const WholeLanes *numbers)
  {
    static_assert(sizeof(Record) == 64);
    for (unsigned int tile = 0; tile < 8; tile += n_lanes)
      {
        internal::Register square[n_lanes];
        for (unsigned int l = 0; l < n_lanes; ++l)
          std::memcpy(&square[l], &numbers[tile + l], sizeof(square[l]));
        internal::transpose(square);
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            char *place =
              reinterpret_cast<char *>(records + rows[l]) + sizeof(double) * tile;
            internal::WholeRegister sum, term;
            std::memcpy(&sum, place, sizeof(sum));
            std::memcpy(&term, &square[l], sizeof(term));
            sum += term;
            std::memcpy(place, &sum, sizeof(sum));
          }
      }
  }
} // namespace graupel

#endif
