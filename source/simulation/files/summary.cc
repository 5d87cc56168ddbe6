// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/simulation/files/summary.h>

#include <deal.II/base/config.h>

#include <nlohmann/json.hpp>

namespace graupel
{
  namespace
  {
    using Json = nlohmann::ordered_json; // a number that is not finite becomes null

    Json
    to_json(const Value &value)
    {
      return value ? Json(*value) : Json();
    }

    Json
    to_json(const BedResult &bed)
    {
      return {{"particle_count", bed.particle_count},
              {"particle_diameter", bed.particle_diameter},
              {"scale", bed.scale},
              {"solid_volume", bed.solid_volume},
              {"bottom", to_json(bed.bottom)},
              {"height", to_json(bed.height)},
              {"mean_void_fraction", to_json(bed.mean_void_fraction)},
              {"mean_coordination_number", bed.mean_coordination_number},
              {"original_diameter", bed.original_diameter},
              {"vessel_diameter", bed.vessel_diameter},
              {"vessel_height", bed.vessel_height},
              {"original_void_fraction", to_json(bed.original_void_fraction)},
              {"original_solid_ratio", bed.original_solid_ratio}};
    }

    Json
    to_json(const CaseResult &result)
    {
      Json        json;
      const auto &table = case_quantities();
      for (std::size_t n = 0; n < table.size(); ++n)
        if (const Value &value = result.values[n]; value && table[n].unit == "flag")
          json[table[n].name] = *value != 0.;
        else
          json[table[n].name] = to_json(value);
      return json;
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
    root["program"]   = {{"name", "graupel"},
                         {"version", GRAUPEL_VERSION},
                         {"deal_ii_version", DEAL_II_PACKAGE_VERSION},
                         {"mpi_ranks", n_mpi_processes(communicator)},
                         {"parameter_file", summary.parameter_file}};
    root["reference"] = summary.reference;
    root["bed"]       = to_json(summary.bed);
    root["fluid"]     = {{"density", summary.fluid.density},
                         {"viscosity", summary.fluid.viscosity}};
    root["cases"]     = Json::array();
    for (const CaseResult &result : summary.cases)
      root["cases"].push_back(to_json(result));
    root["ledger"] = {{"max_mass_imbalance", summary.ledger.max_mass_imbalance},
                      {"max_momentum_imbalance", summary.ledger.max_momentum_imbalance},
                      {"max_solid_volume_error", summary.ledger.max_solid_volume_error}};
    root["cost"]   = to_json(summary.costs, summary, communicator);

    if (this_mpi_process(communicator) == 0)
      write_file(path, [&](std::ostream &file) { file << root.dump(2) << '\n'; });
  }
} // namespace graupel
