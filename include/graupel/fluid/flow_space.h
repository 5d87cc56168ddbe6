// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_space_h
#define graupel_fluid_flow_space_h

#include <graupel/fluid/flow_kernel.h>
#include <graupel/mesh/nodal_space.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace graupel
{
  /**
   * The flow's unknowns on the nodes, and everything about them that depends on
   * the mesh alone and is computed once: numbering, basis functions at the
   * quadrature points, the discrete gradient.
   *
   * Local numbering: flux component c of local node k is number 3 k + c of block
   * 0, its pressure number k of block 1.
   */
  class FlowSpace
  {
  public:
    using LocalNodes = std::array<unsigned int, nodes_per_cell>;

    /** A quadrature point on the boundary. */
    struct FacePoint
    {
      dealii::Point<3>     position;
      dealii::Tensor<1, 3> normal; // outward
      /** Number of the cell among the owned cells. */
      unsigned int cell;
      /** Weight, with the Jacobian [m^2]. */
      double weight;
      /** Basis functions [-]. */
      std::array<double, nodes_per_cell> value;
      /** Their gradients [1/m]. */
      std::array<dealii::Tensor<1, 3>, nodes_per_cell> gradient;
    };

    /** @p nodes must outlive this object; pressure is prescribed on @p outlets. */
    FlowSpace(const NodalSpace                              &nodes,
              const std::vector<dealii::types::boundary_id> &outlets);

    /** Quadrature points of this rank's part of a boundary. */
    const std::vector<FacePoint> &boundary(const dealii::types::boundary_id id) const;

    /** The value of @p field at @p point, and the normal component of @p field, outward;
     * ghosts up to date. */
    double value(const FacePoint &point, const NodalVector &field) const;
    double normal_component(const FacePoint &point, const NodalVectorField &field) const;

    /** Owned cells of this rank. */
    unsigned int
    n_cells() const
    {
      return cell_nodes.size();
    }

    const NodalSpace         &nodes;
    const dealii::FESystem<3> fe;
    dealii::DoFHandler<3>     dof_handler;
    /** Owned and relevant unknowns, by block. */
    std::vector<dealii::IndexSet> owned, relevant;

    /** By owned cell: its unknowns, its nodes as local indices of a NodalVector, its size
     * and its middle [m]. */
    std::vector<std::vector<dealii::types::global_dof_index>> cell_unknowns;
    std::vector<LocalNodes>                                   cell_nodes;
    std::vector<double>                                       cell_sizes;
    std::vector<dealii::Point<3>>                             cell_centers;
    /** By owned cell: whether one of its nodes hangs. */
    std::vector<bool> has_hanging_node;
    /** The part of the nodes' volumes that lies in such cells [m^3]. */
    NodalVector hanging_measure;
    /** Quadrature points, by owned cell. */
    std::vector<ShapePoints> shapes;
    /**
     * By component: integral of psi_k dp/dx_i over the cells, minus
     * integral of psi_k n_i p over the outlets [m^2]; its transpose is minus the
     * divergence of the continuity equation.
     */
    std::array<dealii::TrilinosWrappers::SparseMatrix, 3> gradient;

  private:
    void number_unknowns();
    void store_cells();
    void store_faces();
    void measure_hanging();
    void assemble_gradient(const std::vector<dealii::types::boundary_id> &outlets);

    std::map<dealii::types::boundary_id, std::vector<FacePoint>> faces;
  };
} // namespace graupel

#endif
