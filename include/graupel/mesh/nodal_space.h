// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_nodal_space_h
#define graupel_mesh_nodal_space_h

#include <graupel/mesh/vessel_mesh.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace graupel
{
  /** One number a node: owned nodes of this rank, ghosts readable on request. */
  using NodalVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** Three numbers a node. */
  using NodalVectorField = std::array<NodalVector, 3>;

  /**
   * The nodes of the mesh and their trilinear basis functions psi_k: the
   * partition of unity on which void fraction, drag and the flow live.
   */
  class NodalSpace
  {
  public:
    /** @p mesh must outlive this object. */
    explicit NodalSpace(const VesselMesh &mesh);

    const VesselMesh     &mesh;
    const dealii::FE_Q<3> fe;
    /** The rule that all integrals over cells share, so that sums of them agree to
     * round-off. */
    const dealii::Quadrature<3>       quadrature;
    dealii::DoFHandler<3>             dof_handler;
    dealii::AffineConstraints<double> hanging_nodes;
    dealii::IndexSet                  owned;
    dealii::IndexSet                  relevant;
    /** The entries of a matrix that couples nodes which share a cell. */
    dealii::TrilinosWrappers::SparsityPattern coupling_pattern;

    /** VesselMesh::owned_cells(), with their nodes. */
    std::vector<dealii::DoFHandler<3>::active_cell_iterator> owned_cells() const;

    /** Numbers the nodes of the mesh as it is now, in the order of its cells: the past of
     * the mesh does not show. Vectors of another numbering are void. Collective. */
    void number_nodes();

    /** Makes @p vector a zero vector of the nodes, with room for ghosts. */
    void initialize(NodalVector &vector) const;

    /** Sets the own hanging nodes of @p vector between the nodes that they depend on, and
     * brings the ghosts up to date. Collective among neighbours. */
    void distribute(NodalVector &vector) const;

    /** Puts the values of @p fields at the nodes of each own cell behind its @p bytes, in
     * the order of owned_cells(). */
    void append(VesselMesh::CellBytes                  &bytes,
                const std::vector<const NodalVector *> &fields) const;

    /** Makes @p fields of what append() put there, and takes it away. Collective. */
    void take(VesselMesh::CellBytes            &bytes,
              const std::vector<NodalVector *> &fields) const;

    /** Volume of each node, m_k = integral of psi_k [m^3], ghosts up to date. */
    const NodalVector &
    measure() const
    {
      return volumes;
    }

  private:
    // An own node between others, by local numbers, each with its weight.
    struct HangingNode
    {
      unsigned int                                 node;
      std::vector<std::pair<unsigned int, double>> ends;
    };

    void find_hanging_nodes();

    std::vector<HangingNode> own_hanging_nodes;
    // On any rank; and whether one depends on a node that its rank does not know.
    bool has_hanging_nodes = false, has_distant_ends = false;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    NodalVector                                                volumes;
  };
} // namespace graupel

#endif
