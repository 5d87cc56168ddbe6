// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/dem_error.h>

#include <random>

#include "../mpi_counts.h"
#include "../say.h"
#include "small_column.h"

// Ranks know and wait for their neighbours only.

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector  = dealii::Tensor<1, 3>;
  namespace mpi = dealii::Utilities::MPI;

  bool
  is_alone()
  {
    return mpi::n_mpi_processes(MPI_COMM_WORLD) == 1;
  }

  DemParameters
  weightless(const std::string &ends)
  {
    DemParameters p     = SmallColumn::parameters();
    p.particles.gravity = 0.;
    p.walls.bottom = p.walls.top = ends;
    return p;
  }

  // Spheres on a lattice in the whole column, each with a velocity of its own.
  void
  let_fly(Dem &dem, const double speed)
  {
    std::mt19937             random(1);
    const auto               number = [&]() { return random() * 0x1p-31 - 1.; };
    std::vector<NewParticle> added;
    for (double z = 1.2e-3; z < 0.0289; z += 2.3e-3)
      for (const double x : {-1.3e-3, 1.3e-3})
        for (const double y : {-1.3e-3, 1.3e-3})
          {
            const Vector velocity({number(), number(), 3. * number()});
            added.push_back({Point<3>(x, y, z), 1e-3, speed * velocity});
          }
    dem.insert(added);
  }

  std::set<std::int64_t>
  own_ids(const Dem &dem)
  {
    const auto &ids = dem.particles().id;
    return {ids.begin(), ids.begin() + dem.particles().n_owned};
  }

  // Law: a gas whose spheres go from rank to rank within one advance, collide there and
  // on the border, and go through the ends, is the same bit by bit on any number of
  // ranks.
  TEST(NeighborRanks, AGasGoesThroughAllOfThem)
  {
    for (const std::string ends : {"closed", "periodic"})
      {
        SmallColumn alone(weightless(ends), MPI_COMM_SELF), together(weightless(ends));
        let_fly(alone.dem, 0.3);
        let_fly(together.dem, 0.3);
        const auto before = own_ids(together.dem);
        for (unsigned int n = 0; n < 3; ++n)
          {
            alone.dem.advance(0.02);
            together.dem.advance(0.02);
            EXPECT_EQ(alone.state(), together.state()) << ends;
          }
        EXPECT_EQ(alone.dem.coordination_number(), together.dem.coordination_number());
        if (!is_alone())
          {
            EXPECT_NE(own_ids(together.dem), before) << "nothing was handed over";
          }
        // The store finds them where they have gone.
        together.dem.synchronise();
        alone.dem.synchronise();
        EXPECT_EQ(alone.state(), together.state()) << ends;
      }
  }

  // Law: no substep has a collective, whatever happens in it; an advance ends with one;
  // a sort has the two of the library, that of a vessel in which all is at rest.
  TEST(NeighborRanks, NoSubstepWaitsForAll)
  {
    SmallColumn  column(weightless("closed"));
    const double substep = column.dem.substep();
    let_fly(column.dem, 0.3);
    column.dem.advance(0.01);
    const auto counted = [&](const unsigned int n) {
      const auto before = mpi_counts();
      column.dem.advance(n * substep);
      return mpi_counts() - before;
    };
    const auto lists = column.dem.n_list_builds();
    const auto one = counted(1), many = counted(1001);
    EXPECT_GT(mpi::max(column.dem.n_list_builds() - lists, MPI_COMM_WORLD), 3u);
    for (auto &[kind, of_kind] : many - one)
      if (kind != "message")
        {
          EXPECT_EQ(of_kind.calls, 0.) << kind;
        }
      else if (!is_alone())
        {
          EXPECT_GE(of_kind.calls, 1000.);
        }
    EXPECT_EQ(n_blocking_collectives(one), 1.);

    column.dem.synchronise();
    const auto before = mpi_counts();
    column.dem.synchronise();
    EXPECT_EQ(n_blocking_collectives(mpi_counts() - before), 2.);
  }

  // The problem of the earliest substep reaches all ranks, near ones and far ones, and is
  // the one that a single rank has; nobody waits for the rank that has stopped.
  TEST(NeighborRanks, AllStopForTheFirstProblem)
  {
    for (const bool first_at_top : {false, true})
      {
        const auto message = [&](MPI_Comm communicator) -> std::string {
          SmallColumn column(weightless("closed"), communicator);
          for (double z = 7e-3; z < 0.025; z += 2.2e-3)
            column.dem.insert({Point<3>(0., 0., z)}, Vector({0.01, 0., 0.}));
          // Pairs that meet at 80 m/s, one in the lowest and one in the highest rank.
          const auto pair = [&](const double z, const double gap) {
            for (const double side : {-1., 1.})
              column.dem.insert({NewParticle{Point<3>(side * (1e-3 + gap / 2.), 0., z),
                                             1e-3,
                                             Vector({side * -40., 0., 0.})}});
          };
          pair(0.0025, first_at_top ? 5e-3 : 2e-3);
          pair(0.0275, first_at_top ? 2e-3 : 5e-3);
          try
            {
              column.dem.advance(1e-3);
            }
          catch (const DemError &error)
            {
              return error.what();
            }
          return "none";
        };
        const std::string alone = message(MPI_COMM_SELF);
        EXPECT_NE(alone.find("overlaps"), std::string::npos) << alone;
        EXPECT_NE(alone.find(first_at_top ? "0.0275" : "0.0025"), std::string::npos)
          << alone;
        EXPECT_EQ(message(MPI_COMM_WORLD), alone);
      }
  }

  struct Sample
  {
    Point<3>     x;
    unsigned int rank;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &x &rank;
    }
  };

  // Points in the cells of each rank, from all ranks.
  std::vector<Sample>
  samples(const VesselMesh &mesh)
  {
    std::mt19937        random(mpi::this_mpi_process(MPI_COMM_WORLD));
    std::vector<Sample> mine, all;
    for (const auto &cell : mesh.owned_cells())
      for (unsigned int n = 0; n < 10; ++n)
        {
          const Point<3> at(random() * 0x1p-32, random() * 0x1p-32, random() * 0x1p-32);
          mine.push_back({mesh.mapping().transform_unit_to_real_cell(cell, at),
                          mpi::this_mpi_process(MPI_COMM_WORLD)});
        }
    for (const auto &of_rank : mpi::all_gather(MPI_COMM_WORLD, mine))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }

  // Against all pairs: who is within reach of a point of mine must see it, and the one in
  // whose cells it lies is at home there; also where cells are smaller than the reach, of
  // several sizes, and spread over the ranks by chance.
  TEST(Subdomains, EverybodyWithinReachIsKnown)
  {
    const unsigned int me = mpi::this_mpi_process(MPI_COMM_WORLD);
    for (const double reach : {7e-4, 4e-3})
      {
        VesselMesh mesh(
          SmallColumn::vessel(), SmallColumn::mesh_parameters(), MPI_COMM_WORLD);
        Subdomains subdomains(mesh, reach, Period());
        for (unsigned int pass = 0; pass < 2; ++pass)
          {
            const auto   all     = samples(mesh);
            unsigned int n_pairs = 0;
            for (const Sample &mine : all)
              if (mine.rank == me)
                for (const Sample &other : all)
                  if (other.rank != me && mine.x.distance(other.x) < reach)
                    {
                      ++n_pairs;
                      const auto *at = subdomains.surroundings(mine.x);
                      ASSERT_NE(at, nullptr);
                      EXPECT_TRUE(at->is_home);
                      EXPECT_EQ(
                        std::count(at->seen_by.begin(), at->seen_by.end(), other.rank),
                        1);
                    }
            n_pairs = mpi::sum(n_pairs, MPI_COMM_WORLD);
            say() << "reach " << reach << " m: " << n_pairs << " pairs\n";
            if (!is_alone())
              {
                EXPECT_GT(n_pairs, 20u);
              }
            std::vector<Point<3>> points;
            for (const Sample &sample : all)
              points.push_back(sample.x);
            const auto ranks = subdomains.ranks_at(points);
            for (std::size_t k = 0; k < all.size() && !is_alone(); ++k)
              EXPECT_EQ(std::count(ranks[k].begin(), ranks[k].end(), all[k].rank), 1);

            dealii::Vector<float> errors(mesh.triangulation().n_active_cells());
            for (unsigned int k = 0; k < errors.size(); ++k)
              errors[k] = (k * 7919) % 101;
            mesh.mark_by(errors, 0.2, 0.);
            mesh.prepare_adaption();
            mesh.adapt([](const auto &, const auto) { return 1; });
            subdomains.update();
          }
      }
  }
} // namespace
