// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "tube.h"

#include <graupel/base/parameters.h>

using namespace graupel;

namespace
{
  // A short column of air for spheres of 2 mm.
  Tube::Settings
  column(const double filter_length, const double cell = 2e-3, const double velocity = 0.)
  {
    Tube::Settings settings;
    settings.diameter      = 0.012;
    settings.height        = 0.02;
    settings.cell          = cell;
    settings.fluid         = {};
    settings.velocity      = velocity;
    settings.filter_length = filter_length;
    settings.gravity       = {};
    return settings;
  }
} // namespace

TEST(FewParticles, WithoutAnyTheFluidIsClear)
{
  for (const bool shares_pressure : {true, false})
    for (const bool answering : {true, false})
      {
        auto settings            = column(1.4e-3, 2e-3, 0.3);
        settings.shares_pressure = shares_pressure;
        Tube tube(settings, {});
        for (unsigned int n = 0; n < 6; ++n)
          if (answering)
            tube.step_fluid(1e-3,
                            [](const unsigned int) { return dealii::Tensor<1, 3>(); });
          else
            tube.step_fluid(FlowSolver::steady);
        const Exchange &exchange = tube.exchange;
        for (unsigned int k = 0; k < tube.nodes.measure().locally_owned_size(); ++k)
          {
            EXPECT_EQ(exchange.medium().void_fraction.local_element(k), 1.);
            EXPECT_EQ(exchange.medium().drag.local_element(k), 0.);
          }
        EXPECT_TRUE(tube.dem.particles().external_force.empty());
        EXPECT_EQ(exchange.total_force().norm(), 0.);
        EXPECT_EQ(exchange.solid_volume_error(), 0.);
        EXPECT_EQ(exchange.momentum_imbalance(), 0.);
        EXPECT_TRUE(std::isinf(exchange.stable_step(tube.dem.particles())));
        EXPECT_NEAR(tube.flow.outflow() / tube.flow.inflow(), 1., 1e-8);
      }
}

TEST(FewParticles, OneFeelsTheLawInClearFluidWhateverTheMesh)
{
  // Held in the middle of the column, with the default filter. What is left is the
  // section that it takes from the column, some 2 %.
  const double velocity = 1.;
  for (const double cell : {4e-3, 2e-3, 1e-3})
    {
      const auto settings = column(2e-3 / std::sqrt(2.), cell, velocity);
      Tube       tube(settings, {dealii::Point<3>(0.3e-3, -0.4e-3, 0.0105)});
      for (unsigned int n = 0; n < 6; ++n)
        tube.step_fluid(FlowSolver::steady);
      const double expected =
        settings.drag().beta(1., velocity, 0.5 * settings.particle) * velocity;
      const double force = tube.exchange.total_force()[2];
      std::cout << "cells of " << cell << " m: " << force << " N of " << expected << " N"
                << std::endl;
      EXPECT_NEAR(force, expected, 0.03 * expected) << cell;
      EXPECT_LE(tube.exchange.solid_volume_error(), 1e-12);
    }
}

TEST(FewParticles, ItsOwnMarkIsKnownOnALattice)
{
  // The cells in the middle of the cylinder are nearly a lattice: 5e-3.
  for (const unsigned int times : {1u, 2u})
    {
      const double length = 6e-4;
      Tube tube(column(length, 5e-4), {dealii::Point<3>(0.3e-3, -0.4e-3, 0.0105)});
      const Filter     filter(tube.nodes, length);
      ParticleTransfer transfer(tube.nodes);
      transfer.update(tube.dem.store());
      NodalVector mark, field;
      tube.nodes.initialize(mark);
      tube.nodes.initialize(field);
      transfer.deposit(field, std::vector<double>(tube.dem.particles().n_owned, 1.));
      filter.spread(mark, field);
      for (unsigned int n = 1; n < times; ++n)
        {
          filter.smooth(field, mark);
          mark.swap(field);
        }
      const auto found = transfer.sample(mark);
      for (unsigned int row = 0; row < found.size(); ++row)
        {
          const auto  &place = transfer.places()[row];
          const double expected =
            OwnMark(length, times, transfer.edges()[place.cell]).density(place.x);
          EXPECT_NEAR(found[row] / expected, 1., 5e-3) << found[row];
        }
      if (times > 1)
        continue;
      const auto gradient = transfer.sample_gradient(mark);
      for (unsigned int row = 0; row < found.size(); ++row)
        {
          const auto &place = transfer.places()[row];
          const auto  expected =
            place.by_x *
            OwnMark(length, times, transfer.edges()[place.cell]).slopes(place.x);
          EXPECT_LT((gradient[row] - expected).norm(), 0.05 * gradient[row].norm());
          EXPECT_GT(gradient[row].norm(), 10. * found[row]);
        }
    }
}

TEST(FewParticles, AGradientIsThatOfALinearField)
{
  Tube tube(
    column(1.4e-3),
    {dealii::Point<3>(0.3e-3, -0.4e-3, 0.0105), dealii::Point<3>(2.1e-3, 3.2e-3, 0.006)});
  ParticleTransfer transfer(tube.nodes);
  transfer.update(tube.dem.store());
  const dealii::Tensor<1, 3> slope({3., -2., 5.});
  NodalVector                field;
  tube.nodes.initialize(field);
  for (const auto &cell : tube.nodes.owned_cells())
    for (const unsigned int a : cell->vertex_indices())
      if (const auto k = cell->vertex_dof_index(a, 0); tube.nodes.owned.is_element(k))
        field(k) = slope * cell->vertex(a);
  field.update_ghost_values();
  for (const auto &found : transfer.sample_gradient(field))
    EXPECT_LT((found - slope).norm(), 1e-10);
}

TEST(FewParticles, AFilterThatDoesNotSpreadThemIsNamed)
{
  // A sphere of 2 mm on cells of 1 mm without a filter takes more than all of a node.
  Tube tube(column(0., 1e-3), {dealii::Point<3>(0., 0., 0.01)});
  try
    {
      tube.exchange.update_bed(tube.dem.store(), tube.dem.particles());
      FAIL() << "a void fraction below 0 passed";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.parameter, "Coupling/filter length");
      const std::string what = error.what();
      EXPECT_NE(what.find("Mesh/cell size"), std::string::npos) << what;
    }
}
