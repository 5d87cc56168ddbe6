#include <graupel/dem/filling.h>
#include <graupel/dem/settling.h>

#include <benchmark/benchmark.h>

#include <deal.II/base/mpi.h>

using namespace graupel;

// Cost of a particle-step, all in, on a settled bed of simulated 3.2 mm spheres.
// Counter "ns_per_particle_step" is wall-clock time [ns].
static void
settled_bed(benchmark::State &state)
{
  DemParameters parameters;
  parameters.particles.scale = 2.;
  FillingParameters filling_parameters;
  filling_parameters.count      = state.range(0);
  filling_parameters.bed_height = 0.;

  CostSheet          costs;
  const CylinderMesh mesh({}, {}, MPI_COMM_WORLD);
  Dem                dem(parameters, mesh, costs);
  Filling            filling(filling_parameters, dem);
  while (filling.step())
    {
    }
  Settling settling({}, dem);
  while (settling.step())
    {
    }

  const auto steps_before = costs.particle_steps;
  for (auto _ : state)
    dem.advance(1e-3);
  state.counters["ns_per_particle_step"] =
    benchmark::Counter(1e-9 * (costs.particle_steps - steps_before),
                       benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(settled_bed)->Arg(500)->Arg(2600)->Unit(benchmark::kMillisecond)->UseRealTime();

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
