// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "mpi_counts.h"

#include <mpi.h>

#include <numeric>
#include <vector>

namespace
{
  graupel::MpiCounts &
  counts()
  {
    static graupel::MpiCounts all;
    return all;
  }

  void
  count(const char *kind, const double bytes)
  {
    auto &of_kind = counts()[kind];
    ++of_kind.calls;
    of_kind.bytes += bytes;
  }

  std::int64_t
  bytes(const std::int64_t n, MPI_Datatype type)
  {
    int size = 0;
    if (type != MPI_DATATYPE_NULL)
      PMPI_Type_size(type, &size);
    return n * size;
  }

  int
  n_ranks(MPI_Comm communicator)
  {
    int n = 1;
    PMPI_Comm_size(communicator, &n);
    return n;
  }

  std::int64_t
  sum(const int *n, MPI_Comm communicator)
  {
    return std::accumulate(n, n + n_ranks(communicator), std::int64_t(0));
  }

  bool
  is_root(const int root, MPI_Comm communicator)
  {
    int rank = 0;
    PMPI_Comm_rank(communicator, &rank);
    return rank == root;
  }

  // Bytes of the persistent requests that send.
  std::map<MPI_Request, std::int64_t> &
  persistent()
  {
    static std::map<MPI_Request, std::int64_t> all;
    return all;
  }

  void
  count_start(MPI_Request request)
  {
    const auto sends = persistent().find(request);
    if (sends != persistent().end())
      count("message", sends->second);
  }
} // namespace

namespace graupel
{
  MpiCounts
  mpi_counts()
  {
    return counts();
  }

  MpiCounts
  operator-(MpiCounts later, const MpiCounts &earlier)
  {
    for (const auto &[kind, before] : earlier)
      {
        later[kind].calls -= before.calls;
        later[kind].bytes -= before.bytes;
      }
    return later;
  }

  MpiCounts
  operator*(const double factor, MpiCounts counts)
  {
    for (auto &[kind, of_kind] : counts)
      of_kind = {factor * of_kind.calls, factor * of_kind.bytes};
    return counts;
  }

  double
  n_blocking_collectives(const MpiCounts &counts)
  {
    double n = 0.;
    for (const auto &[kind, of_kind] : counts)
      if (kind != "message" && kind[0] != 'I')
        n += of_kind.calls;
    return n;
  }
} // namespace graupel

// The functions of MPI that this program's libraries call to send anything.

#define SEND(name)                                              \
  int MPI_##name(const void  *buffer,                           \
                 int          n,                                \
                 MPI_Datatype type,                             \
                 int          to,                               \
                 int          tag,                              \
                 MPI_Comm     communicator)                     \
  {                                                             \
    count("message", bytes(n, type));                           \
    return PMPI_##name(buffer, n, type, to, tag, communicator); \
  }
SEND(Send)
SEND(Ssend)
SEND(Rsend)
SEND(Bsend)

#define SEND_LATER(name, counts_now)                                               \
  int MPI_##name(const void  *buffer,                                              \
                 int          n,                                                   \
                 MPI_Datatype type,                                                \
                 int          to,                                                  \
                 int          tag,                                                 \
                 MPI_Comm     communicator,                                        \
                 MPI_Request *request)                                             \
  {                                                                                \
    const int ierr = PMPI_##name(buffer, n, type, to, tag, communicator, request); \
    if (counts_now)                                                                \
      count("message", bytes(n, type));                                            \
    else                                                                           \
      persistent()[*request] = bytes(n, type);                                     \
    return ierr;                                                                   \
  }
SEND_LATER(Isend, true)
SEND_LATER(Issend, true)
SEND_LATER(Irsend, true)
SEND_LATER(Send_init, false)
SEND_LATER(Ssend_init, false)

int
MPI_Start(MPI_Request *request)
{
  count_start(*request);
  return PMPI_Start(request);
}

int
MPI_Startall(int n, MPI_Request requests[])
{
  for (int k = 0; k < n; ++k)
    count_start(requests[k]);
  return PMPI_Startall(n, requests);
}

int
MPI_Request_free(MPI_Request *request)
{
  persistent().erase(*request);
  return PMPI_Request_free(request);
}

int
MPI_Sendrecv(const void  *sent,
             int          n_sent,
             MPI_Datatype sent_type,
             int          to,
             int          tag,
             void        *received,
             int          n_received,
             MPI_Datatype received_type,
             int          from,
             int          received_tag,
             MPI_Comm     communicator,
             MPI_Status  *status)
{
  count("message", bytes(n_sent, sent_type));
  return PMPI_Sendrecv(sent,
                       n_sent,
                       sent_type,
                       to,
                       tag,
                       received,
                       n_received,
                       received_type,
                       from,
                       received_tag,
                       communicator,
                       status);
}

