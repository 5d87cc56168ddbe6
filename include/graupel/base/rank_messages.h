// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_rank_messages_h
#define graupel_base_rank_messages_h

#include <deal.II/base/mpi_consensus_algorithms.h>

#include <map>
#include <set>

namespace graupel
{
  /** What goes to or comes from other ranks, by their numbers. */
  template <class T>
  using ByRank = std::map<unsigned int, T>;

  template <class T>
  std::vector<unsigned int>
  ranks_of(const ByRank<T> &parts)
  {
    std::vector<unsigned int> ranks;
    for (const auto &[rank, part] : parts)
      ranks.push_back(rank);
    return ranks;
  }

  /**
   * Sends each rank its part of @p sent, and returns what others have sent here. Who
   * sends to whom need not be known, and there is no array over all ranks, as there is
   * in Utilities::MPI::some_to_some. Collective.
   */
  template <class T>
  ByRank<T>
  send_parts(const ByRank<T> &sent, MPI_Comm communicator)
  {
    ByRank<T> received;
    dealii::Utilities::MPI::ConsensusAlgorithms::nbx<T>(
      ranks_of(sent),
      [&](const unsigned int to) { return sent.at(to); },
      [&](const unsigned int from, const T &part) { received[from] = part; },
      communicator);
    return received;
  }

  /** Asks each rank its question of @p asked, and returns the answers. Collective. */
  template <class Answer, class Question>
  ByRank<Answer>
  ask_ranks(const ByRank<Question>                        &asked,
            const std::function<Answer(const Question &)> &answer,
            MPI_Comm                                       communicator)
  {
    ByRank<Answer> answers;
    dealii::Utilities::MPI::ConsensusAlgorithms::nbx<Question, Answer>(
      ranks_of(asked),
      [&](const unsigned int to) { return asked.at(to); },
      [&](const unsigned int, const Question &question) { return answer(question); },
      [&](const unsigned int from, const Answer &given) { answers[from] = given; },
      communicator);
    return answers;
  }

  /**
   * As send_parts(), among ranks that know each other: each of @p neighbors must give
   * this rank as one of its own. Nobody waits for a rank that is not a neighbour.
   */
  template <class T>
  ByRank<T>
  send_to_neighbors(const std::set<unsigned int> &neighbors,
                    const ByRank<T>              &sent,
                    const int                     tag,
                    MPI_Comm                      communicator)
  {
    using namespace dealii;
    std::vector<std::vector<char>> buffers;
    std::vector<MPI_Request>       requests(neighbors.size());
    for (const unsigned int rank : neighbors)
      {
        const auto part = sent.find(rank);
        buffers.push_back(part == sent.end() ? std::vector<char>()
                                             : Utilities::pack(part->second, false));
        const int ierr = MPI_Isend(buffers.back().data(),
                                   buffers.back().size(),
                                   MPI_CHAR,
                                   rank,
                                   tag,
                                   communicator,
                                   &requests[buffers.size() - 1]);
        AssertThrowMPI(ierr);
      }
    ByRank<T> received;
    for (const unsigned int rank : neighbors)
      {
        MPI_Status status;
        int        size = 0;
        int        ierr = MPI_Probe(rank, tag, communicator, &status);
        AssertThrowMPI(ierr);
        MPI_Get_count(&status, MPI_CHAR, &size);
        std::vector<char> buffer(size);
        ierr = MPI_Recv(
          buffer.data(), size, MPI_CHAR, rank, tag, communicator, MPI_STATUS_IGNORE);
        AssertThrowMPI(ierr);
        if (size > 0)
          received[rank] = Utilities::unpack<T>(buffer, false);
      }
    const int ierr = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(ierr);
    return received;
  }
} // namespace graupel

#endif
