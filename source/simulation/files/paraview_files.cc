// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/files.h>
#include <graupel/simulation/files/contact_output.h>
#include <graupel/simulation/files/particle_output.h>
#include <graupel/simulation/files/result_files.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/data_out.h>

#include <sstream>

// The files for ParaView.

namespace graupel
{
  namespace
  {
    constexpr unsigned int counter_digits = 4;

    // The next file of a series, in the folder that is called as its ending is.
    std::string
    next_file(const std::string          &ending,
              const std::string          &stem,
              const ResultFiles::Records &records)
    {
      return ending + '/' + stem + '_' +
             dealii::Utilities::int_to_string(records.size(), counter_digits) + '.' +
             ending;
    }

    // This rank's part of the file that all ranks make of what they have to show.
    template <class Output>
    std::string
    part_of_file(const Output &output, MPI_Comm communicator)
    {
      namespace mpi = dealii::Utilities::MPI;
      std::ostringstream whole;
      output.write_vtu(whole);
      const std::string  text  = whole.str();
      const auto         begin = text.find("<Piece"), end = text.rfind("</Piece>");
      const unsigned int rank = mpi::this_mpi_process(communicator),
                         n    = mpi::n_mpi_processes(communicator);
      AssertThrow(begin != std::string::npos && end != std::string::npos,
                  dealii::ExcMessage("deal.II writes another kind of VTU file."));
      const auto after = end + std::string("</Piece>\n").size();
      return (rank == 0 ? text.substr(0, begin) : "") +
             text.substr(begin, after - begin) +
             (rank + 1 == n ? text.substr(after) : "");
    }

    constexpr const char *xdmf_begin =
      "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
      "<Xdmf Version=\"2.0\">\n  <Domain>\n    <Grid Name=\"CellTime\" "
      "GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    constexpr const char *xdmf_end = "    </Grid>\n  </Domain>\n</Xdmf>\n";

    // Numbers of eight bytes: a node's place, and a cell's eight corners in four bytes
    // each.
    std::uint64_t
    expected_bytes(const dealii::DataOutBase::DataOutFilter &filter)
    {
      std::uint64_t numbers = 3 * filter.n_nodes() + 4 * filter.n_cells();
      for (unsigned int set = 0; set < filter.n_data_sets(); ++set)
        numbers += filter.get_data_set_dim(set) * filter.n_nodes();
      return 8 * numbers;
    }

    // Writes what @p output has, each node once, as the file @p path, and returns how XDMF
    // describes it under the name @p name.
    std::string
    write_hdf5(dealii::DataOut<3> &output,
               const std::string  &path,
               const std::string  &name,
               const double        time,
               MPI_Comm            communicator)
    {
      namespace mpi = dealii::Utilities::MPI;
      dealii::DataOutBase::DataOutFilter filter(
        dealii::DataOutBase::DataOutFilterFlags(true, true));
      output.write_filtered_data(filter);
      require_room(path, expected_bytes(filter), communicator);
      write_file(
        path,
        [&](const std::string &file) {
          output.write_hdf5_parallel(filter, file, communicator);
        },
        communicator);
      return mpi::broadcast(communicator,
                            output.create_xdmf_entry(filter, name, time, communicator)
                              .get_xdmf_content(3),
                            0);
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

    // The unknowns that a vector as one field needs beside those of the nodes.
    struct VectorSpace
    {
      explicit VectorSpace(const NodalSpace &scalar)
        : fe(scalar.fe, 3)
        , nodes(scalar.dof_handler.get_triangulation())
      {
        nodes.distribute_dofs(fe);
      }

      const dealii::FESystem<3> fe;
      dealii::DoFHandler<3>     nodes;
    };

    // The best compression takes five times as long for a hundredth of the bytes.
    void
    compress_fast(dealii::DataOut<3> &output)
    {
      dealii::DataOutBase::VtkFlags flags;
      flags.compression_level = decltype(flags.compression_level)::best_speed;
      output.set_flags(flags);
    }

    // Flux over void fraction at each node.
    NodalVectorField
    interstitial_velocity(const NodalVectorField &flux, const NodalVector &void_fraction)
    {
      NodalVectorField velocity = flux;
      for (NodalVector &component : velocity)
        {
          for (unsigned int k = 0; k < component.locally_owned_size(); ++k)
            component.local_element(k) /= void_fraction.local_element(k);
          component.update_ghost_values();
        }
      return velocity;
    }

    // Numbers of each cell that tell how the mesh is made and shared.
    struct CellNumbers
    {
      explicit CellNumbers(const dealii::Triangulation<3> &mesh)
        : subdomain(mesh.n_active_cells())
        , level(mesh.n_active_cells())
      {
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              subdomain(cell->active_cell_index()) = cell->subdomain_id();
              level(cell->active_cell_index())     = cell->level();
            }
      }

      dealii::Vector<float> subdomain, level;
    };

