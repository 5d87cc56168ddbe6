// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/base/parameters.h>
#include <graupel/base/stop_request.h>
#include <graupel/base/version.h>
#include <graupel/simulation/files/input_files.h>
#include <graupel/simulation/files/may_change.h>
#include <graupel/simulation/report.h>
#include <graupel/simulation/simulation.h>
#include <graupel/simulation/studies/study_levels.h>
#include <graupel/simulation/studies/study_runs.h>

#include <CLI/CLI.hpp>

#include <iostream>

using namespace graupel;

namespace
{
  struct Options
  {
    std::string              file, output, print_parameters;
    std::vector<std::string> overrides, arguments; // these with the program's name
    bool                     check = false, print_columns = false, resume = false;
    double                   time_limit = 0.; // [min], 0 for none
  };

  enum class Outcome
  {
    finished,
    told,    // --check and the like: nothing ran
    refused, // bad input
    failed,  // a study, some of whose levels have failed, or no report could be made
    stopped, // as it was asked to
    broken,  // by a fault
    unwritten
  };

  int
  exit_status(const Outcome outcome)
  {
    switch (outcome)
      {
        case Outcome::finished:
        case Outcome::told:
          return 0;
        case Outcome::refused:
        case Outcome::failed:
          return 1;
        case Outcome::broken:
          return 2;
        case Outcome::stopped:
          return 3;
        case Outcome::unwritten:
          return 4;
      }
    return 2;
  }

  const char *const statuses =
    "Exit status: 0, all is done; 1, the input is refused, levels of a study have "
    "failed, or all is done but no report could be made; 2, the run has stopped by a "
    "fault; 3, it has stopped by a signal (INT, TERM, USR1) or its time limit, and "
    "--resume goes on; 4, a file cannot be written.\n";

  bool
  is_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  add_options(CLI::App &app, Options &options)
  {
    app.set_version_flag("--version", "graupel " + version());
    app.add_option("FILE",
                   options.file,
                   "Parameter file (.prm, .json, .xml); examples are in prm/, installed "
                   "in share/graupel/prm/");
    app.add_flag(
      "--check",
      options.check,
      "Read the parameters, look for contradictions, print dimensionless groups and "
      "step sizes, and stop");
    app
      .add_flag(
        "--print-parameters{prm}",
        options.print_parameters,
        "Print every parameter with its explanation and value (the default "
        "without FILE), and stop; as JSON or XML with =json or =xml, which can be "
        "FILE in their turn")
      ->check(CLI::IsMember({"prm", "json", "xml"}));
    app.add_flag(
      "--print-columns",
      options.print_columns,
      "Print the columns of monitors.csv, cases.csv and of bins and what a run that is "
      "gone on with may change, as in the documentation, and stop");
    app
      .add_option("--set", options.overrides, "Override a value: \"Section/name=value\"")
      ->take_all()
      ->allow_extra_args(false);
    app.add_flag(
      "--resume", options.resume, "Go on from the checkpoint in the output directory");
    app.add_option("--output", options.output, "Directory of the results");
    app
      .add_option("--time-limit",
                  options.time_limit,
                  "Minutes of wall-clock time after which the run is to be over: before, "
                  "it writes a checkpoint and stops")
      ->check(CLI::PositiveNumber);
    app.footer(std::string(statuses) +
               "\nStart with one of the examples, and under MPI with mpirun -np N:\n"
               "  graupel prm/packed-bed/ricklick-2x.prm");
  }

  void
  print_columns()
  {
    std::cout << "## monitors.csv\n\n"
              << documentation(monitors()) << "\n## cases.csv\n\n"
              << documentation(case_quantities())
              << "\n## averages-lines-NN.csv, averages-planes-NN.csv\n\n"
              << documentation(bin_quantities()) << "\n## What may change\n\n"
              << table_of_changes();
  }

  bool
  is_study(const RunParameters &parameters)
  {
    return parameters.manufactured.is_given() || parameters.study.is_wanted();
  }

  // False if a level has failed.
  bool
  run_levels(const RunParameters &parameters, const std::string &file, Progress &progress)
  {
    const RunLevel manufactured = [&](const RunParameters &level,
                                      const std::string   &directory) {
      return manufactured_level(level, directory, progress, MPI_COMM_WORLD);
    };
    const RunLevel packed_bed = [&](const RunParameters &level,
                                    const std::string   &directory) {
      ResultFiles own(directory, MPI_COMM_WORLD, level.output.field_format);
      Simulation  simulation(level, file, own, progress, MPI_COMM_WORLD);
      own.begin();
      simulation.run();
      return packed_bed_level(level, simulation.result());
    };
    return run_study(parameters,
                     parameters.manufactured.is_given() ? manufactured : packed_bed,
                     parameters.output.directory,
                     progress,
                     MPI_COMM_WORLD);
  }

