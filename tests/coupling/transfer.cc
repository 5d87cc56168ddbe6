// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/coupling/exchange.h>
#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

#include <random>

using namespace graupel;

namespace
{
  // A short column with 300 spheres of 3.2 mm thrown in at random, overlapping
  // or not: the transfer does not care.
  struct RandomPacking
  {
    // With @p local, one half of the bed's height is refined on one side.
    explicit RandomPacking(const double length = 2e-3, const bool local = false)
      : mesh({0.025, 0.05}, {3.2e-3, 0.}, MPI_COMM_WORLD)
      , nodes(local ? refined(mesh) : mesh)
      , dem(parameters(), mesh, costs)
      , filter(nodes, length)
      , transfer(nodes)
    {
      std::mt19937                           generator(7);
      std::uniform_real_distribution<double> uniform(0., 1.);
      std::vector<dealii::Point<3>>          positions;
      while (positions.size() < 300)
        {
          const dealii::Point<3> x(0.025 * uniform(generator) - 0.0125,
                                   0.025 * uniform(generator) - 0.0125,
                                   0.0016 + 0.03 * uniform(generator));
          if (std::hypot(x[0], x[1]) < 0.0109)
            positions.push_back(x);
        }
      dem.insert(positions);
      dem.synchronise();
      transfer.update(dem.store());
      for (unsigned int i = 0; i < 3; ++i)
        nodes.initialize(field[i]);
    }

    static const VesselMesh &
    refined(VesselMesh &mesh)
    {
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[0] > 0. &&
            cell->center()[2] > 0.01 && cell->center()[2] < 0.025)
          cell->set_refine_flag();
      mesh.prepare_adaption();
      mesh.adapt([](const auto &, const auto) { return 1000u; });
      return mesh;
    }

    static DemParameters
    parameters()
    {
      DemParameters result;
      result.particles.scale = 2.;
      return result;
    }

    // A number for each particle or node that does not depend on the ranks.
    static double
    noise(const double seed)
    {
      return std::sin(12.9898 * seed) + 1.5;
    }

    NodalVector
    noisy_field()
    {
      NodalVector result;
      nodes.initialize(result);
      for (unsigned int k = 0; k < result.locally_owned_size(); ++k)
        result.local_element(k) =
          noise(1000. * nodes.measure().local_element(k) * 1e9 + k);
      nodes.hanging_nodes.distribute(result);
      result.update_ghost_values();
      return result;
    }

    std::vector<double>
    noisy_values() const
    {
      std::vector<double> result;
      for (unsigned int row = 0; row < dem.particles().n_owned; ++row)
        result.push_back(noise(dem.particles().id[row]));
      return result;
    }

    // Sum over the nodes of m_k a_k b_k.
    double
    product(const NodalVector &a, const NodalVector &b) const
    {
      double sum = 0.;
      for (unsigned int k = 0; k < a.locally_owned_size(); ++k)
        sum += nodes.measure().local_element(k) * a.local_element(k) * b.local_element(k);
      return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    }

    CostSheet        costs;
    VesselMesh       mesh;
    NodalSpace       nodes;
    Dem              dem;
    Filter           filter;
    ParticleTransfer transfer;
    NodalVectorField field;
  };
} // namespace

TEST(Filter, KeepsConstants)
{
  for (const bool local : {false, true})
    {
      RandomPacking packing(2e-3, local);
      NodalVector   constant, result;
      packing.nodes.initialize(constant);
      packing.nodes.initialize(result);
      constant = 3.7;
      packing.filter.smooth(result, constant);
      result.add(-3.7);
      EXPECT_LE(result.linfty_norm(), 1e-12);
    }
}

