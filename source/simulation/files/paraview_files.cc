#include <graupel/simulation/files/contact_output.h>
#include <graupel/simulation/files/particle_output.h>
#include <graupel/simulation/files/result_files.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/data_out.h>

// The files for ParaView.

namespace graupel
{
  namespace
  {
    // All ranks write into one file: a rank without particles would otherwise leave
    // a file without points, which ParaView complains about.
    constexpr unsigned int one_file       = 1;
    constexpr unsigned int counter_digits = 4;

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
                          Output           &&output,
                          Records           &records)
  {
    // The best compression takes five times as long for a hundredth of the bytes.
    dealii::DataOutBase::VtkFlags flags;
    flags.compression_level = decltype(flags.compression_level)::best_speed;
    output.set_flags(flags);
    records.emplace_back(time,
                         "vtu/" + output.write_vtu_with_pvtu_record(directory + "/vtu/",
                                                                    stem,
                                                                    records.size(),
                                                                    communicator,
                                                                    counter_digits,
                                                                    one_file));
    write_records(stem + ".pvd", records);
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
    const NodalVector flux = as_vector(nodes, flow.flux(), space.nodes);
    add_vector(output, space, flux, "flux");
    output.build_patches(nodes.mesh.mapping());
    add_record(time, "solution", output, records.fields);
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
    output.build_patches(nodes.mesh.mapping());
    add_record(time, "averages", output, records.averages);
  }

  void
  ResultFiles::add_particles(const double time, const Dem &dem)
  {
    add_record(time, "particles", ParticleOutput(dem), records.particles);
  }

  void
  ResultFiles::add_contacts(const double time, const Dem &dem)
  {
    add_record(time, "contacts", ContactOutput(dem.contact_states()), records.contacts);
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
