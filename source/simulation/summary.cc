#include <graupel/simulation/summary.h>

#include <deal.II/base/config.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace graupel
{
  namespace
  {
    using Json = nlohmann::ordered_json; // a number that is not finite becomes null

    Json
    to_json(const BedResult &bed)
    {
      return {{"particle_count", bed.particle_count},
              {"particle_diameter", bed.particle_diameter},
              {"scale", bed.scale},
              {"solid_volume", bed.solid_volume},
              {"height", bed.height},
              {"mean_void_fraction", bed.mean_void_fraction},
              {"mean_coordination_number", bed.mean_coordination_number},
              {"original_diameter", bed.original_diameter},
              {"vessel_diameter", bed.vessel_diameter},
              {"vessel_height", bed.vessel_height},
              {"original_solid_ratio", bed.original_solid_ratio}};
    }

    Json
    to_json(const CaseResult &result)
    {
      return {{"superficial_velocity", result.superficial_velocity},
              {"pressure_drop", result.pressure_drop},
              {"ergun_pressure_drop", result.ergun_pressure_drop},
              {"deviation_from_ergun", result.deviation_from_ergun},
              {"gradient_deviation_from_ergun", result.gradient_deviation_from_ergun},
              {"wall_channelling_deviation", result.wall_channelling_deviation},
              {"bed_height", result.bed_height},
              {"bed_rise", result.bed_rise},
              {"mean_void_fraction", result.mean_void_fraction},
              {"bottom_force", result.bottom_force},
              {"wall_force", result.wall_force},
              {"fluid_force", result.fluid_force},
              {"weight", result.weight},
              {"fluidized", result.fluidized},
              {"steady", result.steady},
              {"simulated_time", result.simulated_time},
              {"wall_seconds", result.wall_seconds},
              {"cpu_seconds", result.cpu_seconds}};
    }

    Json
    to_json(const CostSheet &costs, const Summary &summary, MPI_Comm communicator)
    {
      using namespace dealii::Utilities::MPI;
      Json seconds_in;
      for (unsigned int i = 0; i < CostSheet::n_sections; ++i)
        seconds_in[section_name(static_cast<CostSheet::Section>(i))] =
          max(costs.seconds[i], communicator);
      return {{"wall_seconds", summary.wall_seconds},
              {"cpu_seconds", sum(summary.cpu_seconds, communicator)},
              {"particle_steps", sum(costs.particle_steps, communicator)},
              {"contact_steps", sum(costs.contact_steps, communicator)},
              {"fluid_steps", costs.fluid_steps},
              {"seconds_in", seconds_in}};
    }
  } // namespace

  void
  write_summary(const std::string &path, const Summary &summary, MPI_Comm communicator)
  {
    using namespace dealii::Utilities::MPI;
    Json root;
    root["program"] = {{"name", "graupel"},
                       {"version", GRAUPEL_VERSION},
                       {"deal_ii_version", DEAL_II_PACKAGE_VERSION},
                       {"mpi_ranks", n_mpi_processes(communicator)},
                       {"parameter_file", summary.parameter_file}};
    root["bed"]     = to_json(summary.bed);
    root["fluid"]   = {{"density", summary.fluid.density},
                       {"viscosity", summary.fluid.viscosity}};
    root["cases"]   = Json::array();
    for (const CaseResult &result : summary.cases)
      root["cases"].push_back(to_json(result));
    root["ledger"] = {{"max_mass_imbalance", summary.ledger.max_mass_imbalance},
                      {"max_momentum_imbalance", summary.ledger.max_momentum_imbalance},
                      {"max_solid_volume_error", summary.ledger.max_solid_volume_error}};
    root["cost"]   = to_json(summary.costs, summary, communicator);

    if (this_mpi_process(communicator) == 0)
      {
        const std::string unfinished = path + ".part";
        std::ofstream     stream(unfinished);
        stream << root.dump(2) << std::endl;
        if (!stream)
          throw std::runtime_error("Cannot write " + path + ": is the disk full?");
        stream.close();
        std::filesystem::rename(unfinished, path);
      }
  }
} // namespace graupel
