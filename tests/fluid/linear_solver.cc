#include "column.h"

#include <graupel/fluid/residual_minimizer.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <gtest/gtest.h>

// The flow's linear system in single precision by blocks of nodes, against Trilinos'.

namespace
{
  using dealii::TrilinosWrappers::BlockSparseMatrix;

  // Numbers that look random, the same on any number of ranks.
  double
  noise(const dealii::types::global_dof_index k)
  {
    return std::sin(1. + 12.9898 * k) * 4375.85453 -
           std::floor(std::sin(1. + 12.9898 * k) * 4375.85453) - 0.5;
  }

  // A system with the pattern of a flow's on a coarse cylinder, four unknowns a node:
  // diagonally dominant, not symmetric; pressures see each other as by a Laplacian.
  struct System
  {
    System()
      : mesh({0.02, 0.04}, {4e-3}, MPI_COMM_WORLD)
      , nodes(mesh)
      , space(nodes, {VesselMesh::top})
    {
      dealii::TrilinosWrappers::BlockSparsityPattern pattern(
        space.owned, space.owned, space.relevant, MPI_COMM_WORLD);
      dealii::AffineConstraints<double> none;
      none.close();
      dealii::DoFTools::make_sparsity_pattern(space.dof_handler, pattern, none, false);
      pattern.compress();
      matrix.reinit(pattern);
      const auto n_fluxes = matrix.block(0, 0).m();
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          for (const auto row : matrix.block(i, j).locally_owned_range_indices())
            for (auto entry = matrix.block(i, j).begin(row);
                 entry != matrix.block(i, j).end(row);
                 ++entry)
              {
                // deal.II makes places for other ranks that no cell has.
                const auto node        = row / (i == 0 ? 3 : 1),
                           other       = entry->column() / (j == 0 ? 3 : 1);
                const bool is_diagonal = i == j && entry->column() == row;
                if (nodes.coupling_pattern.exists(node, other))
                  entry->value() = is_diagonal ? 40.
                                               : noise((i * n_fluxes + row) * 1009 +
                                                       j * n_fluxes + entry->column());
              }
      matrix.compress(dealii::VectorOperation::insert);
      vector.reinit(BlockVector(space.owned, space.relevant, MPI_COMM_WORLD));
      for (unsigned int b = 0; b < 2; ++b)
        for (const auto k : vector.block(b).locally_owned_elements())
          vector.block(b)(k) = noise(7 * k + b);
    }

    VesselMesh        mesh;
    NodalSpace        nodes;
    FlowSpace         space;
    BlockSparseMatrix matrix;
    BlockVector       vector;
  };
} // namespace

TEST(LinearSolver, ABlockOfNodesIsTheMatrixInSinglePrecision)
{
  System          system;
  NodeBlockMatrix blocks(system.matrix);
  blocks.take(system.matrix);
  NodeBlockVector x, y;
  blocks.initialize(x);
  blocks.initialize(y);
  blocks.to_nodes(x, system.vector, 2.);
  blocks.vmult(y, x);

  BlockVector expected(system.vector), found(system.vector);
  system.matrix.vmult(expected, system.vector);
  found = 0.;
  blocks.add_to(found, y, 2.);
  found -= expected;
  EXPECT_LE(found.l2_norm(), 1e-6 * expected.l2_norm());

  // q - G p, with the pressures as they are.
  BlockVector pressures(system.vector);
  pressures.block(0) = 0.;
  system.matrix.vmult(expected, pressures);
  expected.sadd(-1., 1., system.vector);
  expected.block(1) = system.vector.block(1);
  blocks.to_nodes(x, system.vector, 1.);
  y.equ(1.f, x);
  blocks.subtract_gradient(y, x);
  found = 0.;
  blocks.add_to(found, y, 1.);
  found -= expected;
  EXPECT_LE(found.l2_norm(), 1e-6 * expected.l2_norm());
}

TEST(LinearSolver, FactorsOfAMatrixOfOneDiagonalAreItsInverse)
{
  System system;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      system.matrix.block(i, j) = 0.;
  for (const auto row : system.matrix.block(0, 0).locally_owned_range_indices())
    system.matrix.block(0, 0).set(row, row, 2. + row % 3);
  system.matrix.compress(dealii::VectorOperation::insert);
  NodeBlockMatrix blocks(system.matrix);
  blocks.take(system.matrix);
  FluxFactors factors;
  factors.refresh(blocks);
  NodeBlockVector x;
  blocks.initialize(x);
  x = 12.f;
  factors.solve(x);
  for (unsigned int k = 0; k < x.locally_owned_size(); ++k)
    EXPECT_FLOAT_EQ(x.local_element(k), k % 4 < 3 ? 12.f / (2.f + k % 4) : 12.f);
}

TEST(LinearSolver, SolutionsAreAsExactAsDoublePrecisionAllows)
{
  System          system;
  NodeBlockMatrix blocks(system.matrix);
  blocks.take(system.matrix);
  dealii::TrilinosWrappers::SparseMatrix schur;
  schur.reinit(system.nodes.coupling_pattern);
  for (const auto row : schur.locally_owned_range_indices())
    schur.set(row, row, 40.);
  schur.compress(dealii::VectorOperation::insert);
  BlockPreconditioner preconditioner(blocks);
  preconditioner.refresh(schur);
  ResidualMinimizer minimizer(system.matrix, blocks, preconditioner);

  BlockVector right(system.vector), found(system.vector);
  system.matrix.vmult(right, system.vector);
  unsigned int total = 0, last = 0;
  found = 0.;
  for (const double tolerance : {1e-4, 1e-8, 1e-13})
    {
      last = minimizer.solve(found, right, tolerance * right.l2_norm(), 0., 200);
      ASSERT_NE(last, dealii::numbers::invalid_unsigned_int);
      total += last;
      BlockVector residual(right);
      system.matrix.vmult(residual, found);
      residual -= right;
      EXPECT_LE(residual.l2_norm(), tolerance * right.l2_norm());
    }
  // From the same start a search that remembers nothing takes more than its end did.
  found = 0.;
  minimizer.forget();
  const unsigned int at_once =
    minimizer.solve(found, right, 1e-13 * right.l2_norm(), 0., 200);
  say() << total << " iterations in three turns, " << at_once << " at once\n";
  EXPECT_LE(total, at_once + 2);
  found -= system.vector;
  EXPECT_LE(found.l2_norm(), 1e-11 * system.vector.l2_norm());

  // A part of what was left at first takes as few as it takes.
  found = 0.;
  minimizer.forget();
  const unsigned int roughly =
    minimizer.solve(found, right, 1e-13 * right.l2_norm(), 1e-2, 200);
  BlockVector residual(right);
  system.matrix.vmult(residual, found);
  residual -= right;
  EXPECT_LE(residual.l2_norm(), 1e-2 * right.l2_norm());
  EXPECT_GE(residual.l2_norm(), 1e-4 * right.l2_norm());
  EXPECT_LT(2 * roughly, at_once);

  // What cannot be reached is told.
  for (const auto &[tolerance, maximum] : {std::pair{1e-25, 200u}, {1e-13, 1u}})
    {
      found = 0.;
      minimizer.forget();
      EXPECT_EQ(minimizer.solve(found, right, tolerance * right.l2_norm(), 0., maximum),
                dealii::numbers::invalid_unsigned_int);
    }
}
