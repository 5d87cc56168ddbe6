#include <graupel/base/parameters.h>
#include <graupel/simulation/contact_output.h>
#include <graupel/simulation/particle_output.h>
#include <graupel/simulation/result_files.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/data_out.h>

#include <filesystem>
#include <iomanip>
#include <regex>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Everything that a run writes, so that a new one can take it away first.
    const std::regex own_files(
      "(parameters\\.prm|log\\.txt|summary\\.json|cases\\.csv|"
      "monitors\\.csv|(profiles|radial|midplane)-[0-9]+\\.csv|"
      "bed-(axial|radial|janssen|coordination|contacts)\\.csv|"
      "(solution|particles|contacts)\\.pvd|report\\.html|bed\\.bin)");

    // All ranks write into one file: a rank without particles would otherwise leave
    // a file without points, which ParaView complains about.
    constexpr unsigned int one_file       = 1;
    constexpr unsigned int counter_digits = 4;

    void
    prepare_directory(const std::string &directory)
    {
      namespace fs = std::filesystem;
      fs::create_directories(directory);
      for (const auto &entry : fs::directory_iterator(directory))
        if (std::regex_match(entry.path().filename().string(), own_files))
          fs::remove(entry.path());
      for (const char *folder :
           {"vtu", "figures", "checkpoint", "checkpoint.new", "checkpoint.old"})
        fs::remove_all(fs::path(directory) / folder);
      fs::create_directory(fs::path(directory) / "vtu");
      std::ofstream trial(fs::path(directory) / "log.txt");
      if (!trial)
        throw std::runtime_error("no file can be made there");
    }

    // Three nodal vectors as one vector of the unknowns of @p vector_nodes.
    NodalVector
    as_vector(const NodalSpace            &nodes,
              const NodalVectorField      &field,
              const dealii::DoFHandler<3> &vector_nodes)
    {
      dealii::IndexSet relevant;
      dealii::DoFTools::extract_locally_relevant_dofs(vector_nodes, relevant);
      NodalVector result(
        vector_nodes.locally_owned_dofs(), relevant, nodes.mesh.communicator());
      for (const auto &cell : vector_nodes.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const dealii::DoFHandler<3>::active_cell_iterator scalar_cell(
              &vector_nodes.get_triangulation(),
              cell->level(),
              cell->index(),
              &nodes.dof_handler);
            for (const unsigned int v : cell->vertex_indices())
              for (unsigned int i = 0; i < 3; ++i)
                if (const auto unknown = cell->vertex_dof_index(v, i);
                    vector_nodes.locally_owned_dofs().is_element(unknown))
                  result(unknown) = field[i](scalar_cell->vertex_dof_index(v, 0));
          }
      result.update_ghost_values();
      return result;
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
                           const bool         goes_on)
    : directory(directory)
    , communicator(communicator)
    , is_writer(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    std::string failure;
    if (is_writer)
      try
        {
          if (!goes_on)
            prepare_directory(directory);
        }
      catch (const std::exception &error)
        {
          failure = error.what();
        }
    failure = dealii::Utilities::MPI::broadcast(communicator, failure, 0);
    require(failure.empty(),
            "Output/directory",
            "cannot be written (" + failure + "); choose another with --output");
    if (is_writer)
      {
        log_stream.open(path("log.txt"), goes_on ? std::ios::app : std::ios::out);
        if (goes_on)
          return;
        monitors = open("monitors.csv");
        monitors
          << "time,phase,case,superficial_velocity,pressure_drop,bed_height,bottom_force,"
             "wall_force,fluid_force,kinetic_energy_per_particle,maximum_speed,"
             "mass_imbalance,momentum_imbalance,solid_volume_error,linear_iterations,"
             "cells,worst_node_imbalance,worst_cell_imbalance\n";
      }
  }

  void
  ResultFiles::continue_from(const Written &earlier, const double time)
  {
    records = earlier;
    if (!is_writer)
      return;
    std::ifstream            before(path("monitors.csv"));
    std::vector<std::string> lines;
    // The header does not begin with a number.
    for (std::string line; std::getline(before, line);)
      if (lines.empty() || std::strtod(line.c_str(), nullptr) <= time * (1. + 1e-9))
        lines.push_back(line);
    before.close();
    monitors = open("monitors.csv");
    for (const std::string &line : lines)
      monitors << line << '\n';
  }

  std::string
  ResultFiles::path(const std::string &name) const
  {
    return directory + "/" + name;
  }

  std::ofstream
  ResultFiles::open(const std::string &name) const
  {
    std::ofstream stream(path(name));
    if (!stream)
      throw std::runtime_error("Cannot write " + path(name) + ": is the disk full?");
    stream << std::setprecision(10);
    return stream;
  }

  void
  ResultFiles::write_parameters(const dealii::ParameterHandler &prm)
  {
    if (!is_writer)
      return;
    auto stream = open("parameters.prm");
    prm.print_parameters(stream,
                         dealii::ParameterHandler::PRM |
                           dealii::ParameterHandler::KeepDeclarationOrder);
  }

  void
  ResultFiles::add_monitor(const MonitorRow &row)
  {
    if (!is_writer)
      return;
    monitors << row.time << ',' << row.phase << ',' << row.flow_case << ','
             << row.superficial_velocity << ',' << row.pressure_drop << ','
             << row.bed_height << ',' << row.bottom_force << ',' << row.wall_force << ','
             << row.fluid_force << ',' << row.kinetic_energy << ',' << row.maximum_speed
             << ',' << row.mass_imbalance << ',' << row.momentum_imbalance << ','
             << row.solid_volume_error << ',' << row.linear_iterations << ',' << row.cells
             << ',' << row.worst_node_imbalance << ',' << row.worst_cell_imbalance
             << std::endl;
  }

  void
  ResultFiles::write_cases(const std::vector<CaseResult> &cases)
  {
    if (!is_writer)
      return;
    auto stream = open("cases.csv");
    stream
      << "superficial_velocity,pressure_drop,ergun_pressure_drop,deviation_from_ergun,"
         "gradient_deviation_from_ergun,wall_channelling_deviation,"
         "bed_height,bed_rise,"
         "mean_void_fraction,bottom_force,wall_force,fluid_force,weight,fluidized,steady,"
         "simulated_time,wall_seconds,cpu_seconds\n";
    for (const CaseResult &row : cases)
      stream << row.superficial_velocity << ',' << row.pressure_drop << ','
             << row.ergun_pressure_drop << ',' << row.deviation_from_ergun << ','
             << row.gradient_deviation_from_ergun << ',' << row.wall_channelling_deviation
             << ',' << row.bed_height << ',' << row.bed_rise << ','
             << row.mean_void_fraction << ',' << row.bottom_force << ',' << row.wall_force
             << ',' << row.fluid_force << ',' << row.weight << ',' << row.fluidized << ','
             << row.steady << ',' << row.simulated_time << ',' << row.wall_seconds << ','
             << row.cpu_seconds << '\n';
  }

  void
  ResultFiles::write_axial(const unsigned int             number,
                           const std::vector<RegionMean> &profile,
                           const CaseResult              &result)
  {
    if (!is_writer)
      return;
    auto stream = open(numbered("profiles", number));
    stream << "z,pressure,void_fraction,superficial_velocity,ergun_pressure\n";
    for (const RegionMean &slab : profile)
      stream << slab.height << ',' << slab.pressure << ',' << slab.void_fraction << ','
             << slab.flux << ','
             << result.ergun_pressure_drop *
                  std::max(0., 1. - slab.height / result.bed_height)
             << '\n';
  }

  void
  ResultFiles::write_radial(const unsigned int             number,
                            const std::vector<RegionMean> &profile,
                            const double                   radius)
  {
    if (!is_writer)
      return;
    auto stream = open(numbered("radial", number));
    stream << "wall_distance,void_fraction,superficial_velocity\n";
    for (const RegionMean &annulus : profile)
      stream << radius - annulus.radius << ',' << annulus.void_fraction << ','
             << annulus.flux << '\n';
  }

  void
  ResultFiles::write_mid_plane(const unsigned int             number,
                               const std::vector<PlanePoint> &points)
  {
    if (!is_writer)
      return;
    auto stream = open(numbered("midplane", number));
    stream << std::setprecision(6) << "x,z,void_fraction,superficial_velocity,pressure\n";
    for (const PlanePoint &point : points)
      stream << point.x << ',' << point.z << ',' << point.void_fraction << ','
             << point.flux << ',' << point.pressure << '\n';
  }

  void
  ResultFiles::add_fields(const double      time,
                          const NodalSpace &nodes,
                          const Medium     &medium,
                          const FlowSolver &flow)
  {
    dealii::DataOut<3> output;
    output.attach_dof_handler(nodes.dof_handler);
    output.add_data_vector(medium.void_fraction, "void_fraction");
    output.add_data_vector(medium.drag, "drag_coefficient");
    output.add_data_vector(flow.pressure(), "pressure");

    // The flux as a vector needs unknowns of its own.
    const dealii::FESystem<3> fe(nodes.fe, 3);
    dealii::DoFHandler<3>     vector_nodes(nodes.dof_handler.get_triangulation());
    vector_nodes.distribute_dofs(fe);
    const NodalVector flux = as_vector(nodes, flow.flux(), vector_nodes);
    output.add_data_vector(
      vector_nodes,
      flux,
      std::vector<std::string>(3, "flux"),
      std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
        3, dealii::DataComponentInterpretation::component_is_part_of_vector));
    output.build_patches(nodes.mesh.mapping());
    records.fields.emplace_back(time,
                                "vtu/" +
                                  output.write_vtu_with_pvtu_record(directory + "/vtu/",
                                                                    "solution",
                                                                    records.fields.size(),
                                                                    communicator,
                                                                    counter_digits,
                                                                    one_file));
    write_records("solution.pvd", records.fields);
  }

  void
  ResultFiles::add_particles(const double time, const Dem &dem)
  {
    records.particles.emplace_back(
      time,
      "vtu/" + ParticleOutput(dem).write_vtu_with_pvtu_record(directory + "/vtu/",
                                                              "particles",
                                                              records.particles.size(),
                                                              communicator,
                                                              counter_digits,
                                                              one_file));
    write_records("particles.pvd", records.particles);
  }

  void
  ResultFiles::add_contacts(const double time, const Dem &dem)
  {
    records.contacts.emplace_back(time,
                                  "vtu/" +
                                    ContactOutput(dem.contact_states())
                                      .write_vtu_with_pvtu_record(directory + "/vtu/",
                                                                  "contacts",
                                                                  records.contacts.size(),
                                                                  communicator,
                                                                  counter_digits,
                                                                  one_file));
    write_records("contacts.pvd", records.contacts);
  }

  void
  ResultFiles::write_records(const std::string &name, const Records &records) const
  {
    if (!is_writer)
      return;
    auto stream = open(name);
    dealii::DataOutBase::write_pvd_record(stream, records);
  }
} // namespace graupel
