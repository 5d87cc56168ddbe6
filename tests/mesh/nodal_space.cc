// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/mesh/nodal_space.h>

#include <gtest/gtest.h>

// Hanging nodes lie between others, on any number of ranks.

using namespace graupel;

namespace
{
  double
  noise(const dealii::types::global_dof_index k)
  {
    return std::sin(12.9898 * k) * 43.5453 - std::floor(std::sin(12.9898 * k) * 43.5453);
  }

  void
  fill(NodalVector &vector)
  {
    for (const auto k : vector.locally_owned_elements())
      vector(k) = noise(k);
  }
} // namespace

TEST(NodalSpace, HangingNodesAreSetAsAffineConstraintsSetThem)
{
  VesselMesh mesh({0.025, 0.05}, {6.4e-3, 0.}, MPI_COMM_WORLD);
  for (unsigned int n = 0; n < 4; ++n)
    {
      const NodalSpace nodes(mesh);
      NodalVector      ours, theirs;
      for (NodalVector *vector : {&ours, &theirs})
        {
          nodes.initialize(*vector);
          fill(*vector);
        }
      nodes.distribute(ours);
      nodes.hanging_nodes.distribute(theirs);
      theirs.update_ghost_values();
      const auto &partitioner = *nodes.measure().get_partitioner();
      for (unsigned int k = 0;
           k < partitioner.locally_owned_size() + partitioner.n_ghost_indices();
           ++k)
        EXPECT_NEAR(ours.local_element(k), theirs.local_element(k), 1e-15);
      // The first mesh has none; the others have more and more.
      const unsigned int n_hanging =
        dealii::Utilities::MPI::sum(nodes.hanging_nodes.n_constraints(), MPI_COMM_WORLD);
      EXPECT_EQ(n_hanging > 0, n > 0);
      // A second time changes nothing.
      const NodalVector before(ours);
      nodes.distribute(ours);
      for (unsigned int k = 0; k < partitioner.locally_owned_size(); ++k)
        EXPECT_EQ(ours.local_element(k), before.local_element(k));

      mesh.clear_marks();
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->center().distance(dealii::Point<3>(0.004, 0.002, 0.02)) < 0.012 / (n + 1.))
          cell->set_refine_flag();
      mesh.prepare_adaption();
      mesh.adapt([](const auto &, const auto) { return 1000u; });
    }
}
