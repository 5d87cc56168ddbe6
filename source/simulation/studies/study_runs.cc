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
    result.measurements.push_back(
      {"mean void fraction at rest [-]", summary.bed.mean_void_fraction});
    for (const CaseResult &flow : summary.cases)
      {
        std::ostringstream at;
        if (const Value &velocity = flow["nominal_velocity"])
          at << " at " << *velocity << " m/s";
        const Value &gradient = flow["gradient_deviation_from_ergun"];
        result.measurements.push_back(
          {"pressure drop" + at.str() + " [Pa]", flow["pressure_drop"]});
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
    ResultFiles files(directory, communicator);
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
