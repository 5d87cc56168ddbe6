// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/profiles.h>

#include <gtest/gtest.h>

using namespace graupel;

TEST(Profiles, AverageLinearFieldsExactly)
{
  // p = 5 - 100 z: every slab's mean pressure is that of its mean height, and
  // the value between two slabs is linear.
  const VesselMesh mesh({0.025, 0.05}, {3.2e-3, 0.}, MPI_COMM_WORLD);
  const NodalSpace nodes(mesh);
  NodalVector      pressure, alpha, flux;
  for (NodalVector *vector : {&pressure, &alpha, &flux})
    nodes.initialize(*vector);
  const auto &partitioner = *nodes.measure().get_partitioner();
  for (const auto &cell : nodes.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
        if (const auto node = cell->vertex_dof_index(v, 0);
            partitioner.in_local_range(node))
          pressure(node) = 5. - 100. * cell->vertex(v)[2];
  alpha = 0.4;
  flux  = 0.3;
  for (NodalVector *vector : {&pressure, &alpha, &flux})
    vector->update_ghost_values();
  const FlowFields fields{nodes, alpha, flux, pressure};

  const auto axial  = axial_profile(fields, 16);
  double     volume = 0.;
  for (const RegionMean &slab : axial)
    {
      EXPECT_NEAR(slab.pressure, 5. - 100. * slab.height, 1e-12);
      EXPECT_NEAR(slab.void_fraction, 0.4, 1e-12);
      EXPECT_NEAR(slab.flux, 0.3, 1e-12);
      volume += slab.volume;
    }
  EXPECT_NEAR(volume, mesh.cylinder().cross_section() * 0.05, 1e-3 * volume);
  EXPECT_NEAR(pressure_at(axial, 0.0217), 5. - 2.17, 1e-10);

  double annuli = 0.;
  for (const RegionMean &annulus : radial_profile(fields, 6, 0., 0.05))
    annuli += annulus.volume;
  EXPECT_NEAR(annuli, volume, 1e-12 * volume);

  MidPlane   middle(mesh, 11);
  const auto plane = middle.values(fields);
  for (const PlanePoint &point : plane)
    EXPECT_NEAR(point.pressure, 5. - 100. * point.z, 1e-6);
  const unsigned int n_points =
    dealii::Utilities::MPI::sum<unsigned int>(plane.size(), MPI_COMM_WORLD);
  EXPECT_EQ(n_points % 11, 0u);
  EXPECT_GE(n_points, 11u * 20u);
}

TEST(WallChannelling, IsNothingInAnEvenBedAndLessDropInAnUnevenOne)
{
  const FluidProperties fluid;
  RegionMean            annulus;
  annulus.volume        = 1.;
  annulus.void_fraction = 0.4;
  EXPECT_NEAR(
    wall_channelling_deviation({annulus, annulus}, fluid, 1.6e-3, 0.4, 0.4), 0., 1e-12);
  RegionMean loose = annulus, dense = annulus;
  loose.void_fraction = 0.45;
  dense.void_fraction = 0.35;
  const double deviation =
    wall_channelling_deviation({loose, dense}, fluid, 1.6e-3, 0.4, 0.4);
  EXPECT_LT(deviation, -0.01);
  EXPECT_GT(deviation, -0.2);
}
