// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/base/parameters.h>
#include <graupel/simulation/files/result_files.h>

#include <filesystem>
#include <iomanip>
#include <regex>
#include <sstream>

namespace graupel
{
  namespace
  {
    namespace fs = std::filesystem;

    // Everything that a run or a study writes, so that a new one can take it away first,
    // and nothing else.
    const std::regex own_files(
      "(parameters\\.prm|log\\.txt|summary\\.json|cases\\.csv|study\\.csv|"
      "monitors\\.csv|probes\\.csv|wall-forces\\.csv|snapshots\\.csv|"
      "(profiles|radial|midplane|averages|spectra)-[0-9]+\\.csv|"
      "averages-(lines|planes|midplane)-[0-9]+\\.csv|"
      "bed-(axial|radial|janssen|coordination|contacts)\\.csv|"
      "(solution|averages|particles|contacts)\\.pvd|(solution|averages)\\.xdmf|report\\.html|bed\\.bin)(\\.part)?");
    const std::regex own_vtu(
      "(solution|averages|particles|contacts)_[0-9.]+\\.p?vtu(\\.part)?");
    const std::regex own_h5("(solution|averages)_[0-9]+\\.h5(\\.part)?");
    const std::regex own_figures(
      "(pressure-profile|pressure-drop|deviation|bottom-force|bed-height|void-fraction|"
      "flux|bubbles|spectra|averages-lines|averages-planes|averages-midplane|radial|bed-"
      "radial|bed-janssen|monitors|wall-forces|particle-number|probes|cost|bed|"
      "study[a-z0-9-]*)"
      "\\.png");
    const std::regex own_checkpoint("(state|version)\\.bin(\\.part)?|fields.*");

    void
    remove_own(const fs::path &folder, const std::regex &own)
    {
      if (!fs::is_directory(folder))
        return;
      std::vector<fs::path> found;
      for (const auto &entry : fs::directory_iterator(folder))
        if (std::regex_match(entry.path().filename().string(), own))
          found.push_back(entry.path());
      for (const auto &path : found)
        fs::remove(path);
    }

    void
    prepare_directory(const fs::path &directory, const bool in_hdf5)
    {
      fs::create_directories(directory);
      remove_own(directory, own_files);
      remove_own(directory / "vtu", own_vtu);
      remove_own(directory / "h5", own_h5);
      remove_own(directory / "figures", own_figures);
      for (const char *folder : {"checkpoint", "checkpoint.new", "checkpoint.old"})
        {
          remove_own(directory / folder, own_checkpoint);
          if (fs::is_directory(directory / folder) && fs::is_empty(directory / folder))
            fs::remove(directory / folder);
        }
      fs::create_directory(directory / "vtu");
      if (in_hdf5)
        fs::create_directory(directory / "h5");
      std::ofstream trial(directory / "log.txt");
      if (!trial)
        throw std::runtime_error("no file can be made there");
    }

    std::string
    numbered(const std::string &name, const unsigned int number)
    {
      std::ostringstream text;
      text << name << '-' << std::setw(2) << std::setfill('0') << number << ".csv";
      return text.str();
    }
  } // namespace

