// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/checksum.h>
#include <graupel/base/files.h>
#include <graupel/base/stop_request.h>

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

// Files that are written whole or not at all and are known again, and signals that are
// noted.

using namespace graupel;
namespace fs  = std::filesystem;
namespace mpi = dealii::Utilities::MPI;

namespace
{
  // A directory of its own, the same on all ranks.
  class WrittenFiles : public testing::Test
  {
  protected:
    WrittenFiles()
    {
      std::string text;
      if (is_first())
        {
          text = (fs::temp_directory_path() / "graupel-XXXXXX").string();
          if (mkdtemp(text.data()) == nullptr)
            throw std::runtime_error("no temporary directory");
        }
      folder = mpi::broadcast(MPI_COMM_WORLD, text, 0);
    }

    ~WrittenFiles() override
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (is_first())
        fs::remove_all(folder);
    }

    static bool
    is_first()
    {
      return mpi::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    // On a rank's own, where others have theirs too.
    std::string
    own() const
    {
      return folder + "/own-" + std::to_string(mpi::this_mpi_process(MPI_COMM_WORLD));
    }

    std::string folder;
  };

  std::string
  content(const std::string &path)
  {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  // Files of this process may not grow beyond so many bytes while this lives, as if the
  // disk were full.
  class SmallDisk
  {
  public:
    explicit SmallDisk(const rlim_t bytes)
    {
      std::signal(SIGXFSZ, SIG_IGN);
      getrlimit(RLIMIT_FSIZE, &before);
      const rlimit now{bytes, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &now);
    }

    ~SmallDisk()
    {
      setrlimit(RLIMIT_FSIZE, &before);
    }

  private:
    rlimit before;
  };

  template <typename Action>
  std::string
  failure_of(const Action &action)
  {
    try
      {
        action();
      }
    catch (const FileError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  expect_only(const std::string &path, const std::string &text)
  {
    EXPECT_EQ(content(path), text);
    EXPECT_FALSE(fs::exists(path + ".part"));
  }
} // namespace

TEST_F(WrittenFiles, AreWrittenWholeOrStayAsTheyWere)
{
  const std::string path = own();
  write_file(path, [](std::ostream &file) { file << "first"; });
  expect_only(path, "first");
  write_file(path, [](std::ostream &file) { file << "2nd"; });
  expect_only(path, "2nd");
  {
    const SmallDisk   disk(1000);
    const std::string failure = failure_of([&] {
      write_file(path, [](std::ostream &file) { file << std::string(5000, 'x'); });
    });
    EXPECT_EQ(failure, "Cannot write " + path + ": File too large.");
  }
  expect_only(path, "2nd");
  EXPECT_EQ(failure_of([&] { write_file(path + "/a", [](std::ostream &) {}); }),
            "Cannot write " + path + "/a: Not a directory.");
}

TEST_F(WrittenFiles, OfSeveralRanksHaveTheirPartsInOrder)
{
  const std::string  path = folder + "/of-all";
  const unsigned int n    = mpi::n_mpi_processes(MPI_COMM_WORLD),
                     rank = mpi::this_mpi_process(MPI_COMM_WORLD);
  std::string whole;
  for (unsigned int r = 0; r < n; ++r)
    whole += std::string(3 + 5 * r, 'a' + r);
  for (unsigned int turn = 0; turn < 2; ++turn)
    {
      write_file(path, std::string(3 + 5 * rank, 'a' + rank), MPI_COMM_WORLD);
      expect_only(path, whole);
      MPI_Barrier(MPI_COMM_WORLD);
    }
  // The last rank alone finds no room; all of them know.
  {
    const SmallDisk   disk(rank + 1 == n ? 1000 : 100000);
    const std::string failure =
      failure_of([&] { write_file(path, std::string(2000, 'x'), MPI_COMM_WORLD); });
    EXPECT_EQ(failure, "Cannot write " + path + ": File too large.");
  }
  expect_only(path, whole);
  const std::string nowhere = folder + "/no/where";
  EXPECT_EQ(failure_of([&] { write_file(nowhere, "x", MPI_COMM_WORLD); }),
            "Cannot write " + nowhere + ": No such file or directory.");
}

TEST_F(WrittenFiles, GrowByWholeTextsOnly)
{
  const std::string path = own();
  append_to_file(path, "one\n");
  append_to_file(path, "two\n");
  {
    const SmallDisk disk(20);
    EXPECT_EQ(failure_of([&] { append_to_file(path, std::string(50, 'x')); }),
              "Cannot write " + path + ": File too large.");
  }
  expect_only(path, "one\ntwo\n");
  append_to_file(path, "three\n");
  expect_only(path, "one\ntwo\nthree\n");
}

TEST_F(WrittenFiles, AskForRoomBeforehand)
{
  EXPECT_EQ(failure_of([&] { require_room(folder + "/a", 1000, MPI_COMM_WORLD); }), "");
  const std::uint64_t much = 1ul << 60;
  const unsigned int  n    = mpi::n_mpi_processes(MPI_COMM_WORLD);
  EXPECT_EQ(failure_of([&] { require_room(folder + "/a", much, MPI_COMM_WORLD); }),
            "Cannot write " + folder + "/a: No space left on device for " +
              std::to_string(n * much) + " bytes.");
}

// Source of the value: the check value of CRC-32 in the catalogue of Williams, "A
// painless guide to CRC error detection algorithms" (1993).
TEST(Checksum, IsThatOfThePartsTogether)
{
  EXPECT_EQ(Checksum("123456789").crc, 0xCBF43926u);
  Checksum sum("1234");
  sum.add(Checksum(""));
  sum.add(Checksum("56789"));
  EXPECT_EQ(sum, Checksum("123456789"));
  EXPECT_EQ(sum.length, 9u);

  const unsigned int rank = mpi::this_mpi_process(MPI_COMM_WORLD);
  std::string        whole;
  for (unsigned int r = 0; r < mpi::n_mpi_processes(MPI_COMM_WORLD); ++r)
    whole += std::string(3 + 5 * r, 'a' + r);
  EXPECT_EQ(joined(Checksum(std::string(3 + 5 * rank, 'a' + rank)), MPI_COMM_WORLD),
            Checksum(whole));
}

TEST_F(WrittenFiles, AreToldFromThoseThatWereChanged)
{
  const std::string path = folder + "/file";
  std::string       text;
  for (unsigned int k = 0; k < 10000; ++k)
    text += static_cast<char>(k * k % 251);
  const auto sum_with = [&](const std::string &there) {
    if (is_first())
      std::ofstream(path, std::ios::binary) << there;
    MPI_Barrier(MPI_COMM_WORLD);
    const auto sum = checksum_of_file(path, 3, MPI_COMM_WORLD);
    MPI_Barrier(MPI_COMM_WORLD);
    return sum;
  };
  const Checksum right(text);
  EXPECT_EQ(sum_with(text + "end"), right);
  for (unsigned int turn = 0; turn < 1000; ++turn)
    {
      std::string changed = text;
      changed[turn * 7919 % text.size()] ^= static_cast<char>(1 << turn % 8);
      ASSERT_FALSE(sum_with(changed + "end") == right) << turn;
    }
  EXPECT_FALSE(sum_with(text) == right);
  EXPECT_FALSE(sum_with("no").has_value());
  EXPECT_FALSE(checksum_of_file(folder, 0, MPI_COMM_WORLD).has_value());
  EXPECT_FALSE(checksum_of_file(folder + "/nothing", 0, MPI_COMM_WORLD).has_value());
}

TEST(StopRequest, NotesASignal)
{
  EXPECT_EQ(noted_signal(), 0);
  note_signals();
  std::raise(SIGUSR1);
  EXPECT_EQ(noted_signal(), SIGUSR1);
  // One that comes with it says the same.
  std::raise(SIGTERM);
  EXPECT_EQ(noted_signal(), SIGUSR1);
}

TEST(StopRequest, ALaterSignalEndsTheProcess)
{
  const auto ask_twice = [] {
    note_signals();
    std::raise(SIGUSR1);
    sleep(3);
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(ask_twice(), testing::ExitedWithCode(128 + SIGTERM), "");
}
