// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/bed_correlations.h>
#include <graupel/coupling/exchange.h>
#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // Without a random number: the fractional parts of n times powers of a quadratic or
  // cubic irrational fill an interval (a cube) evenly. Source: Roberts (2018), after
  // Weyl (1916).
  double
  even(const unsigned int n, const unsigned int coordinate)
  {
    constexpr double plastic = 1.22074408460575947536;
    return std::fmod(0.5 + n * std::pow(plastic, -1. - coordinate), 1.);
  }

  // The steady flow through an even bed with a flat top in the lower part of a column:
  // many small resting spheres, so that the filter sees no single one.
  struct FlatBed
  {
    static constexpr double diameter = 0.025, height = 0.09, bed_height = 0.05;
    static constexpr double particle = 1.6e-3, alpha = 0.4, velocity = 0.4;

    FlatBed()
      : mesh({diameter, height}, {3.2e-3, 1.6e-3}, MPI_COMM_WORLD)
      , nodes(mesh)
      , dem({}, mesh, costs)
    {
      const double section = mesh.cylinder().cross_section();
      const auto   n     = static_cast<unsigned int>((1. - alpha) * section * bed_height /
                                               sphere_volume(0.5 * particle));
      const double reach = 0.5 * diameter * 0.997;
      std::vector<dealii::Point<3>> positions;
      for (unsigned int i = 1; i <= n; ++i)
        {
          const double r = reach * std::sqrt(even(i, 0));
          const double a = 2. * dealii::numbers::PI * even(i, 1);
          positions.emplace_back(
            r * std::cos(a), r * std::sin(a), bed_height * even(i, 2));
        }
      dem.insert(positions);
      dem.synchronise();
    }

    double
    pressure_drop(const double filter_length, const LawVoidFraction &law)
    {
      DragParameters choice;
      choice.law = "ergun";
      Exchange       exchange(filter_length,
                        true,
                        law,
                        {{Drag(choice, fluid, particle, 1.), 0.5 * particle}},
                        nodes,
                        costs);
      FlowParameters parameters;
      parameters.linear_tolerance = 1e-9;
      FlowSolver flow(parameters, fluid.density, fluid.viscosity, nodes, costs);
      flow.set_superficial_velocity(velocity);
      for (unsigned int n = 0; n < 12; ++n)
        {
          exchange.update_bed(dem.store(), dem.particles());
          exchange.update_drag(dem.particles());
          flow.step(exchange.medium(), FlowSolver::steady);
          exchange.forces(dem.particles(), flow, fluid.density, {});
          EXPECT_LE(exchange.momentum_imbalance(), 1e-10);
        }
      return flow.mean_pressure(VesselMesh::bottom) - flow.mean_pressure(VesselMesh::top);
    }

    double
    ergun(const double void_fraction, const double length) const
    {
      return ergun_pressure_drop(fluid, particle, void_fraction, velocity, length);
    }

    FluidProperties fluid;
    CostSheet       costs;
    VesselMesh      mesh;
    NodalSpace      nodes;
    Dem             dem;
  };
} // namespace

TEST(BedSurface, SharpGivesErgunForTheWholeBedWhateverTheFilter)
{
  FlatBed      bed;
  const double expected = bed.ergun(FlatBed::alpha, FlatBed::bed_height);
  for (const double length : {2e-3, 3e-3})
    {
      const double sharp   = bed.pressure_drop(length, {true, 1.});
      const double smeared = bed.pressure_drop(length, {false, 1.});
      // 0.9 % of it is the bed itself, whose spheres keep off the wall.
      EXPECT_NEAR(sharp / expected, 1., 0.03) << "filter length " << length;
      // 1.1 standard deviations of the filter are lost (doc/design.md).
      const double lost = 1.13 * std::sqrt(2.) * length / FlatBed::bed_height;
      EXPECT_NEAR(smeared / expected, 1. - lost, 0.3 * lost)
        << "filter length " << length;
    }
}

TEST(BedSurface, AnotherSolidFractionGivesTheDropOfThatBedOfTheSameMass)
{
  FlatBed      bed;
  const double same = bed.pressure_drop(2e-3, {true, 1.});
  for (const double ratio : {0.95, 1.05})
    {
      const double alpha    = 1. - ratio * (1. - FlatBed::alpha);
      const double expected = bed.ergun(alpha, FlatBed::bed_height / ratio) /
                              bed.ergun(FlatBed::alpha, FlatBed::bed_height);
      EXPECT_NEAR(
        bed.pressure_drop(2e-3, {true, ratio}) / same, expected, 4e-3 * expected)
        << "ratio " << ratio;
    }
}