  ResultFiles::ResultFiles(const std::string &directory,
                           MPI_Comm           communicator,
                           const std::string &field_format)
    : directory(directory)
    , communicator(communicator)
    , is_writer(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , in_hdf5(field_format == "hdf5")
    , monitors(path("monitors.csv"))
    , probes(path("probes.csv"))
    , wall_forces(path("wall-forces.csv"))
    , snapshots(path("snapshots.csv"))
  {
  }

  void
  ResultFiles::begin(const dealii::ParameterHandler *prm)
  {
    std::string failure;
    if (is_writer)
      try
        {
          prepare_directory(directory, in_hdf5);
        }
      catch (const std::exception &error)
        {
          failure = error.what();
        }
    failure = dealii::Utilities::MPI::broadcast(communicator, failure, 0);
    require(failure.empty(),
            "Output/directory",
            "cannot be written (" + failure + "); choose another with --output");
    open_log(std::ios::out);
    if (prm != nullptr)
      write_parameters(*prm);
  }

  void
  ResultFiles::go_on(const dealii::ParameterHandler &prm)
  {
    open_log(std::ios::app);
    write_parameters(prm);
  }

  void
  ResultFiles::open_log(const std::ios::openmode mode)
  {
    if (is_writer)
      log_stream.open(path("log.txt"), mode);
  }

  void
  ResultFiles::continue_from(const Written &earlier, const double time)
  {
    records = earlier;
    if (is_writer)
      for (GrowingTable *table : {&monitors, &probes, &wall_forces, &snapshots})
        table->continue_from(time);
  }

  std::string
  ResultFiles::path(const std::string &name) const
  {
    return directory + "/" + name;
  }

  void
  ResultFiles::check_log()
  {
    if (is_writer && !log_stream)
      throw FileError(path("log.txt"), "lines were lost, perhaps as the disk is full");
  }

  void
  ResultFiles::write(const std::string                         &name,
                     const std::function<void(std::ostream &)> &write) const
  {
    if (is_writer)
      write_file(path(name), [&](std::ostream &file) {
        file << std::setprecision(10);
        write(file);
      });
  }

  void
  ResultFiles::write_parameters(const dealii::ParameterHandler &prm)
  {
    write("parameters.prm", [&](std::ostream &file) {
      prm.print_parameters(file,
                           dealii::ParameterHandler::PRM |
                             dealii::ParameterHandler::KeepDeclarationOrder);
    });
  }

  void
  ResultFiles::add_monitor(const MonitorRow &row)
  {
    if (is_writer)
      monitors.add(monitors_header(), csv_row(row));
  }

  void
  ResultFiles::add_probes(const std::string &header, const std::string &row)
  {
    if (is_writer)
      probes.add(header, row);
  }

  void
  ResultFiles::add_wall_forces(const std::string &header, const std::string &row)
  {
    if (is_writer)
      wall_forces.add(header, row);
  }

  void
  ResultFiles::write_cases(const std::vector<CaseResult> &cases)
  {
    write("cases.csv", [&](std::ostream &file) {
      file << header(case_quantities()) << '\n';
      for (const CaseResult &flow : cases)
        file << csv_row(case_quantities(), flow.values) << '\n';
    });
  }

  void
  ResultFiles::write_axial(const unsigned int number,
                           const CaseView    &flow,
                           const CaseResult  &result)
  {
    if (flow.axial.empty())
      return;
    const auto   bed   = flow.whole_bed();
    const Value &ergun = result["ergun_pressure_drop"];
    write(numbered("profiles", number), [&](std::ostream &file) {
      file << "z,pressure,void_fraction,superficial_velocity,ergun_pressure\n";
      for (const RegionMean &slab : flow.axial)
        {
          file << slab.height << ',' << slab.pressure << ',' << slab.void_fraction << ','
               << slab.flux << ',';
          if (bed && ergun)
            file << *ergun *
                      std::clamp(
                        (bed->bottom + bed->height - slab.height) / bed->height, 0., 1.);
          file << '\n';
        }
    });
  }

  void
  ResultFiles::write_radial(const unsigned int             number,
                            const std::vector<RegionMean> &profile,
                            const double                   radius)
  {
    write(numbered("radial", number), [&](std::ostream &file) {
      file << "wall_distance,void_fraction,superficial_velocity\n";
      for (const RegionMean &annulus : profile)
        file << radius - annulus.radius << ',' << annulus.void_fraction << ','
             << annulus.flux << '\n';
    });
  }

  void
  ResultFiles::write_mid_plane(const unsigned int             number,
                               const std::vector<PlanePoint> &points,
                               const bool                     is_mean)
  {
    write(numbered(is_mean ? "averages-midplane" : "midplane", number),
          [&](std::ostream &file) {
            file << std::setprecision(6)
                 << "x,z,void_fraction,superficial_velocity,pressure\n";
            for (const PlanePoint &point : points)
              file << point.x << ',' << point.z << ',' << point.void_fraction << ','
                   << point.flux << ',' << point.pressure << '\n';
          });
  }

  void
  ResultFiles::add_snapshot(const double                   time,
                            const unsigned int             number,
                            const std::vector<PlanePoint> &points)
  {
    if (!is_writer)
      return;
    std::ostringstream text;
    text << std::setprecision(6);
    for (const PlanePoint &point : points)
      text << (text.tellp() > 0 ? "\n" : "") << time << ',' << number << ',' << point.x
           << ',' << point.z << ',' << point.void_fraction;
    snapshots.add("time,case,x,z,void_fraction", text.str());
  }

  void
  ResultFiles::write_table(const std::string &name, const std::string &text) const
  {
    if (!text.empty())
      write(name, [&](std::ostream &file) { file << text; });
  }

  void
  ResultFiles::write_averages(const unsigned int                   number,
                              const CaseAverages                  &averages,
                              const std::vector<SeriesStatistics> &window)
  {
    write_table(numbered("averages", number), series_table(window));
    write_table(numbered("spectra", number), spectra_table(window));
    write_table(numbered("averages-lines", number), averages.lines_table());
    write_table(numbered("averages-planes", number), averages.planes_table());
  }
} // namespace graupel
