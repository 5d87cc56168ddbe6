// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_numbers_exact_sum_h
#define graupel_dem_numbers_exact_sum_h

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <vector>

namespace graupel
{
  /**
   * A sum of real numbers that does not depend on their order, hence not on the
   * number of ranks: each term is cut to a whole number of quanta, and whole
   * numbers add exactly.
   */
  class ExactSum
  {
  public:
    /**
     * @p largest is the size of the largest term, in the unit of the sum, the
     * same on all ranks. The quantum is 2^-36 of it, so 2^27 terms of that size
     * fit. If it is zero the sum is zero.
     */
    explicit ExactSum(const double largest)
      : quantum(largest > 0. ? largest * 0x1p-36 : 0.)
      , inverse(largest > 0. ? 1. / quantum : 0.)
    {
    }

    void
    add(const double term)
    {
      quanta += static_cast<std::int64_t>(term * inverse);
    }

    /** Adds the terms of a sum with the same largest term. */
    void
    add(const ExactSum &other)
    {
      quanta += other.quanta;
    }

    /** The sum in quanta, which add up over ranks as whole numbers. */
    std::int64_t
    whole() const
    {
      return quanta;
    }

    /** What so many quanta are. */
    double
    value_of(const std::int64_t number) const
    {
      return quantum * static_cast<double>(number);
    }

    /** The sum over all ranks of @p communicator. Collective. */
    double
    total(MPI_Comm communicator) const
    {
      return totals({*this}, communicator)[0];
    }

    /** Several sums at once. Collective. */
    static std::vector<double>
    totals(const std::vector<ExactSum> &sums, MPI_Comm communicator)
    {
      std::vector<std::int64_t> quanta;
      for (const auto &sum : sums)
        quanta.push_back(sum.quanta);
      const int ierr = MPI_Allreduce(
        MPI_IN_PLACE, quanta.data(), quanta.size(), MPI_INT64_T, MPI_SUM, communicator);
      AssertThrowMPI(ierr);

      std::vector<double> results;
      for (std::size_t k = 0; k < sums.size(); ++k)
        results.push_back(sums[k].value_of(quanta[k]));
      return results;
    }

  private:
    double       quantum;
    double       inverse;
    std::int64_t quanta = 0;
  };
} // namespace graupel

#endif