    void
    add_vector(dealii::DataOut<3> &output,
               const VectorSpace  &space,
               const NodalVector  &vector,
               const std::string  &name)
    {
      using namespace dealii::DataComponentInterpretation;
      output.add_data_vector(
        space.nodes,
        vector,
        std::vector<std::string>(3, name),
        std::vector<DataComponentInterpretation>(3, component_is_part_of_vector));
    }
  } // namespace

  template <class Output>
  void
  ResultFiles::add_record(const double       time,
                          const std::string &stem,
                          const Output      &output,
                          Records           &records)
  {
    const std::string name = next_file("vtu", stem, records);
    write_file(path(name), part_of_file(output, communicator), communicator);
    records.emplace_back(time, name);
    write(stem + ".pvd", [&](std::ostream &file) {
      dealii::DataOutBase::write_pvd_record(file, records);
    });
  }

  void
  ResultFiles::add_field_record(const double        time,
                                const std::string  &stem,
                                dealii::DataOut<3> &output,
                                Records            &records)
  {
    if (!in_hdf5)
      {
        add_record(time, stem, output, records);
        return;
      }
    const std::string name = next_file("h5", stem, records);
    records.emplace_back(time, write_hdf5(output, path(name), name, time, communicator));
    write(stem + ".xdmf", [&](std::ostream &file) {
      file << xdmf_begin;
      for (const auto &record : records)
        file << record.second;
      file << xdmf_end;
    });
  }

  void
  ResultFiles::add_fields(const double time, const CoupledFlow &fluid)
  {
    add_fields(time, fluid.nodes(), fluid.exchange().medium(), fluid.fluid());
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

    const VectorSpace space(nodes);
    const NodalVector flux     = as_vector(nodes, flow.flux(), space.nodes);
    const NodalVector velocity = as_vector(
      nodes, interstitial_velocity(flow.flux(), medium.void_fraction), space.nodes);
    add_vector(output, space, flux, "flux");
    add_vector(output, space, velocity, "velocity");

    const CellNumbers cells(nodes.dof_handler.get_triangulation());
    // A file that has each node once has no place for what jumps from cell to cell.
    if (!in_hdf5)
      {
        output.add_data_vector(cells.subdomain, "subdomain");
        output.add_data_vector(cells.level, "refinement_level");
      }
    compress_fast(output);
    output.build_patches(nodes.mesh.mapping());
    add_field_record(time, "solution", output, records.fields);
  }

  void
  ResultFiles::add_averages(const double         time,
                            const NodalSpace    &nodes,
                            const FieldAverages &averages)
  {
    using Field = FieldAverages;
    dealii::DataOut<3> output;
    output.attach_dof_handler(nodes.dof_handler);
    const NodalVector void_fraction = averages.rms(Field::void_fraction);
    const NodalVector pressure      = averages.rms(Field::pressure);
    output.add_data_vector(averages.mean(Field::void_fraction), "void_fraction_mean");
    output.add_data_vector(averages.mean(Field::pressure), "pressure_mean");
    output.add_data_vector(void_fraction, "void_fraction_rms");
    output.add_data_vector(pressure, "pressure_rms");

    const VectorSpace space(nodes);
    NodalVectorField  mean, rms;
    for (unsigned int i = 0; i < 3; ++i)
      {
        mean[i] = averages.mean(Field::flux + i);
        rms[i]  = averages.rms(Field::flux + i);
        mean[i].update_ghost_values();
      }
    const NodalVector flux_mean = as_vector(nodes, mean, space.nodes);
    const NodalVector flux_rms  = as_vector(nodes, rms, space.nodes);
    add_vector(output, space, flux_mean, "flux_mean");
    add_vector(output, space, flux_rms, "flux_rms");
    compress_fast(output);
    output.build_patches(nodes.mesh.mapping());
    add_field_record(time, "averages", output, records.averages);
  }

  void
  ResultFiles::add_particles(const double time, const Dem &dem)
  {
    add_record(time, "particles", particle_output(dem), records.particles);
  }

  void
  ResultFiles::add_contacts(const double time, const Dem &dem)
  {
    add_record(time, "contacts", contact_output(dem.contact_states()), records.contacts);
  }
} // namespace graupel
