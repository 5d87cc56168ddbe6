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
    std::string
    text_of(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(17) << value;
      return text.str();
    }

    // The same mass of particles of another scale; the filter follows them.
    void
    set_scale(RunParameters &parameters, const double scale)
    {
      const double growth = scale / parameters.dem.particles.scale;
      auto        &count  = parameters.filling.count;
      count = static_cast<unsigned int>(std::lround(count / std::pow(growth, 3)));
      if (parameters.coupling.filter_length != "auto")
        parameters.coupling.filter_length =
          text_of(parameters.filter_length() * growth);
      for (ParticleType &type : parameters.dem.particles.further_types)
        type.scale *= growth;
      parameters.dem.particles.scale = scale;
    }

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
      else if (parameters.study.vary == "scale")
        set_scale(parameters, value);
      else if (parameters.study.vary == "filter length")
        parameters.coupling.filter_length = text_of(value);
      return parameters;
    }

    double
    size_of(const LevelResult &level, const std::string &vary)
    {
      return vary == "time step"       ? level.time_step
             : vary == "filter length" ? level.filter_length
             : vary == "scale"         ? level.scale
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
              "observed_order,filter_length,extrapolated,grid_convergence_index,scale,"
              "standard_error\n";
      for (const StudyRow &row : rows)
        file << row.level << ',' << row.result.cells << ','
             << number(row.result.cell_size) << ',' << number(row.result.time_step) << ','
             << row.measurement.quantity << ',' << number(row.measurement.value) << ','
             << number(row.error_or_change) << ',' << number(row.observed_order) << ','
             << number(row.result.filter_length) << ',' << number(row.extrapolated) << ','
             << number(row.index) << ',' << row.result.scale << ','
             << row.measurement.standard_error << '\n';
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
          table.add_value("scale", shown(row.result.scale));
          table.add_value("value", shown(row.measurement.value));
          table.add_value("change", shown(row.error_or_change));
          table.add_value("order",
                          row.oscillates ? "oscillates" : shown(row.observed_order));
          table.add_value("extrapolated", shown(row.extrapolated));
          table.add_value("error", shown(row.index));
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

  std::vector<StudyRow>
  evaluate_ladder(const std::vector<LevelResult> &levels)
  {
    std::vector<StudyRow> rows;
    if (levels.empty())
      return rows;
    for (unsigned int m = 0; m < levels[0].measurements.size(); ++m)
      {
        std::vector<Computation> computations;
        std::vector<double>      errors;
        for (unsigned int level = 0; level < levels.size(); ++level)
          {
            const Measurement &measured = levels[level].measurements[m];
            StudyRow           row{level + 1, levels[level], measured, {}, {}, {}, {}};
            if (level >= 1)
              row.error_or_change =
                (measured.value - computations.back().value) / std::abs(measured.value);
            computations.push_back({levels[level].scale, measured.value});
            errors.push_back(measured.standard_error);
            if (level >= 2)
              {
                const Estimate at_one = extrapolate(computations, errors, 1.);
                row.extrapolated      = at_one.value;
                row.index             = at_one.error / std::abs(at_one.value);
              }
            rows.push_back(row);
          }
      }
    return rows;
  }

  LevelResult
  mean_of(const std::vector<LevelResult> &repetitions)
  {
    const double n      = repetitions.size();
    LevelResult  result = repetitions.at(0);
    for (unsigned int m = 0; m < result.measurements.size(); ++m)
      {
        double sum = 0., squares = 0.;
        for (const LevelResult &one : repetitions)
          sum += one.measurements[m].value;
        for (const LevelResult &one : repetitions)
          squares += std::pow(one.measurements[m].value - sum / n, 2);
        result.measurements[m].value = sum / n;
        result.measurements[m].standard_error =
          n > 1. ? std::sqrt(squares / (n - 1.) / n) : 0.;
      }
    return result;
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
            std::vector<LevelResult> beds;
            for (unsigned int bed = 0; bed < study.repetitions; ++bed)
              {
                RunParameters own = study.is_wanted()
                                      ? at_level(parameters, study.values[level])
                                      : parameters;
                own.filling.seed += bed;
                beds.push_back(
                  run_level(own,
                            directory + "/level-" + std::to_string(level + 1) +
                              (bed > 0 ? "-" + std::to_string(bed + 1) : "")));
              }
            levels.push_back(mean_of(beds));
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
    const auto rows =
      study.vary == "scale" ? evaluate_ladder(levels) : evaluate_study(levels, sizes);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_rows(directory + "/study.csv", rows);
    progress.say(table_of(rows));
  }
} // namespace graupel