  // Everything is read before anything is written.
  Outcome
  run_whole(const RunParameters            &parameters,
            const Options                  &options,
            const dealii::ParameterHandler &prm)
  {
    ResultFiles       files(parameters.output.directory,
                      MPI_COMM_WORLD,
                      parameters.output.field_format);
    Progress          progress = is_first_rank()
                                   ? Progress(std::cout, stdout_is_terminal(), &files.log())
                                   : Progress();
    const std::string opening  = opening_lines(
      options.arguments, dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    if (is_study(parameters))
      {
        files.begin(&prm);
        progress.say(opening);
        return run_levels(parameters, options.file, progress) ? Outcome::finished
                                                              : Outcome::failed;
      }
    Simulation simulation(parameters, options.file, files, progress, MPI_COMM_WORLD);
    if (options.resume)
      {
        simulation.resume();
        files.go_on(prm);
      }
    else
      files.begin(&prm);
    progress.say(opening);
    if (options.time_limit > 0.)
      simulation.set_time_limit(60. * options.time_limit);
    simulation.run();
    return Outcome::finished;
  }

  // Reads, checks and runs. The output directory and whether a report is
  // wanted are left in @p directory and @p report.
  Outcome
  run(const Options &options, std::string &directory, bool &report)
  {
    RunParameters            parameters;
    dealii::ParameterHandler prm;
    parameters.declare(prm);
    ParameterFile file(prm);
    try
      {
        if (!options.file.empty())
          file.read(options.file);
        for (const std::string &assignment : options.overrides)
          file.set(assignment);
        if (!options.output.empty())
          file.set("Output/directory=" + options.output);
        if (options.print_columns && is_first_rank())
          print_columns();
        if (options.print_columns)
          return Outcome::told;
        if (!options.print_parameters.empty())
          {
            using Handler    = dealii::ParameterHandler;
            const auto style = options.print_parameters == "json"  ? Handler::JSON
                               : options.print_parameters == "xml" ? Handler::XML
                                                                   : Handler::PRM;
            if (is_first_rank())
              prm.print_parameters(std::cout, style | Handler::KeepDeclarationOrder);
            return Outcome::told;
          }
        parameters.texts = file.texts();
        parameters.check();
        require(!options.resume || !is_study(parameters),
                "Refinement study/vary",
                "a study cannot be resumed; run it without --resume");
        check_levels(parameters);
        for (const RunParameters &level : study_levels(parameters))
          check_input_files(level);
        if (options.check)
          {
            if (is_first_rank())
              std::cout << parameters.describe() << "No contradictions found."
                        << std::endl;
            return Outcome::told;
          }
        const Outcome outcome = run_whole(parameters, options, prm);
        directory             = parameters.output.directory;
        report                = parameters.output.report;
        return outcome;
      }
    catch (const InputError &error)
      {
        if (is_first_rank())
          std::cerr << file.explain(error) << std::endl;
        return Outcome::refused;
      }
    catch (const Stopped &)
      {
        return Outcome::stopped;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  std::string directory;
  bool        report = false, first = true;
  Outcome     outcome = Outcome::finished;
  {
    prepare_mpi_files();
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    note_signals();
    first = is_first_rank();

    CLI::App app(
      "Graupel: gas or liquid flowing through beds of spheres, CFD-DEM with scaled "
      "particles.",
      "graupel");
    Options options;
    add_options(app, options);
    options.arguments.assign(argv, argv + argc);
    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::ParseError &message)
      {
        return first ? app.exit(message) : message.get_exit_code();
      }
    if (options.file.empty() && options.print_parameters.empty() &&
        !options.print_columns)
      {
        if (first)
          std::cerr << "Which parameter file?\n\n" << app.help();
        return 1;
      }

    try
      {
        outcome = run(options, directory, report);
        if (outcome != Outcome::finished && outcome != Outcome::failed)
          return exit_status(outcome);
      }
    catch (const std::exception &error)
      {
        std::cerr << "The run has stopped. " << error.what() << std::endl;
        const bool is_file = dynamic_cast<const FileError *>(&error) != nullptr;
        const int  status  = exit_status(is_file ? Outcome::unwritten : Outcome::broken);
        // Other ranks may be waiting for this one.
        if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
          MPI_Abort(MPI_COMM_WORLD, status);
        return status;
      }
  }
  // After MPI has ended: a child process started under MPI is unsafe.
  const bool is_reported = first && report && make_report(directory, report_script());
  if (first && report && !is_reported)
    outcome = Outcome::failed;
  if (first)
    std::cout << "Results are in " << directory
              << (is_reported ? " (open report.html)" : "") << std::endl;
  return exit_status(outcome);
}
