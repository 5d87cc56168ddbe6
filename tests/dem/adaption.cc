// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

using namespace graupel;

namespace
{
  // Refines the lower half of the column, or coarsens all that is refined.
  void
  mark(VesselMesh &mesh, const bool refine)
  {
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (refine && cell->center()[2] < 0.015)
            cell->set_refine_flag();
          if (!refine && cell->level() > mesh.base_level())
            cell->set_coarsen_flag();
        }
    mesh.prepare_adaption();
  }
} // namespace

TEST(Adaption, ChangesNoBitOfTheMotion)
{
  // Particles that fall, touch and slide, their contacts with springs: one column is
  // refined, coarsened and divided anew among the ranks on the way, its twin is not.
  const auto fill = [](SmallColumn &column) {
    std::vector<dealii::Point<3>> positions;
    for (unsigned int k = 0; k < 40; ++k)
      positions.push_back({2.1e-3 * (static_cast<int>(k % 2) - 0.4),
                           2.1e-3 * (static_cast<int>(k / 2 % 2) - 0.6),
                           1.1e-3 + 2.3e-3 * (k / 4)});
    column.dem.insert(positions);
  };
  SmallColumn adapted(SmallColumn::parameters()), twin(SmallColumn::parameters());
  fill(adapted);
  fill(twin);
  const unsigned int n_coarse = adapted.mesh.triangulation().n_global_active_cells();
  for (unsigned int n = 0; n < 10; ++n)
    {
      mark(adapted.mesh, n % 2 == 0);
      adapted.dem.adapt_mesh(0.1);
      const unsigned int n_cells = adapted.mesh.triangulation().n_global_active_cells();
      if (n % 2 == 0)
        {
          EXPECT_GT(n_cells, n_coarse);
        }
      else
        {
          EXPECT_EQ(n_cells, n_coarse);
        }
      EXPECT_EQ(adapted.dem.n_global(), 40u);
      adapted.dem.advance(1e-2);
      twin.dem.advance(1e-2);
      for (std::int64_t id = 0; id < 40; ++id)
        for (unsigned int i = 0; i < 3; ++i)
          {
            EXPECT_EQ(adapted.position(id)[i], twin.position(id)[i]) << "particle " << id;
            EXPECT_EQ(adapted.velocity(id)[i], twin.velocity(id)[i]) << "particle " << id;
          }
    }
  EXPECT_GT(twin.dem.coordination_number(), 1.) << "without contacts this shows nothing";
}