// Arguments of the collectives; those that begin at once and end later have a request
// behind them.
#define COLLECTIVE(name, size, arguments, values) \
  int MPI_##name arguments                        \
  {                                               \
    count(#name, size);                           \
    return PMPI_##name values;                    \
  }

COLLECTIVE(Barrier, 0, (MPI_Comm c), (c))
COLLECTIVE(Ibarrier, 0, (MPI_Comm c, MPI_Request *r), (c, r))
COLLECTIVE(Bcast,
           is_root(root, c) ? bytes(n, t) : 0,
           (void *b, int n, MPI_Datatype t, int root, MPI_Comm c),
           (b, n, t, root, c))
COLLECTIVE(Ibcast,
           is_root(root, c) ? bytes(n, t) : 0,
           (void *b, int n, MPI_Datatype t, int root, MPI_Comm c, MPI_Request *r),
           (b, n, t, root, c, r))
COLLECTIVE(Allreduce,
           bytes(n, t),
           (const void *s, void *d, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c),
           (s, d, n, t, o, c))
COLLECTIVE(
  Iallreduce,
  bytes(n, t),
  (const void *s, void *d, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c, MPI_Request *r),
  (s, d, n, t, o, c, r))
COLLECTIVE(
  Reduce,
  bytes(n, t),
  (const void *s, void *d, int n, MPI_Datatype t, MPI_Op o, int root, MPI_Comm c),
  (s, d, n, t, o, root, c))
COLLECTIVE(Scan,
           bytes(n, t),
           (const void *s, void *d, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c),
           (s, d, n, t, o, c))
COLLECTIVE(Exscan,
           bytes(n, t),
           (const void *s, void *d, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c),
           (s, d, n, t, o, c))
COLLECTIVE(Reduce_scatter,
           bytes(sum(n, c), t),
           (const void *s, void *d, const int *n, MPI_Datatype t, MPI_Op o, MPI_Comm c),
           (s, d, n, t, o, c))
COLLECTIVE(Reduce_scatter_block,
           bytes(std::int64_t(n) * n_ranks(c), t),
           (const void *s, void *d, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c),
           (s, d, n, t, o, c))
COLLECTIVE(
  Allgather,
  bytes(n, t),
  (const void *s, int n, MPI_Datatype t, void *d, int m, MPI_Datatype u, MPI_Comm c),
  (s, n, t, d, m, u, c))
COLLECTIVE(Allgatherv,
           bytes(n, t),
           (const void  *s,
            int          n,
            MPI_Datatype t,
            void        *d,
            const int   *m,
            const int   *at,
            MPI_Datatype u,
            MPI_Comm     c),
           (s, n, t, d, m, at, u, c))
COLLECTIVE(Gather,
           bytes(n, t),
           (const void  *s,
            int          n,
            MPI_Datatype t,
            void        *d,
            int          m,
            MPI_Datatype u,
            int          root,
            MPI_Comm     c),
           (s, n, t, d, m, u, root, c))
COLLECTIVE(Gatherv,
           bytes(n, t),
           (const void  *s,
            int          n,
            MPI_Datatype t,
            void        *d,
            const int   *m,
            const int   *at,
            MPI_Datatype u,
            int          root,
            MPI_Comm     c),
           (s, n, t, d, m, at, u, root, c))
COLLECTIVE(Scatter,
           is_root(root, c) ? bytes(std::int64_t(n) * n_ranks(c), t) : 0,
           (const void  *s,
            int          n,
            MPI_Datatype t,
            void        *d,
            int          m,
            MPI_Datatype u,
            int          root,
            MPI_Comm     c),
           (s, n, t, d, m, u, root, c))
COLLECTIVE(
  Alltoall,
  bytes(std::int64_t(n) * n_ranks(c), t),
  (const void *s, int n, MPI_Datatype t, void *d, int m, MPI_Datatype u, MPI_Comm c),
  (s, n, t, d, m, u, c))
COLLECTIVE(Alltoallv,
           bytes(sum(n, c), t),
           (const void  *s,
            const int   *n,
            const int   *from,
            MPI_Datatype t,
            void        *d,
            const int   *m,
            const int   *at,
            MPI_Datatype u,
            MPI_Comm     c),
           (s, n, from, t, d, m, at, u, c))
COLLECTIVE(Comm_dup, 0, (MPI_Comm c, MPI_Comm *d), (c, d))
COLLECTIVE(Comm_split,
           0,
           (MPI_Comm c, int color, int key, MPI_Comm *d),
           (c, color, key, d))
