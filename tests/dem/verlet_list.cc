// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/contacts/verlet_list.h>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{
  using namespace graupel;

  class VerletListTest : public testing::Test
  {
  protected:
    // Spheres of 1 to 3 mm thrown into a box; ids in no order; the last ones
    // play ghosts.
    VerletListTest()
    {
      const unsigned int n = 600;
      particles.resize(n);
      particles.n_owned = 450;
      std::uniform_real_distribution<double> unit(0., 1.);
      for (unsigned int i = 0; i < n; ++i)
        {
          particles.id[i]            = (i * 37) % n;
          particles.body[i].radius   = 0.5e-3 * (1. + 2. * unit(generator));
          particles.body[i].position = dealii::Point<3>(0.02 * unit(generator) - 0.01,
                                                        0.02 * unit(generator) - 0.01,
                                                        0.04 * unit(generator));
        }
    }

    bool
    near(const unsigned int i, const unsigned int j, const double beyond) const
    {
      return particles.body[i].position.distance(particles.body[j].position) <
             particles.body[i].radius + particles.body[j].radius + beyond;
    }

    using Pairs = std::set<std::pair<unsigned int, unsigned int>>;

    Pairs
    brute_force(const double beyond) const
    {
      Pairs pairs;
      for (unsigned int i = 0; i < particles.n_rows(); ++i)
        for (unsigned int j = i + 1; j < particles.n_rows(); ++j)
          if (i < particles.n_owned && near(i, j, beyond))
            pairs.insert(particles.id[i] < particles.id[j] ? std::make_pair(i, j)
                                                           : std::make_pair(j, i));
      return pairs;
    }

    static Pairs
    as_set(const std::vector<NeighborPair> &list)
    {
      Pairs pairs;
      for (const auto &pair : list)
        pairs.insert({pair.first, pair.second});
      return pairs;
    }

    Pairs
    all_pairs() const
    {
      Pairs pairs = as_set(list.near);
      pairs.merge(as_set(list.far));
      return pairs;
    }

    TouchingRows
    no_contacts() const
    {
      return {std::vector<std::uint32_t>(particles.n_rows() + 1, 0), {}};
    }

    std::mt19937            generator{7};
    ParticleArrays          particles;
    const double            skin = 0.5e-3, near_skin = 0.1e-3;
    const std::vector<Wall> walls = vessel_walls({0.024, 0.042});
    VerletList              list{skin, near_skin};
  };

  // The list is the set of all pairs within the sum of radii plus skin, but for
  // contacts, each once and from the lower id to the higher; the near ones are
  // those within the near skin.
  TEST_F(VerletListTest, EqualsBruteForce)
  {
    list.build(particles, walls, no_contacts());
    const auto expected = brute_force(skin);
    EXPECT_GT(expected.size(), 500u);
    EXPECT_EQ(all_pairs(), expected);
    EXPECT_EQ(list.near.size() + list.far.size(), expected.size());
    EXPECT_EQ(as_set(list.near), brute_force(near_skin));
    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        unsigned int n = 0;
        for (unsigned int i = 0; i < particles.n_owned; ++i)
          n +=
            walls[w].is_near(particles.body[i].position, particles.body[i].radius + skin);
        EXPECT_EQ(list.wall_rows[w].size(), n);
      }
  }

  // Pairs that are contacts already stay out.
  TEST_F(VerletListTest, ContactsAreNotListed)
  {
    TouchingRows                            touching    = no_contacts();
    const auto                              overlapping = brute_force(0.);
    std::vector<std::vector<std::uint32_t>> partners(particles.n_rows());
    for (const auto &[i, j] : overlapping)
      {
        partners[i].push_back(j);
        partners[j].push_back(i);
      }
    for (unsigned int i = 0; i < particles.n_rows(); ++i)
      {
        for (const auto j : partners[i])
          touching.partners.push_back(j);
        touching.starts[i + 1] = touching.partners.size();
      }
    list.build(particles, walls, touching);
    EXPECT_GT(overlapping.size(), 10u);
    const auto listed = all_pairs();
    for (const auto &pair : overlapping)
      EXPECT_EQ(listed.count(pair), 0u);
    EXPECT_EQ(listed.size(), brute_force(skin).size() - overlapping.size());
  }

  // While nobody is farther than half the skin from where it was listed, every
  // touching pair is in the list; whether all or a few are listed anew, and with
  // the near pairs sorted out as often as the near skin asks.
  TEST_F(VerletListTest, HoldsUnderMotion)
  {
    std::normal_distribution<double> normal;
    for (unsigned int round = 0; round < 200; ++round)
      {
        list.build(particles, walls, no_contacts());
        EXPECT_LE(list.largest_move(particles), 0.25 * skin);
        // Only some move, so that only some are listed anew.
        for (unsigned int i = round % 3; i < particles.n_rows(); i += 3)
          {
            dealii::Tensor<1, 3> direction(
              {normal(generator), normal(generator), normal(generator)});
            particles.body[i].position += 0.2499 * skin / direction.norm() * direction;
          }
        const auto listed = all_pairs();
        for (const auto &pair : brute_force(0.))
          EXPECT_EQ(listed.count(pair), 1u);
        EXPECT_EQ(listed.size(), list.near.size() + list.far.size());

        list.sort_by_distance(particles);
        EXPECT_EQ(all_pairs(), listed);
        const auto near = as_set(list.near);
        for (const auto &pair : brute_force(0.999 * near_skin))
          EXPECT_EQ(near.count(pair), listed.count(pair));
      }
  }

  // A rank without particles of its own has nothing to list.
  TEST_F(VerletListTest, Empty)
  {
    particles.resize(0);
    particles.n_owned = 0;
    list.build(particles, walls, no_contacts());
    EXPECT_TRUE(all_pairs().empty());
    EXPECT_EQ(list.wall_rows.size(), walls.size());
  }
} // namespace
