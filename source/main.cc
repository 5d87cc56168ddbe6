#include <graupel/base/parameters.h>
#include <graupel/simulation/packed_bed.h>
#include <graupel/simulation/report.h>
#include <graupel/simulation/study_runs.h>

#include <CLI/CLI.hpp>

#include <iostream>

using namespace graupel;

namespace
{
  struct Options
  {
    std::string              file, output;
    std::vector<std::string> overrides;
    bool                     check = false, print_parameters = false, resume = false;
  };

  enum class Outcome
  {
    finished,
    told,   // --check and the like: nothing ran
    refused // bad input
  };

  bool
  is_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  add_options(CLI::App &app, Options &options)
  {
    app.set_version_flag("--version", "graupel " GRAUPEL_VERSION);
    app.add_option("FILE", options.file, "Parameter file (.prm); examples are in prm/");
    app.add_flag(
      "--check",
      options.check,
      "Read the parameters, look for contradictions, print dimensionless groups and "
      "step sizes, and stop");
    app.add_flag(
      "--print-parameters",
      options.print_parameters,
      "Print every parameter with its explanation and value (the default without "
      "FILE), and stop");
    app
      .add_option("--set", options.overrides, "Override a value: \"Section/name=value\"")
      ->take_all()
      ->allow_extra_args(false);
    app.add_flag(
      "--resume", options.resume, "Go on from the checkpoint in the output directory");
    app.add_option("--output", options.output, "Directory of the results");
    app.footer("Start with one of the examples, and under MPI with mpirun -np N:\n"
               "  graupel prm/packed-bed/ricklick-2x.prm");
  }

  // A study, or one run.
  void
  run_whole(const RunParameters &parameters,
            const std::string   &file,
            const bool           resume,
            ResultFiles         &files,
            Progress            &progress)
  {
    const RunLevel manufactured = [&](const RunParameters &level,
                                      const std::string   &directory) {
      return manufactured_level(level, directory, progress, MPI_COMM_WORLD);
    };
    const RunLevel packed_bed = [&](const RunParameters &level,
                                    const std::string   &directory) {
      ResultFiles own(directory, MPI_COMM_WORLD);
      PackedBed   bed(level, file, own, progress, MPI_COMM_WORLD);
      bed.run();
      return packed_bed_level(level, bed.result());
    };
    if (parameters.manufactured.is_given() || parameters.study.is_wanted())
      run_study(parameters,
                parameters.manufactured.is_given() ? manufactured : packed_bed,
                parameters.output.directory,
                progress,
                MPI_COMM_WORLD);
    else
      PackedBed(parameters, file, files, progress, MPI_COMM_WORLD).run(resume);
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
        if (options.print_parameters)
          {
            if (is_first_rank())
              prm.print_parameters(std::cout,
                                   dealii::ParameterHandler::PRM |
                                     dealii::ParameterHandler::KeepDeclarationOrder);
            return Outcome::told;
          }
        parameters.check();
        if (options.check)
          {
            if (is_first_rank())
              std::cout << parameters.describe() << "No contradictions found."
                        << std::endl;
            return Outcome::told;
          }
        require(!options.resume ||
                  !(parameters.manufactured.is_given() || parameters.study.is_wanted()),
                "Refinement study/vary",
                "a study cannot be resumed; run it without --resume");
        if (options.resume) // before anything is touched
          read_checkpoint(parameters.output.directory + "/checkpoint",
                          identity_of_run(parameters));
        ResultFiles files(parameters.output.directory, MPI_COMM_WORLD, options.resume);
        files.write_parameters(prm);
        Progress progress = is_first_rank()
                              ? Progress(std::cout, stdout_is_terminal(), &files.log())
                              : Progress();
        run_whole(parameters, options.file, options.resume, files, progress);
        directory = parameters.output.directory;
        report    = parameters.output.report;
        return Outcome::finished;
      }
    catch (const InputError &error)
      {
        if (is_first_rank())
          std::cerr << file.explain(error) << std::endl;
        return Outcome::refused;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  std::string directory;
  bool        report = false, first = true;
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    first = is_first_rank();

    CLI::App app(
      "Graupel: gas or liquid flowing through beds of spheres, CFD-DEM with scaled "
      "particles.",
      "graupel");
    Options options;
    add_options(app, options);
    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::ParseError &message)
      {
        return first ? app.exit(message) : message.get_exit_code();
      }
    if (options.file.empty() && !options.print_parameters)
      {
        if (first)
          std::cerr << "Which parameter file?\n\n" << app.help();
        return 1;
      }

    try
      {
        const Outcome outcome = run(options, directory, report);
        if (outcome != Outcome::finished)
          return outcome == Outcome::told ? 0 : 1;
      }
    catch (const std::exception &error)
      {
        std::cerr << "The run has stopped. " << error.what() << std::endl;
        // Other ranks may be waiting for this one.
        if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
          MPI_Abort(MPI_COMM_WORLD, 1);
        return 1;
      }
  }
  // After MPI has ended: a child process started under MPI is unsafe.
  if (first && report)
    make_report(directory);
  if (first)
    std::cout << "Results are in " << directory << (report ? " (open report.html)" : "")
              << std::endl;
  return 0;
}
