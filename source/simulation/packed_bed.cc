#include <graupel/simulation/original_bed.h>
#include <graupel/simulation/packed_bed.h>
#include <graupel/simulation/packing.h>

#include <ctime>
#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    // With fluid: cost of a cell in one step of the fluid, in substeps of one
    // particle (50 microseconds over 30 nanoseconds).
    constexpr double particle_substeps_of_cell = 1700.;

    // Tells the height of the bed, its void fraction and how it is supported.
    std::string
    describe_bed(const BedResult &bed, const Dem &dem)
    {
      std::ostringstream text;
      text << std::setprecision(4) << "bed: " << bed.particle_count << " particles of "
           << bed.particle_diameter * 1e3 << " mm, height " << bed.height * 1e3
           << " mm, mean void fraction " << bed.mean_void_fraction << ", "
           << bed.mean_coordination_number << " contacts each; bottom "
           << dem.bottom_force() << " N + wall " << dem.wall_force()
           << " N = " << (dem.bottom_force() + dem.wall_force()) / dem.weight() * 100.
           << " % of the weight";
      return text.str();
    }
  } // namespace

  PackedBed::PackedBed(const RunParameters &parameters,
                       const std::string   &parameter_file,
                       ResultFiles         &files,
                       Progress            &progress,
                       MPI_Comm             communicator)
    : parameters(parameters)
    , files(files)
    , progress(progress)
    , communicator(communicator)
    , mesh(parameters.cylinder, parameters.mesh, communicator)
    , dem(parameters.dem, mesh, summary.costs)
    , observables(dem.particles(), dem.vessel_shape(), communicator)
    , next_output(parameters.output.interval)
    , step_limit(parameters.sweep.time_step)
    , steady(parameters.sweep.steady_window, parameters.sweep.steady_tolerance, 1.)
    , started(Progress::steady_seconds())
  {
    // What the mesh's own boundaries cannot have is said before the bed is made.
    if (!parameters.sweep.superficial_velocities.empty())
      parameters.flow.boundaries.by_id(mesh.boundaries());
    summary.parameter_file = parameter_file;
    summary.fluid          = parameters.fluid;
  }

  void
  PackedBed::run(const bool resume)
  {
    std::ostringstream mesh_line;
    mesh_line << "mesh: " << mesh.triangulation().n_global_active_cells() << " cells, on "
              << dealii::Utilities::MPI::n_mpi_processes(communicator) << " rank(s)";
    progress.say(mesh_line.str());
    if (resume)
      restore();
    else
      {
        if (parameters.filling.start_from.empty())
          time = fill_vessel(parameters.filling, dem, progress);
        else
          take_bed();
        time += settle_bed(parameters.settling, dem, progress);
        present_bed();
        save();
      }
    if (!parameters.sweep.superficial_velocities.empty())
      {
        if (!coupled)
          start_fluid();
        flow();
      }
    write_summary_file();
  }

  double
  PackedBed::cpu_seconds() const
  {
    return cpu_before + static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }

  void
  PackedBed::start_fluid()
  {
    const double substeps = parameters.sweep.time_step / dem.substep();
    cell_share            = particle_substeps_of_cell / std::max(1., substeps);
    dem.balance(cell_share);
    coupled.emplace(
      parameters, summary.bed.original_solid_ratio, mesh, dem, summary.costs);
    for (unsigned int pass = 0; pass < parameters.adaption.initial_passes; ++pass)
      {
        coupled->look_at_bed();
        adapt_mesh();
      }
    next_adaption = time + parameters.adaption.interval;
  }

  void
  PackedBed::adapt_mesh()
  {
    const unsigned int before = mesh.triangulation().n_global_active_cells();
    if (!coupled->adapt(cell_share))
      return;
    std::ostringstream text;
    text << "mesh: " << before << " cells adapted to "
         << mesh.triangulation().n_global_active_cells();
    progress.say(text.str());
  }

  void
  PackedBed::adapt_if_due()
  {
    if (parameters.adaption.interval <= 0. || time < next_adaption)
      return;
    adapt_mesh();
    next_adaption = time + parameters.adaption.interval;
  }

  void
  PackedBed::present_bed()
  {
    dem.synchronise();
    const auto bed = observables.bed();
    summary.bed    = {dem.n_global(),
                      parameters.simulated_diameter(),
                      dem.original_sauter_diameter(),
                      parameters.dem.particles.scale,
                      dem.solid_volume(),
                      bed.height,
                      bed.mean_void_fraction,
                      dem.coordination_number(),
                      parameters.cylinder.diameter,
                      parameters.cylinder.height};
    progress.say(describe_bed(summary.bed, dem));
    if (!parameters.sweep.superficial_velocities.empty())
      summary.bed.original_solid_ratio =
        original_solid_ratio(parameters, bed, progress, summary.costs, communicator);
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    const DemState         particles = dem.state();
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_bed(files.path("bed.bin"), identity_of_bed(parameters), particles);
    files.add_particles(time, dem);
    files.write_bed(bed_profiles(dem, bed, parameters.simulated_diameter()));
    if (parameters.output.force_chains)
      files.add_contacts(time, dem);
  }

  void
  PackedBed::write_summary_file()
  {
    summary.wall_seconds  = Progress::steady_seconds() - started;
    summary.cpu_seconds   = cpu_seconds();
    summary.cells         = mesh.triangulation().n_global_active_cells();
    summary.cross_section = mesh.mean_cross_section();
    write_summary(files.path("summary.json"), summary, communicator);
  }
} // namespace graupel
