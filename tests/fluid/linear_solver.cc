// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "column.h"

#include <graupel/fluid/residual_minimizer.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_block_sparse_matrix.h>
#include <gtest/gtest.h>

// The flow's linear system by blocks of nodes: how cells are added to it, against
// deal.II and Trilinos; its copy in single precision; its solution.

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

  void
  fill_with_noise(BlockVector &vector)
  {
    for (unsigned int b = 0; b < 2; ++b)
      for (const auto k : vector.block(b).locally_owned_elements())
        vector.block(b)(k) = noise(7 * k + b);
  }

  // A system with the pattern of a flow's on a coarse cylinder, four unknowns a node:
  // diagonally dominant, not symmetric.
  struct System
  {
    System()
      : mesh({0.02, 0.04}, {4e-3}, MPI_COMM_WORLD)
      , nodes(mesh)
      , matrix(nodes)
    {
      set([](const auto row, const auto column) {
        return row == column ? 40. : noise(row * 1009 + column);
      });
      matrix.initialize(vector);
      fill_with_noise(vector);
    }

    // By row and column: four times the node, and the unknown.
    template <typename Entry>
    void
    set(const Entry &entry)
    {
      matrix.clear();
      const auto &partitioner = *matrix.partitioner();
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (unsigned int k = matrix.rows()[row]; k < matrix.rows()[row + 1]; ++k)
          for (unsigned int i = 0; i < 4; ++i)
            for (unsigned int j = 0; j < 4; ++j)
              matrix.block(k)[4 * j + i] =
                entry(4 * partitioner.local_to_global(row) + i,
                      4 * partitioner.local_to_global(matrix.columns()[k]) + j);
      matrix.compress();
    }

    VesselMesh  mesh;
    NodalSpace  nodes;
    FlowMatrix  matrix;
    BlockVector vector;
  };

  // The same, and its preconditioner with a diagonal for the pressure's diffusion.
  struct PreconditionedSystem : System
  {
    PreconditionedSystem()
      : blocks(matrix)
      , preconditioner(blocks)
    {
      diffusion.reinit(nodes.coupling_pattern);
      for (const auto row : diffusion.locally_owned_range_indices())
        diffusion.set(row, row, 40.);
      diffusion.compress(dealii::VectorOperation::insert);
      nodes.initialize(of_grad_div);
    }

    // Of what the matrix is now.
    void
    refresh()
    {
      blocks.take();
      preconditioner.refresh(diffusion, of_grad_div);
    }

    NodeBlockMatrix                        blocks;
    BlockPreconditioner                    preconditioner;
    dealii::TrilinosWrappers::SparseMatrix diffusion;
    NodalVector                            of_grad_div; // 0
  };

  // A mesh that is refined on one side, with what a flow's boundaries prescribe on it,
  // and a system by deal.II and Trilinos beside the flow's.
  struct ConstrainedSystem
  {
    ConstrainedSystem()
      : mesh({0.02, 0.03}, {4e-3}, MPI_COMM_WORLD)
      , nodes(
          Column::refine(mesh, [](const auto &x) { return x[0] + 0.3 * x[2] > 4e-3; }))
      , space(nodes, {VesselMesh::top})
      , boundaries({{VesselMesh::bottom, {BoundaryCondition::plug, {}}},
                    {VesselMesh::top, {BoundaryCondition::no_slip, {}}},
                    {VesselMesh::wall, {BoundaryCondition::slip, {}}}},
                   false,
                   space)
      , matrix(nodes)
      , scatter(space, boundaries.constraints(), matrix)
    {
      NodalVector full;
      nodes.initialize(full);
      full = 1.;
      full.update_ghost_values();
      boundaries.update(0., 0.4, 1., full);
      dealii::TrilinosWrappers::BlockSparsityPattern pattern(
        space.owned, space.owned, space.relevant, MPI_COMM_WORLD);
      dealii::DoFTools::make_sparsity_pattern(
        space.dof_handler, pattern, boundaries.constraints(), false);
      pattern.compress();
      expected_matrix.reinit(pattern);
      expected_rhs.reinit(BlockVector(space.owned, space.relevant, MPI_COMM_WORLD));
      rhs.reinit(expected_rhs);
    }

    void
    add_cell(const unsigned int cell)
    {
      const auto first = 100000 * nodes.owned_cells()[cell]->global_active_cell_index();
      dealii::FullMatrix<double> local(32, 32);
      dealii::Vector<double>     local_rhs(32);
      CellSystem                 system;
      for (unsigned int r = 0; r < 32; ++r)
        {
          system.right(r) = local_rhs[r] = noise(first + r);
          for (unsigned int c = 0; c < 32; ++c)
            system(r, c) = local(r, c) = noise(first + 32 * (r + 1) + c);
        }
      const auto &constraints = boundaries.constraints();
      const auto &unknowns    = space.cell_unknowns[cell];
      constraints.distribute_local_to_global(local, unknowns, expected_matrix);
      constraints.distribute_local_to_global(local_rhs, unknowns, expected_rhs, local);
      scatter.add(cell, system, rhs);
    }

    void
    add_to_node(const unsigned int node)
    {
      const auto global = nodes.measure().get_partitioner()->local_to_global(node);
      if (nodes.hanging_nodes.is_constrained(global))
        return;
      dealii::FullMatrix<double>                   local(3, 3);
      dealii::Vector<double>                       local_rhs(3);
      std::vector<dealii::types::global_dof_index> unknowns(3);
      dealii::Tensor<1, 3>                         source;
      const double                                 resistance = 1. + noise(global);
      for (unsigned int i = 0; i < 3; ++i)
        {
          unknowns[i] = 3 * global + i;
          local(i, i) = resistance;
          source[i] = local_rhs[i] = noise(unknowns[i]);
        }
      const auto &constraints = boundaries.constraints();
      constraints.distribute_local_to_global(local, unknowns, expected_matrix);
      constraints.distribute_local_to_global(local_rhs, unknowns, expected_rhs, local);
      scatter.add(node, resistance, source, rhs);
    }

    void
    compress()
    {
      matrix.compress();
      rhs.compress(dealii::VectorOperation::add);
      expected_matrix.compress(dealii::VectorOperation::add);
      expected_rhs.compress(dealii::VectorOperation::add);
    }

    // Largest difference to an entry of the matrix of deal.II.
    double
    worst_entry() const
    {
      const auto &partitioner = *matrix.partitioner();
      double      result      = 0.;
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (unsigned int k = matrix.rows()[row]; k < matrix.rows()[row + 1]; ++k)
          for (unsigned int i = 0; i < 4; ++i)
            for (unsigned int j = 0; j < 4; ++j)
              {
                const auto global_row = partitioner.local_to_global(row),
                           global_column =
                             partitioner.local_to_global(matrix.columns()[k]);
                const double expected =
                  expected_matrix.block(i / 3, j / 3)
                    .el(i < 3 ? 3 * global_row + i : global_row,
                        j < 3 ? 3 * global_column + j : global_column);
                result =
                  std::max(result, std::abs(matrix.block(k)[4 * j + i] - expected));
              }
      return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
    }

    VesselMesh        mesh;
    NodalSpace        nodes;
    FlowSpace         space;
    FlowBoundaries    boundaries;
    FlowMatrix        matrix;
    CellScatter       scatter;
    BlockVector       rhs, expected_rhs;
    BlockSparseMatrix expected_matrix;
  };
} // namespace

