#include <graupel/simulation/files/contact_output.h>

#include <array>

namespace graupel
{
  namespace
  {
    const std::vector<std::string> scalar_names{
      "normal_force", "tangential_force", "overlap", "with_wall"};
    const unsigned int n_components = scalar_names.size() + 3;
  } // namespace

  ContactOutput::ContactOutput(const std::vector<ContactState> &contacts)
    : patches(contacts.size())
  {
    for (std::size_t c = 0; c < contacts.size(); ++c)
      {
        const ContactState &contact = contacts[c];
        // The normal points to the partner, which pushes against it.
        const double                normal     = -contact.force * contact.normal;
        const auto                  tangential = contact.force + normal * contact.normal;
        const std::array<double, 7> values{normal,
                                           tangential.norm(),
                                           contact.overlap,
                                           contact.second < 0 ? 1. : 0.,
                                           contact.force[0],
                                           contact.force[1],
                                           contact.force[2]};

        auto &patch                = patches[c];
        patch.vertices[0]          = contact.first_center;
        patch.vertices[1]          = contact.second_center;
        patch.patch_index          = c;
        patch.n_subdivisions       = 1;
        patch.reference_cell       = dealii::ReferenceCells::Line;
        patch.points_are_available = false;
        patch.data.reinit(n_components, 2);
        for (unsigned int i = 0; i < n_components; ++i)
          patch.data(i, 0) = patch.data(i, 1) = values[i];
      }
  }

  const std::vector<dealii::DataOutBase::Patch<1, 3>> &
  ContactOutput::get_patches() const
  {
    return patches;
  }

  std::vector<std::string>
  ContactOutput::get_dataset_names() const
  {
    std::vector<std::string> names = scalar_names;
    names.insert(names.end(), 3, "force");
    return names;
  }

  std::vector<
    std::tuple<unsigned int,
               unsigned int,
               std::string,
               dealii::DataComponentInterpretation::DataComponentInterpretation>>
  ContactOutput::get_nonscalar_data_ranges() const
  {
    return {{scalar_names.size(),
             scalar_names.size() + 2,
             "force",
             dealii::DataComponentInterpretation::component_is_part_of_vector}};
  }
} // namespace graupel
