#include <graupel/base/convergence.h>
#include <graupel/simulation/study.h>

#include <deal.II/base/table_handler.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    RunParameters
    at_level(RunParameters parameters, const double value)
    {
      if (parameters.study.vary == "cell size")
        {
          parameters.mesh.cell_height *= value / parameters.mesh.cell_size;
          parameters.mesh.cell_size = value;
        }
      else if (parameters.study.vary == "time step")
        parameters.sweep.time_step = value;
      else if (parameters.study.vary == "filter length")
        {
          std::ostringstream text;
          text << std::setprecision(17) << value;
          parameters.coupling.filter_length = text.str();
        }
      return parameters;
    }

    double
    size_of(const LevelResult &level, const std::string &vary)
    {
      return vary == "time step"       ? level.time_step
             : vary == "filter length" ? level.filter_length
                                       : level.cell_size;
    }

    std::string
    number(const std::optional<double> &value)
    {
      if (!value)
        return "";
      std::ostringstream text;
      text << std::setprecision(10) << *value;
      return text.str();
    }

    void
    write_rows(const std::string &file_name, const std::vector<StudyRow> &rows)
    {
      std::ofstream file(file_name);
      file << "level,cells,cell_size,time_step,quantity,value,error_or_change,"
              "observed_order,filter_length,extrapolated,grid_convergence_index\n";
      for (const StudyRow &row : rows)
        file << row.level << ',' << row.result.cells << ','
             << number(row.result.cell_size) << ',' << number(row.result.time_step) << ','
             << row.measurement.quantity << ',' << number(row.measurement.value) << ','
             << number(row.error_or_change) << ',' << number(row.observed_order) << ','
             << number(row.result.filter_length) << ',' << number(row.extrapolated) << ','
             << number(row.index) << '\n';
      if (!file)
        throw std::runtime_error("The file " + file_name + " cannot be written.");
    }

    std::string
    table_of(const std::vector<StudyRow> &rows)
    {
      const auto shown = [](const std::optional<double> &value) {
        std::ostringstream text;
        if (value)
          text << std::setprecision(5) << *value;
        else
          text << '-';
        return text.str();
      };
      dealii::TableHandler table;
      for (const StudyRow &row : rows)
        {
          table.add_value("quantity", row.measurement.quantity);
          table.add_value("level", row.level);
          table.add_value("cells", row.result.cells);
          table.add_value("cell size", shown(row.result.cell_size));
          table.add_value("time step", shown(row.result.time_step));
          table.add_value("value", shown(row.measurement.value));
          table.add_value("change", shown(row.error_or_change));
          table.add_value("order",
                          row.oscillates ? "oscillates" : shown(row.observed_order));
          table.add_value("extrapolated", shown(row.extrapolated));
          table.add_value("GCI", shown(row.index));
        }
      std::ostringstream text;
      table.write_text(text);
      return text.str();
    }
  } // namespace

  std::vector<StudyRow>
  evaluate_study(const std::vector<LevelResult> &levels, const std::vector<double> &sizes)
  {
    std::vector<StudyRow> rows;
    if (levels.empty())
      return rows;
    for (unsigned int m = 0; m < levels[0].measurements.size(); ++m)
      for (unsigned int level = 0; level < levels.size(); ++level)
        {
          const auto value = [&](const unsigned int back) -> Computation {
            return {sizes[level - back], levels[level - back].measurements[m].value};
          };
          StudyRow row{
            level + 1, levels[level], levels[level].measurements[m], {}, {}, {}, {}};
          if (row.measurement.is_error)
            {
              row.error_or_change = row.measurement.value;
              if (level >= 1)
                row.observed_order = observed_order(value(0), value(1));
            }
          else if (level >= 1 && value(0).value != 0.)
            row.error_or_change =
              (value(0).value - value(1).value) / std::abs(value(0).value);
          if (!row.measurement.is_error && level >= 2 &&
              sizes[level] < sizes[level - 1] && sizes[level - 1] < sizes[level - 2])
            {
              const auto convergence = grid_convergence(value(0), value(1), value(2));
              row.observed_order     = convergence.order;
              row.extrapolated       = convergence.extrapolated;
              row.index              = convergence.index;
              row.oscillates         = convergence.oscillates;
            }
          rows.push_back(row);
        }
    return rows;
  }

  void
  run_study(const RunParameters &parameters,
            const RunLevel      &run_level,
            const std::string   &directory,
            Progress            &progress,
            MPI_Comm             communicator)
  {
    const StudyParameters   &study = parameters.study;
    std::vector<LevelResult> levels;
    std::vector<double>      sizes;
    const unsigned int       n = study.is_wanted() ? study.values.size() : 1;
    for (unsigned int level = 0; level < n; ++level)
      {
        std::ostringstream title;
        title << "study, level " << level + 1 << " of " << n;
        if (study.is_wanted())
          title << ": " << study.vary << ' ' << study.values[level];
        progress.say(title.str());
        try
          {
            levels.push_back(run_level(
              study.is_wanted() ? at_level(parameters, study.values[level]) : parameters,
              directory + "/level-" + std::to_string(level + 1)));
            sizes.push_back(size_of(levels.back(), study.vary));
          }
        catch (const std::exception &error)
          {
            // On several ranks the others may be elsewhere: no way to go on.
            if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
              throw;
            progress.say("study, level " + std::to_string(level + 1) +
                         " has failed and is left out: " + error.what());
          }
      }
    const auto rows = evaluate_study(levels, sizes);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_rows(directory + "/study.csv", rows);
    progress.say(table_of(rows));
  }
} // namespace graupel
