#ifndef graupel_simulation_particle_output_h
#define graupel_simulation_particle_output_h

#include <graupel/dem/dem.h>

#include <deal.II/base/data_out_base.h>

namespace graupel
{
  /**
   * The own particles of this rank as points for ParaView: id, type, diameter [m],
   * number of contacts with particles and with walls [-], mean normal stress [Pa],
   * velocity [m/s], spin [rad/s], contact force [N], fluid force [N].
   */
  class ParticleOutput : public dealii::DataOutInterface<0, 3>
  {
  public:
    explicit ParticleOutput(const Dem &dem);

  private:
    const std::vector<dealii::DataOutBase::Patch<0, 3>> &get_patches() const override;
    std::vector<std::string> get_dataset_names() const override;
    std::vector<
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

    std::vector<dealii::DataOutBase::Patch<0, 3>> patches;
  };
} // namespace graupel

#endif
