#include <graupel/simulation/packing.h>

namespace graupel
{
  namespace
  {
    // What a cell counts while there is no fluid, in particles.
    constexpr double share_of_empty_cell = 0.02;
    // Simulated time between two looks at how particles are spread over the ranks [s].
    constexpr double balance_interval = 0.1;

    // A phase of packing to its end; what it has done is told by @p done.
    template <typename Phase, typename Done>
    double
    run_phase(Phase &phase, Dem &dem, Progress &progress, const Done &done)
    {
      double next_balance = 0.;
      while (phase.step())
        {
          if (phase.time() >= next_balance)
            {
              dem.balance(share_of_empty_cell);
              next_balance = phase.time() + balance_interval;
            }
          progress.update(done());
        }
      progress.finish_phase();
      return phase.time();
    }
  } // namespace

  double
  fill_vessel(const FillingParameters &parameters,
              Dem                     &dem,
              Progress                &progress,
              const std::string       &bed)
  {
    Filling filling(parameters, dem);
    progress.start_phase(bed + "fill", 0., 1.);
    return run_phase(filling, dem, progress, [&]() { return filling.progress(); });
  }

  double
  settle_bed(const SettlingParameters &parameters,
             Dem                      &dem,
             Progress                 &progress,
             const std::string        &bed)
  {
    Settling settling(parameters, dem);
    progress.start_phase(bed + "settle", 0., parameters.maximum_time);
    return run_phase(settling, dem, progress, [&]() { return settling.time(); });
  }
} // namespace graupel
