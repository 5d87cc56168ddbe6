#include <graupel/simulation/particle_output.h>

namespace graupel
{
  namespace
  {
    const std::vector<std::string> vector_names{
      "velocity", "spin", "contact_force", "fluid_force"};
  } // namespace

  ParticleOutput::ParticleOutput(const ParticleArrays &particles)
    : patches(particles.n_owned)
  {
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        auto &patch                = patches[row];
        patch.vertices[0]          = particles.position[row];
        patch.patch_index          = row;
        patch.points_are_available = false;
        patch.data.reinit(2 + 3 * vector_names.size(), 1);
        patch.data(0, 0)  = particles.id[row];
        patch.data(1, 0)  = 2. * particles.radius[row];
        unsigned int next = 2;
        for (const auto *field : {&particles.velocity,
                                  &particles.spin,
                                  &particles.force,
                                  &particles.external_force})
          for (unsigned int i = 0; i < 3; ++i)
            patch.data(next++, 0) = (*field)[row][i];
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
    std::vector<std::string> names{"id", "diameter"};
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
        2 + 3 * i,
        4 + 3 * i,
        vector_names[i],
        dealii::DataComponentInterpretation::component_is_part_of_vector);
    return ranges;
  }
} // namespace graupel
