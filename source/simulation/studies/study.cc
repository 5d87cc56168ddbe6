// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/simulation/studies/study.h>
#include <graupel/simulation/studies/study_levels.h>

#include <deal.II/base/table_handler.h>

#include <chrono>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>

namespace graupel
{
  namespace
  {
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
      write_file(file_name, [&](std::ostream &file) {
        file << "level,cells,cell_size,time_step,quantity,value,error_or_change,"
                "observed_order,filter_length,extrapolated,grid_convergence_index,scale,"
                "standard_error,status\n";
        for (const StudyRow &row : rows)
          {
            const bool computed = !row.result.has_failed;
            const auto of_level = [computed](const double value) {
              return computed ? number(value) : "";
            };
            file << row.level << ',' << of_level(row.result.cells) << ','
                 << of_level(row.result.cell_size) << ',' << number(row.result.time_step)
                 << ',' << row.measurement.quantity << ','
                 << number(row.measurement.value) << ',' << number(row.error_or_change)
                 << ',' << number(row.observed_order) << ','
                 << number(row.result.filter_length) << ',' << number(row.extrapolated)
                 << ',' << number(row.index) << ',' << number(row.result.scale) << ','
                 << of_level(row.measurement.standard_error) << ','
                 << (computed ? "finished" : "failed") << '\n';
          }
      });
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
          const bool failed = row.result.has_failed;
          table.add_value("quantity", row.measurement.quantity);
          table.add_value("level", row.level);
          table.add_value("cells", failed ? "-" : std::to_string(row.result.cells));
          table.add_value("cell size", failed ? "-" : shown(row.result.cell_size));
          table.add_value("time step", shown(row.result.time_step));
          table.add_value("scale", shown(row.result.scale));
          table.add_value("value", failed ? "failed" : shown(row.measurement.value));
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

    // Whether every rank comes here within seconds, as after a failure that all see at
    // once. Otherwise the others wait for this rank in the middle of the level. Of a
    // communicator that nothing else uses.
    bool
    all_ranks_are_here(MPI_Comm communicator)
    {
      using namespace std::chrono;
      MPI_Request request;
      MPI_Ibarrier(communicator, &request);
      const auto patience = steady_clock::now() + seconds(10);
      int        done     = 0;
      while (!done && steady_clock::now() < patience)
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          std::this_thread::sleep_for(milliseconds(1));
        }
      return done;
    }

    // The level's own directory; each of its beds has one.
    std::string
    directory_of(const std::string &directory,
                 const unsigned int level,
                 const unsigned int bed)
    {
      return directory + "/level-" + std::to_string(level + 1) +
             (bed > 0 ? "-" + std::to_string(bed + 1) : "");
    }

    // The mean over the beds of a level.
    LevelResult
    run_beds(RunParameters      parameters,
             const RunLevel    &run_level,
             const std::string &directory,
             const unsigned int level)
    {
      std::vector<LevelResult> beds;
      for (unsigned int bed = 0; bed < parameters.study.repetitions; ++bed)
        {
          beds.push_back(run_level(parameters, directory_of(directory, level, bed)));
          ++parameters.filling.seed;
        }
      return mean_of(beds);
    }

    LevelResult
    failed_level(const RunParameters &parameters)
    {
      LevelResult result;
      result.time_step     = parameters.sweep.longest_step();
      result.filter_length = parameters.filter_length();
      result.scale         = parameters.dem.particles.scale;
      result.has_failed    = true;
      return result;
    }

    std::string
    title_of(const StudyParameters &study,
             const unsigned int     level,
             const unsigned int     n_levels)
    {
      std::ostringstream title;
      title << "study, level " << level + 1 << " of " << n_levels;
      if (study.is_wanted())
        title << ": " << study.vary << ' ' << study.values[level];
      return title.str();
    }
  } // namespace

  bool
  run_study(const RunParameters &parameters,
            const RunLevel      &run_level,
            const std::string   &directory,
            Progress            &progress,
            MPI_Comm             communicator)
  {
    // Left alone by a throw: to free it would wait for the ranks that do not come.
    MPI_Comm of_failures = dealii::Utilities::MPI::duplicate_communicator(communicator);
    const StudyParameters   &study    = parameters.study;
    const auto               planned  = study_levels(parameters);
    bool                     all_well = true;
    std::vector<LevelResult> levels;
    std::vector<double>      sizes;
    for (unsigned int level = 0; level < planned.size(); ++level)
      {
        const std::string title = title_of(study, level, planned.size());
        progress.say(title);
        try
          {
            levels.push_back(run_beds(planned[level], run_level, directory, level));
          }
        catch (const std::exception &error)
          {
            if (!all_ranks_are_here(of_failures))
              throw;
            all_well = false;
            levels.push_back(failed_level(planned[level]));
            progress.say(title + " has failed: " + error.what() +
                         " No order, change or extrapolation is computed across it.");
          }
        sizes.push_back(size_of(levels.back(), study.vary));
      }
    dealii::Utilities::MPI::free_communicator(of_failures);
    const auto rows =
      study.vary == "scale" ? evaluate_ladder(levels) : evaluate_study(levels, sizes);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_rows(directory + "/study.csv", rows);
    progress.say(table_of(rows));
    return all_well;
  }
} // namespace graupel