TEST(LinearSolver, CellsAreAddedAsAffineConstraintsAddsThem)
{
  ConstrainedSystem system;
  unsigned int      hanging = 0, prescribed = 0, slipping = 0;
  for (const auto node : system.nodes.owned)
    {
      const auto *const entries =
        system.boundaries.constraints().get_constraint_entries(3 * node);
      if (system.nodes.hanging_nodes.is_constrained(node))
        ++hanging;
      else if (entries)
        ++(entries->empty() ? prescribed : slipping);
    }
  for (const unsigned int n : {hanging, prescribed, slipping})
    EXPECT_GT(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 5u);

  // A second time what was there is gone.
  for (unsigned int turn = 0; turn < 2; ++turn)
    {
      system.matrix.clear();
      system.expected_matrix = 0.;
      system.rhs = system.expected_rhs = 0.;
      for (unsigned int cell = 0; cell < system.space.n_cells(); ++cell)
        system.add_cell(cell);
      for (unsigned int node = 0; node < system.matrix.n_rows(); ++node)
        system.add_to_node(node);
      system.compress();
    }
  const double worst = system.worst_entry();
  say() << "entries differ by " << worst << '\n';
  EXPECT_LE(worst, 1e-13);
  NodeBlockMatrix single(system.matrix);
  single.take();
  const double divergence = system.expected_matrix.block(1, 0).linfty_norm(),
               pressure   = system.expected_matrix.block(1, 1).linfty_norm();
  EXPECT_NEAR(single.divergence_norm(), divergence, 1e-5 * divergence);
  EXPECT_NEAR(single.pressure_norm(), pressure, 1e-5 * pressure);
  const double size = system.expected_rhs.l2_norm();
  system.rhs -= system.expected_rhs;
  say() << "right sides by " << system.rhs.l2_norm() << " of " << size << '\n';
  EXPECT_GT(size, 1.);
  EXPECT_LE(system.rhs.l2_norm(), 1e-14 * size);

  // Neither matrix has entries that the other has not.
  BlockVector x, found;
  for (BlockVector *vector : {&x, &found})
    system.matrix.initialize(*vector);
  fill_with_noise(x);
  BlockVector expected(system.expected_rhs), source(system.expected_rhs);
  fill_with_noise(source);
  system.matrix.vmult(found, x);
  system.expected_matrix.vmult(expected, source);
  const double product_size = expected.l2_norm();
  expected -= found;
  say() << "products by " << expected.l2_norm() << " of " << product_size << '\n';
  EXPECT_LE(expected.l2_norm(), 1e-14 * product_size);
}

