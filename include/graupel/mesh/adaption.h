// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_mesh_adaption_h
#define graupel_mesh_adaption_h

#include <graupel/mesh/nodal_space.h>

namespace graupel
{
  /** When and where cells are refined and coarsened during a run. */
  struct AdaptionParameters
  {
    /** Simulated time between two adaptions; 0: the mesh stays as it is [s]. */
    double interval = 0.;
    /** Adaptions before the fluid's first step [-]. */
    unsigned int initial_passes = 0;
    /** Refine where the void fraction differs by more than this within a cell; 0: not
     * [-]. */
    double surface_threshold = 0.2;
    /** Refine the cells at the wall. */
    bool at_wall = false;
    /** "none", or the field whose Kelly indicator refines: "void fraction", "flux",
     * "pressure". */
    std::string indicator = "none";
    /** Parts of the cells that the indicator refines and coarsens [-]. */
    double refine_fraction = 0.1, coarsen_fraction = 0.1;
    /** Refinements beyond the mesh of the section Mesh, at most [-]. */
    unsigned int maximum_levels = 1;
    /** Smallest edge of a cell; 0: none [m]. */
    double smallest_cell = 0.;
    /** Cells, at most [-]. */
    unsigned int maximum_cells = 200000;

    bool
    is_wanted() const
    {
      return interval > 0. || initial_passes > 0;
    }

    /** Declares the section "Mesh adaption". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };

  /** The fields that adaption looks at, ghosts up to date. */
  struct AdaptionFields
  {
    const NodalVector &void_fraction, &flux, &pressure;
  };

  /**
   * Marks the cells of @p nodes' mesh: refined where one of the criteria asks for it and
   * the limits allow it, coarsened, never beyond the mesh of the section Mesh, where none
   * asks (the void fraction's differences having fallen below a third of the threshold).
   * Where the limit of cells would be passed nothing is refined. True if any cell of any
   * rank will change. Collective.
   */
  bool mark_cells(const AdaptionParameters &parameters,
                  const NodalSpace         &nodes,
                  const AdaptionFields     &fields,
                  VesselMesh               &mesh);
} // namespace graupel

#endif
