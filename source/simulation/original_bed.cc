#include <graupel/closures/bed_correlations.h>
#include <graupel/dem/dem.h>
#include <graupel/simulation/original_bed.h>
#include <graupel/simulation/packing.h>

#include <iomanip>
#include <sstream>

namespace graupel
{
  double
  measure_original_bed(const RunParameters &parameters,
                       Progress            &progress,
                       CostSheet           &costs,
                       MPI_Comm             communicator)
  {
    DemParameters particles   = parameters.dem;
    particles.particles.scale = 1.;
    for (ParticleType &type : particles.particles.further_types)
      type.scale = 1.;
    FillingParameters filling     = parameters.filling;
    filling.count                 = 0;
    filling.mass                  = 0.;
    filling.bed_height            = parameters.original_bed.measured_height;
    SettlingParameters settling   = parameters.settling;
    settling.target_void_fraction = parameters.original_bed.target_void_fraction;

    VesselMesh        mesh(parameters.cylinder, parameters.mesh, communicator);
    Dem               dem(particles, mesh, costs);
    const std::string name = "original bed: ";
    fill_vessel(filling, dem, progress, name);
    settle_bed(settling, dem, progress, name);

    const auto bed =
      BedObservables(dem.particles(), dem.vessel_shape(), communicator).bed();
    std::ostringstream text;
    text << std::setprecision(4) << "original bed: " << dem.n_global()
         << " particles, height " << bed.height * 1e3 << " mm, mean void fraction "
         << bed.mean_void_fraction << ", in the middle half "
         << 1. - bed.bulk_solid_fraction;
    progress.say(text.str());
    return bed.bulk_solid_fraction;
  }

  double
  original_solid_ratio(const RunParameters       &parameters,
                       const BedObservables::Bed &bed,
                       Progress                  &progress,
                       CostSheet                 &costs,
                       MPI_Comm                   communicator)
  {
    const auto &choice = parameters.original_bed;
    if (choice.void_fraction == "simulated")
      return 1.;
    double ratio;
    if (const auto given = choice.number())
      ratio = (1. - *given) / (1. - bed.mean_void_fraction);
    else if (choice.void_fraction == "correlation")
      {
        const double original =
          parameters.cylinder.diameter / parameters.dem.particles.diameter;
        const double simulated =
          parameters.cylinder.diameter / parameters.simulated_diameter();
        ratio = (1. - benyahia_oneill_void_fraction(original)) /
                (1. - benyahia_oneill_void_fraction(simulated));
      }
    else
      ratio = measure_original_bed(parameters, progress, costs, communicator) /
              bed.bulk_solid_fraction;
    std::ostringstream text;
    text << std::setprecision(4) << "drag law at the original bed's solid fraction, "
         << ratio << " of the simulated one's";
    progress.say(text.str());
    return ratio;
  }
} // namespace graupel
