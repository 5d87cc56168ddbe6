#include <graupel/dem/verlet_list.h>

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
          particles.id[i]       = (i * 37) % n;
          particles.radius[i]   = 0.5e-3 * (1. + 2. * unit(generator));
          particles.position[i] = dealii::Point<3>(0.02 * unit(generator) - 0.01,
                                                   0.02 * unit(generator) - 0.01,
                                                   0.04 * unit(generator));
        }
    }

    bool
    near(const unsigned int i, const unsigned int j, const double beyond) const
    {
      return particles.position[i].distance(particles.position[j]) <
             particles.radius[i] + particles.radius[j] + beyond;
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

    std::mt19937            generator{7};
    ParticleArrays          particles;
    const double            skin  = 0.5e-3;
    const std::vector<Wall> walls = vessel_walls({0.024, 0.042});
  };

  // The list is the set of all pairs within the sum of radii plus skin, each
  // once and from the lower id to the higher.
  TEST_F(VerletListTest, EqualsBruteForce)
  {
    VerletList list(skin);
    list.build(particles, walls);
    const auto expected = brute_force(skin);
    EXPECT_GT(expected.size(), 500u);
    EXPECT_EQ(as_set(list.pairs), expected);
    EXPECT_EQ(list.pairs.size(), expected.size());
    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        unsigned int n = 0;
        for (unsigned int i = 0; i < particles.n_owned; ++i)
          n += walls[w].at(particles.position[i]).distance < particles.radius[i] + skin;
        EXPECT_EQ(list.wall_rows[w].size(), n);
      }
  }

  // While nobody has moved by more than half the skin, every touching pair is
  // in the list.
  TEST_F(VerletListTest, HoldsUnderMotion)
  {
    VerletList                       list(skin);
    std::normal_distribution<double> normal;
    for (unsigned int round = 0; round < 20; ++round)
      {
        list.build(particles, walls);
        for (auto &x : particles.position)
          {
            dealii::Tensor<1, 3> direction(
              {normal(generator), normal(generator), normal(generator)});
            x += 0.499 * skin / direction.norm() * direction;
          }
        const auto listed = as_set(list.pairs);
        for (const auto &pair : brute_force(0.))
          EXPECT_EQ(listed.count(pair), 1u);
      }
  }

  // A rank without particles of its own has nothing to list.
  TEST_F(VerletListTest, Empty)
  {
    particles.resize(0);
    particles.n_owned = 0;
    VerletList list(skin);
    list.build(particles, walls);
    EXPECT_TRUE(list.pairs.empty());
    EXPECT_EQ(list.wall_rows.size(), walls.size());
  }
} // namespace