TEST(Filter, IsSelfAdjointInTheNodesVolumes)
{
  for (const bool local : {false, true})
    {
      RandomPacking     packing(2e-3, local);
      const NodalVector a = packing.noisy_field();
      NodalVector       b(a), smooth_a(a), smooth_b(a);
      for (unsigned int k = 0; k < b.locally_owned_size(); ++k)
        b.local_element(k) = RandomPacking::noise(7. * k + 0.3);
      packing.nodes.hanging_nodes.distribute(b);
      packing.filter.smooth(smooth_a, a);
      packing.filter.smooth(smooth_b, b);
      const double left  = packing.product(b, smooth_a),
                   right = packing.product(a, smooth_b);
      EXPECT_NEAR(left, right, 1e-12 * std::abs(left));
    }
}

TEST(Filter, SpreadsByTheGaussianOfItsLength)
{
  // A sheet of volume at mid-height spreads along the axis with the variance
  // 2 l^2. On a lattice it does so exactly; here the corner quadrature sees the
  // curved cells 1.7 % smaller than they are.
  const double        length = 2e-3;
  RandomPacking       packing(length);
  NodalVector         sheet, result;
  std::vector<double> moments(3, 0.);
  packing.nodes.initialize(sheet);
  packing.nodes.initialize(result);
  const auto &partitioner = *packing.nodes.measure().get_partitioner();
  std::map<dealii::types::global_dof_index, double> heights;
  for (const auto &cell : packing.nodes.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
        heights[cell->vertex_dof_index(v, 0)] = cell->vertex(v)[2];
  for (const auto &[node, z] : heights)
    if (partitioner.in_local_range(node) && std::abs(z - 0.025) < 1e-6)
      sheet(node) = 1.;
  packing.filter.smooth(result, sheet);
  for (const auto &[node, z] : heights)
    if (partitioner.in_local_range(node))
      for (unsigned int power = 0; power < 3; ++power)
        moments[power] +=
          packing.nodes.measure()(node) * result(node) * std::pow(z - 0.025, power);
  dealii::Utilities::MPI::sum(moments, MPI_COMM_WORLD, moments);
  EXPECT_GT(moments[0], 0.);
  const double variance = moments[2] / moments[0];
  std::cout << "variance " << variance << " of " << 2. * length * length
            << " m^2, degree " << packing.filter.degree() << std::endl;
  EXPECT_NEAR(variance, 2. * length * length, 0.03 * variance);
  EXPECT_NEAR(moments[1] / moments[0], 0., 1e-9);
}

TEST(Filter, OfLengthZeroIsTheIdentity)
{
  RandomPacking     packing(0.);
  const NodalVector field = packing.noisy_field();
  NodalVector       result(field);
  packing.filter.smooth(result, field);
  result.add(-1., field);
  EXPECT_EQ(result.linfty_norm(), 0.);
}

TEST(ParticleTransfer, DepositsEverythingAndSamplesConstants)
{
  RandomPacking             packing;
  const std::vector<double> values = packing.noisy_values();
  NodalVector               sums;
  packing.nodes.initialize(sums);
  packing.transfer.deposit(sums, values);
  double on_nodes = 0., on_particles = 0.;
  for (unsigned int k = 0; k < sums.locally_owned_size(); ++k)
    on_nodes += sums.local_element(k);
  for (const double value : values)
    on_particles += value;
  on_nodes     = dealii::Utilities::MPI::sum(on_nodes, MPI_COMM_WORLD);
  on_particles = dealii::Utilities::MPI::sum(on_particles, MPI_COMM_WORLD);
  EXPECT_GT(on_particles, 100.);
  EXPECT_NEAR(on_nodes, on_particles, 1e-12 * on_particles);

  NodalVector constant;
  packing.nodes.initialize(constant);
  constant = 2.5;
  constant.update_ghost_values();
  const auto sampled = packing.transfer.sample(constant);
  ASSERT_EQ(sampled.size(), packing.dem.particles().n_owned);
  for (const double value : sampled)
    EXPECT_NEAR(value, 2.5, 1e-12);
}

TEST(ParticleTransfer, IsAdjointWithTheFilter)
{
  // Sum over particles of b_p (W S f)_p is the sum over nodes of
  // m_k f_k (S M^-1 W^T b)_k, for any b and f.
  RandomPacking             packing;
  const std::vector<double> values = packing.noisy_values();
  const NodalVector         field  = packing.noisy_field();
  NodalVector               sums(field), spread(field), smooth(field);
  packing.transfer.deposit(sums, values);
  packing.filter.spread(spread, sums);
  const double on_nodes = packing.product(field, spread);

  packing.filter.smooth(smooth, field);
  const auto sampled      = packing.transfer.sample(smooth);
  double     on_particles = 0.;
  for (unsigned int row = 0; row < values.size(); ++row)
    on_particles += values[row] * sampled[row];
  on_particles = dealii::Utilities::MPI::sum(on_particles, MPI_COMM_WORLD);
  EXPECT_NEAR(on_nodes, on_particles, 1e-12 * std::abs(on_nodes));
}

namespace
{
  void
  keeps_its_ledger(const bool shares_pressure,
                   const bool local,
                   const bool answering = false)
  {
    // Solid volume to 1e-12, momentum to 1e-10, with particles in motion; and the
    // bed as a whole feels the pressure drop: with slip at the wall and as much
    // momentum entering as leaving, the force on it is the drop times the area.
    RandomPacking              packing(2e-3, local);
    const FluidProperties      fluid;
    const dealii::Tensor<1, 3> gravity({0., 0., -9.81});
    for (unsigned int row = 0; row < packing.dem.particles().n_owned; ++row)
      for (unsigned int i = 0; i < 3; ++i)
        packing.dem.particles().body[row].velocity[i] =
          0.01 * RandomPacking::noise(packing.dem.particles().id[row] + 0.1 * i);
    Exchange   exchange(3e-3,
                      shares_pressure,
                      {},
                      {{Drag({}, fluid, 1.6e-3, 2.), 1.6e-3}},
                      packing.nodes,
                      packing.costs);
    FlowSolver flow({}, fluid.density, fluid.viscosity, packing.nodes, packing.costs);
    flow.set_superficial_velocity(0.3);
    for (unsigned int n = 0; n < 8; ++n)
      {
        exchange.update_bed(packing.dem.store(), packing.dem.particles());
        if (answering)
          exchange.update_drag(
            packing.dem.particles(),
            particle_response(
              packing.dem.particles(),
              [](const unsigned int) { return dealii::Tensor<1, 3>(); },
              gravity,
              fluid.density,
              1e-2));
        else
          exchange.update_drag(packing.dem.particles());
        flow.step(exchange.medium(), 1e-2);
        exchange.forces(packing.dem.particles(), flow, fluid.density, gravity);
        EXPECT_LE(exchange.solid_volume_error(), 1e-12);
        EXPECT_LE(exchange.momentum_imbalance(), 1e-10);
      }
    if (answering) // what is free to fall feels only part of the drop
      return;
    const double drop =
      flow.mean_pressure(VesselMesh::bottom) - flow.mean_pressure(VesselMesh::top);
    const double force = drop * packing.mesh.cylinder().cross_section();
    std::cout << "force " << exchange.total_force()[2] << " N of " << force << " N"
              << std::endl;
    EXPECT_GT(force, 1e-3);
    EXPECT_NEAR(exchange.total_force()[2], force, 0.03 * force)
      << "the momentum that the flow needs to squeeze through the bottom of the bed is "
         "in "
         "between";
  }
} // namespace

TEST(Exchange, KeepsItsLedgerOnARandomPacking)
{
  keeps_its_ledger(true, false);
}

TEST(Exchange, KeepsItsLedgerInModelB)
{
  keeps_its_ledger(false, false);
}

TEST(Exchange, KeepsItsLedgerWhereNodesHang)
{
  keeps_its_ledger(true, true);
  keeps_its_ledger(false, true);
}

TEST(Exchange, KeepsItsLedgerWithParticlesThatAnswer)
{
  for (const bool shares_pressure : {true, false})
    for (const bool local : {true, false})
      keeps_its_ledger(shares_pressure, local, true);
}
