// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/bed_correlations.h>
#include <graupel/simulation/files/result_files.h>
#include <graupel/simulation/studies/study_runs.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    double
    representative_size(const double volume, const unsigned int cells)
    {
      return std::cbrt(volume / cells);
    }

    // Ergun's value of the bed that the same mass of original particles would make [Pa].
    Value
    ergun_of_originals(const RunParameters &parameters,
                       const BedResult     &bed,
                       const Value         &velocity)
    {
      if (!bed.original_void_fraction || !velocity)
        return {};
      const double solid_height = (1. - *bed.mean_void_fraction) * *bed.height;
      return ergun_pressure_drop(parameters.fluid,
                                 bed.original_diameter,
                                 *bed.original_void_fraction,
                                 *velocity,
                                 solid_height / (1. - *bed.original_void_fraction));
    }

    // The drop differs from scale to scale as the void fraction does, which each bed
    // tells of the original one; what is left of it over Ergun's value is smooth.
    void
    add_drop(const RunParameters      &parameters,
             const Summary            &summary,
             const CaseResult         &flow,
             const std::string        &at,
             std::vector<Measurement> &measurements)
    {
      Measurement drop{"pressure drop" + at + " [Pa]", flow["pressure_drop"]};
      const Value ergun =
        ergun_of_originals(parameters, summary.bed, flow["superficial_velocity"]);
      const Value &deviation = flow["deviation_from_ergun"];
      if (!ergun || !deviation || parameters.original_bed.void_fraction != "simulated")
        {
          measurements.push_back(drop);
          return;
        }
      Measurement over{"pressure drop over Ergun's" + at + " [-]", 1. + *deviation};
      Measurement original{"Ergun's value of the original bed" + at + " [Pa]", ergun};
      original.at_scale_one = AtScaleOne::mean;
      drop.at_scale_one     = AtScaleOne::product;
      drop.factors          = {over.quantity, original.quantity};
      measurements.insert(measurements.end(), {drop, over, original});
    }
  } // namespace

  LevelResult
  packed_bed_level(const RunParameters &parameters, const Summary &summary)
  {
    LevelResult result;
    result.cells         = summary.cells;
    result.cell_size     = representative_size(summary.volume, summary.cells);
    result.time_step     = parameters.sweep.longest_step();
    result.filter_length = parameters.filter_length();
    result.scale         = parameters.dem.particles.scale;
    Measurement original{"void fraction of the original bed [-]",
                         summary.bed.original_void_fraction};
    original.at_scale_one = AtScaleOne::mean;
    result.measurements   = {
        {"mean void fraction at rest [-]", summary.bed.mean_void_fraction}, original};
    for (const CaseResult &flow : summary.cases)
      {
        std::ostringstream at;
        if (const Value &velocity = flow["nominal_velocity"])
          at << " at " << *velocity << " m/s";
        const Value &gradient = flow["gradient_deviation_from_ergun"];
        add_drop(parameters, summary, flow, at.str(), result.measurements);
        result.measurements.push_back({"middle gradient over Ergun's" + at.str() + " [-]",
                                       gradient ? Value(1. + *gradient) : Value()});
        result.measurements.push_back(
          {"bottom force" + at.str() + " [N]", flow["bottom_force"]});
      }
    return result;
  }

  LevelResult
  manufactured_level(const RunParameters &parameters,
                     const std::string   &directory,
                     Progress            &progress,
                     MPI_Comm             communicator)
  {
    ResultFiles files(directory, communicator, parameters.output.field_format);
    files.begin();
    CostSheet                  costs;
    const VesselMesh           mesh(parameters.cylinder, parameters.mesh, communicator);
    const NodalSpace           nodes(mesh);
    const ManufacturedSolution solution(
      parameters.manufactured, parameters.fluid.density, parameters.fluid.viscosity);
    FlowSolver       flow(solution.with_boundaries(parameters.flow),
                    parameters.fluid.density,
                    parameters.fluid.viscosity,
                    nodes,
                    costs);
    const FlowErrors errors = solution.run(flow, nodes, parameters.sweep.longest_step());

    Medium medium(nodes);
    solution.set(medium, flow, nodes, parameters.manufactured.duration);
    files.add_fields(parameters.manufactured.duration, nodes, medium, flow);

    LevelResult result;
    result.cells     = mesh.triangulation().n_global_active_cells();
    result.cell_size = representative_size(
      mesh.mean_cross_section() * parameters.cylinder.height, result.cells);
    result.time_step =
      parameters.manufactured.duration > 0. ? parameters.sweep.longest_step() : 0.;
    result.measurements = {{"error of the flux [-]", errors.flux, true},
                           {"error of the pressure [-]", errors.pressure, true}};
    std::ostringstream text;
    text << result.cells << " cells: relative L2 error of the flux " << errors.flux
         << ", of the pressure " << errors.pressure << ", " << errors.solves
         << " linear systems";
    progress.say(text.str());
    return result;
  }
} // namespace graupel
