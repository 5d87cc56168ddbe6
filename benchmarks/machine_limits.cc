// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

// What a core of this machine can do at most: the bytes that it moves from and to memory,
// and its multiplications with additions. With mpirun -np N, what each of N cores can do
// at the same time.
//
//   benchmark_machine_limits
//
// Source of the triad: McCalpin, IEEE TCCA Newsletter (1995) 19 (STREAM).

#include <graupel/base/progress.h>

#include <deal.II/base/mpi.h>

#include <experimental/simd>
#include <iostream>

using namespace graupel;

namespace
{
  constexpr std::size_t  length  = 16000000; // far beyond all caches
  constexpr unsigned int repeats = 10;

  // Seconds of the fastest of some calls, the others are disturbed; on the slowest rank.
  template <typename Function>
  double
  fastest(const Function &function)
  {
    double best = std::numeric_limits<double>::max();
    for (unsigned int n = 0; n < repeats; ++n)
      {
        MPI_Barrier(MPI_COMM_WORLD);
        const double begin = Progress::steady_seconds();
        function();
        best = std::min(best, Progress::steady_seconds() - begin);
      }
    return dealii::Utilities::MPI::max(best, MPI_COMM_WORLD);
  }

  double
  gigabytes_per_second()
  {
    std::vector<double> a(length, 1.), b(length, 2.), c(length, 3.);
    const double        seconds = fastest([&] {
      for (std::size_t k = 0; k < length; ++k)
        a[k] = b[k] + 0.5 * c[k];
    });
    // Two are read, and one is fetched and written back.
    return a[length / 2] == 3.5 ? 1e-9 * 4. * sizeof(double) * length / seconds : 0.;
  }

  template <typename Number>
  double
  gigaflops()
  {
    // As many independent chains as hide the latency of one.
    using Lanes                    = std::experimental::native_simd<Number>;
    constexpr unsigned int n_sums  = 10;
    constexpr unsigned int n_steps = 2000000;
    Lanes                  sums[n_sums];
    for (unsigned int i = 0; i < n_sums; ++i)
      sums[i] = Number(i);
    volatile Number factor = 0.999, addend = 0.001;
    const Lanes     x = Number(factor), y = Number(addend);
    const double    seconds = fastest([&] {
      for (unsigned int n = 0; n < n_steps; ++n)
        for (Lanes &sum : sums)
          sum = sum * x + y;
    });
    Number total = 0;
    for (const Lanes &sum : sums)
      total += reduce(sum);
    return total > 0 ? 2e-9 * n_sums * n_steps * Lanes::size() / seconds : 0.;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const double triad = gigabytes_per_second(), doubles = gigaflops<double>(),
               floats = gigaflops<float>();
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << "of each of " << dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)
              << " core(s): triad " << triad << " GB/s, double " << doubles
              << " Gflop/s, float " << floats << " Gflop/s" << std::endl;
  return 0;
}