TEST(LinearSolver, ABlockOfNodesIsTheMatrixInSinglePrecision)
{
  System          system;
  NodeBlockMatrix blocks(system.matrix);
  blocks.take();
  NodeBlockVector x, y;
  blocks.initialize(x);
  blocks.initialize(y);
  NodeValues values;
  blocks.initialize_values(values);
  BlockVector expected(system.vector), found(system.vector), known(system.vector);
  blocks.to_nodes(x, system.vector, 2.);
  y     = 1e3f; // of no consequence
  known = 0.;
  for (const unsigned int unknown : {3, 0, 1, 2})
    {
      for (unsigned int node = 0; node < blocks.n_rows(); ++node)
        {
          values.local_element(node) = x.local_element(4 * node + unknown);
          if (unknown == 3)
            known.block(1).local_element(node) =
              system.vector.block(1).local_element(node);
          else
            known.block(0).local_element(3 * node + unknown) =
              system.vector.block(0).local_element(3 * node + unknown);
        }
      if (unknown == 3)
        blocks.multiply(y, values, unknown);
      else
        blocks.add_product(y, values, unknown);
      system.matrix.vmult(expected, known);
      found = 0.;
      blocks.add_to(found, y, 2.);
      found -= expected;
      EXPECT_LE(found.l2_norm(), 1e-6 * expected.l2_norm()) << unknown;
    }
}

TEST(LinearSolver, FactorsOfAMatrixOfOneDiagonalAreItsInverse)
{
  System system;
  system.set([](const auto row, const auto column) {
    return row == column && row % 4 < 3 ? 2. + row % 4 : 0.;
  });
  NodeBlockMatrix blocks(system.matrix);
  blocks.take();
  FluxFactors factors;
  factors.refresh(blocks);
  NodeBlockVector b, known;
  blocks.initialize(b);
  blocks.initialize(known);
  NodeValues x;
  blocks.initialize_values(x);
  b     = 16.f;
  known = 4.f;
  for (unsigned int component = 0; component < 3; ++component)
    {
      factors.solve(x, b, known, component);
      for (unsigned int node = 0; node < x.locally_owned_size(); ++node)
        EXPECT_FLOAT_EQ(x.local_element(node), 12.f / (2.f + component));
    }
}

TEST(LinearSolver, ThePreconditionerSolvesASystemOfATriangleByNodes)
{
  // [A G; 0 S] with A a lower triangle at each node and 1 / S = 1 / 40 + 0.5.
  PreconditionedSystem system;
  const auto           entry = [](const auto row, const auto column) {
    return row == column           ? 40.
                     : row / 4 != column / 4 ? 0.
                     : column % 4 == 3       ? 3. + row % 4
                     : row % 4 > column % 4  ? 10. * (row % 4) + column % 4
                                             : 0.;
  };
  system.set(entry);
  system.of_grad_div = 0.5;
  system.refresh();
  const NodeBlockMatrix &blocks = system.blocks;
  NodeBlockVector        x, b, product;
  for (NodeBlockVector *vector : {&x, &b, &product})
    blocks.initialize(*vector);
  blocks.to_nodes(b, system.vector, 1.);
  product = 1e3f; // of no consequence
  system.preconditioner.vmult(x, product, b);
  for (unsigned int node = 0; node < blocks.n_rows(); ++node)
    {
      const float *const right = b.begin() + 4 * node, *const found =
                                                         x.begin() + 4 * node;
      EXPECT_NEAR(found[3], right[3] * (1. / 40. + 0.5), 1e-6);
      for (unsigned int i = 0; i < 4; ++i)
        {
          double image = 0.;
          for (unsigned int j = 0; j < 4; ++j)
            image += entry(4 * node + i, 4 * node + j) * found[j];
          EXPECT_NEAR(product.local_element(4 * node + i), image, 1e-5);
          if (i < 3)
            EXPECT_NEAR(image, right[i], 1e-5);
        }
    }
}

