// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/mesh/adaption.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/numerics/error_estimator.h>

namespace graupel
{
  namespace
  {
    // Cells are coarsened below this part of the surface threshold, so that they do not
    // flicker.
    constexpr double hysteresis = 1. / 3.;

    // Sets flags by the Kelly indicator of a field (fixed number).
    void
    mark_by_indicator(const AdaptionParameters &parameters,
                      const NodalSpace         &nodes,
                      const AdaptionFields     &fields,
                      VesselMesh               &mesh)
    {
      const NodalVector    &field = parameters.indicator == "void fraction"
                                      ? fields.void_fraction
                                    : parameters.indicator == "flux" ? fields.flux
                                                                     : fields.pressure;
      dealii::Vector<float> errors(mesh.triangulation().n_active_cells());
      dealii::KellyErrorEstimator<3>::estimate(
        mesh.mapping(), nodes.dof_handler, dealii::QGauss<2>(2), {}, field, errors);
      mesh.mark_by(errors, parameters.refine_fraction, parameters.coarsen_fraction);
    }

    double
    difference_within(const dealii::DoFHandler<3>::active_cell_iterator &cell,
                      const NodalVector                                 &field)
    {
      double smallest = std::numeric_limits<double>::max(), largest = -smallest;
      for (const unsigned int v : cell->vertex_indices())
        {
          const double value = field(cell->vertex_dof_index(v, 0));
          smallest           = std::min(smallest, value);
          largest            = std::max(largest, value);
        }
      return largest - smallest;
    }

    bool
    touches_wall(const dealii::DoFHandler<3>::active_cell_iterator &cell)
    {
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() &&
            cell->face(f)->boundary_id() == VesselMesh::wall)
          return true;
      return false;
    }
  } // namespace

  void
  AdaptionParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh adaption");
    prm.add_parameter("interval",
                      interval,
                      "Simulated time between two adaptions of the mesh while the fluid "
                      "flows; 0: none [s].");
    prm.add_parameter("initial passes",
                      initial_passes,
                      "Adaptions to the settled bed before the fluid's first step [-].");
    prm.add_parameter(
      "surface threshold",
      surface_threshold,
      "Cells within which the void fraction differs by more than this are refined, as at "
      "the surface of a bed; 0: no such criterion [-].");
    prm.add_parameter(
      "at the wall", at_wall, "Whether the cells at the wall are refined.");
    prm.add_parameter("indicator",
                      indicator,
                      "Field whose Kelly indicator (jumps of its gradient) refines and "
                      "coarsens.",
                      dealii::Patterns::Selection("none|void fraction|flux|pressure"));
    prm.add_parameter("refine fraction",
                      refine_fraction,
                      "Part of the cells that the indicator refines [-].");
    prm.add_parameter("coarsen fraction",
                      coarsen_fraction,
                      "Part of the cells that the indicator lets be coarsened [-].");
    prm.add_parameter("maximum levels",
                      maximum_levels,
                      "Refinements beyond the mesh of the section Mesh, at most; no cell "
                      "is coarsened beyond that mesh [-].");
    prm.add_parameter("smallest cell",
                      smallest_cell,
                      "Length of an edge below which no cell is refined; 0: none [m].");
    prm.add_parameter("maximum cells",
                      maximum_cells,
                      "Number of cells beyond which nothing is refined [-].");
    prm.leave_subsection();
  }

  void
  AdaptionParameters::check() const
  {
    const std::string section = "Mesh adaption/";
    require(
      interval >= 0., section + "interval", "must not be negative; 0 switches it off");
    require(surface_threshold >= 0. && surface_threshold < 1.,
            section + "surface threshold",
            "a difference of void fractions lies between 0 and 1; 0.1 to 0.3 is usual");
    require(
      refine_fraction >= 0. && coarsen_fraction >= 0. &&
        refine_fraction + coarsen_fraction <= 1.,
      section + "refine fraction",
      "the fractions of cells to refine and to coarsen must not be negative nor more "
      "than 1 together");
    require(maximum_levels <= 5,
            section + "maximum levels",
            "more than 5 refinements make 32,768 cells of one");
    require(smallest_cell >= 0., section + "smallest cell", "must not be negative");
    require(maximum_cells >= 1, section + "maximum cells", "must be positive");
  }

  bool
  mark_cells(const AdaptionParameters &parameters,
             const NodalSpace         &nodes,
             const AdaptionFields     &fields,
             VesselMesh               &mesh)
  {
    mesh.clear_marks();
    if (parameters.indicator != "none")
      mark_by_indicator(parameters, nodes, fields, mesh);
    const int    base      = mesh.base_level();
    unsigned int n_refined = 0;
    for (const auto &cell : nodes.dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const double difference = difference_within(cell, fields.void_fraction);
        const bool   surface    = parameters.surface_threshold > 0.;
        const bool   at_wall    = parameters.at_wall && touches_wall(cell);
        const bool   wanted     = cell->refine_flag_set() || at_wall ||
                            (surface && difference > parameters.surface_threshold);
        const bool kept =
          at_wall ||
          (surface && difference > hysteresis * parameters.surface_threshold) ||
          (parameters.indicator != "none" && !cell->coarsen_flag_set());
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (wanted &&
            cell->level() < base + static_cast<int>(parameters.maximum_levels) &&
            cell->minimum_vertex_distance() / 2. >= parameters.smallest_cell)
          {
            cell->set_refine_flag();
            ++n_refined;
          }
        else if (!wanted && !kept && cell->level() > base)
          cell->set_coarsen_flag();
      }
    n_refined = dealii::Utilities::MPI::sum(n_refined, mesh.communicator());
    if (mesh.triangulation().n_global_active_cells() + 7ull * n_refined >
        parameters.maximum_cells)
      for (const auto &cell : nodes.dof_handler.active_cell_iterators())
        cell->clear_refine_flag();
    return mesh.prepare_adaption();
  }
} // namespace graupel
