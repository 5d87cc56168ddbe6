#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/simulation/files/particle_output.h>

namespace graupel
{
  namespace
  {
    const std::vector<std::string> scalar_names{"id",
                                                "type",
                                                "diameter",
                                                "coordination_number",
                                                "wall_contacts",
                                                "mean_normal_stress"};
    const std::vector<std::string> vector_names{
      "velocity", "spin", "contact_force", "fluid_force"};

    // A third of the trace of the stress in each own particle, 1/V sum of force times
    // arm over its contacts; only the normal force is along the arm [Pa].
    std::vector<double>
    mean_normal_stresses(const ParticleArrays            &particles,
                         const std::vector<ContactState> &contacts)
    {
      std::vector<double> stresses(particles.n_owned);
      const auto          rows = rows_by_id(particles);
      for (const ContactState &contact : contacts)
        for (const auto id : {contact.first, contact.second})
          if (const auto found = rows.find(id); found != rows.end())
            {
              const double radius = particles.body[found->second].radius;
              const double arm =
                radius - (contact.second < 0 ? 1. : 0.5) * contact.overlap;
              stresses[found->second] -=
                contact.force * contact.normal * arm / (3. * sphere_volume(radius));
            }
      return stresses;
    }
  } // namespace

  ParticleOutput::ParticleOutput(const Dem &dem)
    : patches(dem.particles().n_owned)
  {
    const ParticleArrays &particles = dem.particles();
    const auto            contacts  = dem.contact_states(true);
    const ContactCounts   counts    = count_contacts(particles, contacts);
    const auto            stresses  = mean_normal_stresses(particles, contacts);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const Body &body           = particles.body[row];
        auto       &patch          = patches[row];
        patch.vertices[0]          = body.position;
        patch.patch_index          = row;
        patch.points_are_available = false;
        patch.data.reinit(scalar_names.size() + 3 * vector_names.size(), 1);
        unsigned int next = 0;
        for (const double value : {static_cast<double>(particles.id[row]),
                                   static_cast<double>(particles.type[row]),
                                   2. * body.radius,
                                   static_cast<double>(counts.particles[row]),
                                   static_cast<double>(counts.walls[row]),
                                   stresses[row]})
          patch.data(next++, 0) = value;
        for (const auto &vector : {body.velocity,
                                   body.spin,
                                   dem.contact_force(row),
                                   particles.external_force[row]})
          for (unsigned int i = 0; i < 3; ++i)
            patch.data(next++, 0) = vector[i];
      }
  }

  const std::vector<dealii::DataOutBase::Patch<0, 3>> &
  ParticleOutput::get_patches() const
  {
    return patches;
  }

  std::vector<std::string>
  ParticleOutput::get_dataset_names() const
  {
    std::vector<std::string> names = scalar_names;
    for (const std::string &name : vector_names)
      names.insert(names.end(), 3, name);
    return names;
  }

  std::vector<
    std::tuple<unsigned int,
               unsigned int,
               std::string,
               dealii::DataComponentInterpretation::DataComponentInterpretation>>
  ParticleOutput::get_nonscalar_data_ranges() const
  {
    std::vector<
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 dealii::DataComponentInterpretation::DataComponentInterpretation>>
      ranges;
    for (unsigned int i = 0; i < vector_names.size(); ++i)
      ranges.emplace_back(
        scalar_names.size() + 3 * i,
        scalar_names.size() + 3 * i + 2,
        vector_names[i],
        dealii::DataComponentInterpretation::component_is_part_of_vector);
    return ranges;
  }
} // namespace graupel