TEST(LinearSolver, AFewCyclesOfMultigridFindAPressure)
{
  // On a mesh with coarser levels, and on one that is its own coarsest.
  for (const double cell_size : {4e-3, 1.2e-3})
    {
      const VesselMesh mesh({0.02, 0.04}, {cell_size}, MPI_COMM_WORLD);
      const NodalSpace nodes(mesh);
      const FlowSpace  space(nodes, {});
      FlowMatrix       pattern(nodes);
      NodeBlockMatrix  blocks(pattern);
      // (grad psi_a, grad psi_b) + (psi_a, psi_b) / L^2, for a length L of the vessel's.
      dealii::TrilinosWrappers::SparseMatrix matrix;
      matrix.reinit(nodes.coupling_pattern);
      dealii::FullMatrix<double>                   local(8, 8);
      std::vector<dealii::types::global_dof_index> indices(8);
      for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
        {
          local = 0.;
          for (const ShapePoint &point : space.shapes[cell])
            for (unsigned int a = 0; a < 8; ++a)
              for (unsigned int b = 0; b < 8; ++b)
                local(a, b) +=
                  point.weight * (point.gradient_of(a) * point.gradient_of(b) +
                                  point.value[a] * point.value[b] / 4e-4);
          for (unsigned int a = 0; a < 8; ++a)
            indices[a] = nodes.measure().get_partitioner()->local_to_global(
              space.cell_nodes[cell][a]);
          nodes.hanging_nodes.distribute_local_to_global(local, indices, matrix);
        }
      matrix.compress(dealii::VectorOperation::add);
      PressureMultigrid multigrid(blocks);
      multigrid.refresh(matrix);

      dealii::LinearAlgebra::distributed::Vector<double> exact(pattern.partitioner()),
        found(exact), error(exact), residual(exact);
      for (const auto k : exact.locally_owned_elements())
        exact(k) = 1. + noise(k);
      NodeValues x;
      blocks.initialize_values(x);
      NodeBlockVector b;
      blocks.initialize(b);
      std::vector<double> errors;
      for (unsigned int cycle = 0; cycle < 4; ++cycle)
        {
          error = exact;
          error -= found;
          errors.push_back(error.l2_norm());
          matrix.vmult(residual, error);
          for (unsigned int k = 0; k < residual.locally_owned_size(); ++k)
            b.local_element(4 * k + 3) = residual.local_element(k);
          x = 5.f;
          multigrid.vmult(x, b);
          for (unsigned int k = 0; k < residual.locally_owned_size(); ++k)
            found.local_element(k) += x.local_element(k);
        }
      say() << nodes.owned.size() << " nodes, errors";
      for (const double size : errors)
        say() << ' ' << size;
      say() << '\n';
      EXPECT_LE(errors[3], 0.1 * errors[0]);
    }
}

TEST(LinearSolver, SolutionsAreAsExactAsDoublePrecisionAllows)
{
  PreconditionedSystem system;
  system.refresh();
  ResidualMinimizer minimizer(system.matrix, system.blocks, system.preconditioner);

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

  // The sum of the continuity equation is exact long before.
  found = 0.;
  minimizer.forget();
  minimizer.solve(found, right, 1e-6 * right.l2_norm(), 0., 200);
  const BlockVector &rest = minimizer.last_residual();
  const double       all  = std::abs(rest.block(1).mean_value()) * rest.block(1).size();
  say() << "residual " << rest.l2_norm() << ", sum of the continuity equation " << all
        << '\n';
  EXPECT_LE(all, 1e-3 * rest.l2_norm());

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
