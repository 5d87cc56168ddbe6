#ifndef graupel_simulation_contact_output_h
#define graupel_simulation_contact_output_h

#include <graupel/dem/contacts/contact_sweep.h>

#include <deal.II/base/data_out_base.h>

namespace graupel
{
  /**
   * Contacts as lines for ParaView, from center to center, or from a center to the
   * contact point on a wall: normal force [N], positive where the two press on
   * each other, tangential force [N], overlap [m], whether the partner is a wall,
   * and the force on the particle at the first end [N]. Each value is the same
   * at both ends. A tube filter whose radius follows the normal force shows the
   * force chains.
   */
  class ContactOutput : public dealii::DataOutInterface<1, 3>
  {
  public:
    /** @p contacts of this rank; every contact on one rank only. */
    explicit ContactOutput(const std::vector<ContactState> &contacts);

  private:
    const std::vector<dealii::DataOutBase::Patch<1, 3>> &get_patches() const override;
    std::vector<std::string> get_dataset_names() const override;
    std::vector<
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

    std::vector<dealii::DataOutBase::Patch<1, 3>> patches;
  };
} // namespace graupel

#endif
