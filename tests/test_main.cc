// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>

// Runs the cases of one room. Every rank runs all of them; only rank 0 prints,
// but a failure on any rank fails the program, so that nothing stays unseen.
int
main(int argc, char **argv)
{
  graupel::prepare_mpi_files();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);

  auto &listeners = testing::UnitTest::GetInstance()->listeners();
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    {
      class FailuresOnly : public testing::EmptyTestEventListener
      {
        void
        OnTestPartResult(const testing::TestPartResult &result) override
        {
          if (result.failed())
            std::cerr << "rank "
                      << dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) << ": "
                      << result.file_name() << ':' << result.line_number() << ": "
                      << result.message() << std::endl;
        }
      };
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new FailuresOnly);
    }

  const int failed = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0)
    {
      std::cerr << "No test ran: is the filter wrong?" << std::endl;
      return 1;
    }
  return dealii::Utilities::MPI::max(failed, MPI_COMM_WORLD);
}
