// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/simulation/parameters/run_size.h>
#include <graupel/simulation/parameters/step_limits.h>

#include <unistd.h>

namespace graupel
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    // Measured with prm/packed-bed/ricklick-2x.prm on cells of 3.2 to 0.8 mm [bytes].
    constexpr double memory_of_program = 1.5e8, memory_of_cell = 2.4e4,
                     memory_of_particle = 1.5e3;
    // A checkpoint, of which there are three for a while, and ParaView's files [bytes].
    constexpr double saved_cell = 1.5e3, saved_particle = 650., shown_cell = 90.,
                     shown_particle = 250.;
    // CPU time of a particle in a substep, and of a cell in a step [s].
    constexpr double time_of_particle = 60e-9, time_of_cell = 20e-6;
    // Steps that a steady flow costs as much as.
    constexpr double steps_of_steady_case = 40.;
    // Fall through the vessel's height in which a bed is packed [-].
    constexpr double falls_of_packing = 8.;

    // What no run does.
    constexpr double most_substeps_in_step = 1e7, most_substeps = 1e12,
                     most_fluid_steps = 1e9, most_outputs = 1e6;

    std::string
    gigabytes(const double bytes)
    {
      return text_of(1e-9 * bytes, 3) + " GB";
    }

    // 0 where nothing says it: without a velocity, for which flow-throughs never end.
    double
    duration_of_case(const RunParameters &parameters, const double velocity)
    {
      const double time =
        parameters.sweep.case_duration(velocity, parameters.cylinder.height);
      return std::isfinite(time) ? time : 0.;
    }

    double
    flow_time(const RunParameters &parameters)
    {
      double time = 0.;
      for (const auto &velocity : parameters.sweep.cases())
        time += duration_of_case(parameters, velocity.value_or(0.));
      return time;
    }

    double
    steps_of_fluid(const RunParameters &parameters)
    {
      const SweepParameters &sweep = parameters.sweep;
      double                 steps = 0.;
      if (!sweep.has_fluid())
        return steps;
      for (const double velocity : sweep.superficial_velocities)
        if (sweep.mode == "steady")
          steps += steps_of_steady_case;
        else
          {
            const StepLimits limits =
              limits_at_rest(parameters, guessed_void_fraction, velocity);
            const double step = sweep.fixed_step().value_or(
              std::min({sweep.longest_step(), limits.response, limits.courant}));
            steps += duration_of_case(parameters, velocity) / step;
          }
      return steps;
    }

    // Memory of this machine for one of its ranks, of those that run now [bytes].
    double
    room_for_rank(MPI_Comm communicator)
    {
      MPI_Comm node;
      MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
      const unsigned int n = mpi::n_mpi_processes(node);
      MPI_Comm_free(&node);
      const double all = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<double>(sysconf(_SC_PAGESIZE));
      return mpi::min(all / n, communicator);
    }
  } // namespace

  RunSize
  expected_size(const RunParameters &parameters)
  {
    RunSize size;
    size.cells = VesselMesh::n_expected_cells(parameters.cylinder, parameters.mesh);
    size.particles =
      parameters.filling.n_expected_particles(parameters.cylinder, parameters.dem);
    const double gravity = parameters.dem.particles.gravity;
    const double packing =
      size.particles > 0. && gravity > 0.
        ? falls_of_packing * std::sqrt(2. * parameters.cylinder.height / gravity)
        : 0.;
    const double time   = packing + flow_time(parameters);
    const double fields = parameters.sweep.has_fluid() ? size.cells : 0.;
    size.substeps       = size.particles > 0. ? time / parameters.dem.substep() : 0.;
    size.fluid_steps    = steps_of_fluid(parameters);
    size.outputs        = 2. + parameters.sweep.cases().size();
    if (parameters.output.interval > 0.)
      size.outputs += time / parameters.output.interval;
    size.memory = memory_of_cell * fields + memory_of_particle * size.particles;
    size.disk   = 3. * (saved_cell * fields + saved_particle * size.particles) +
                size.outputs * (shown_cell * fields + shown_particle * size.particles);
    size.cpu_seconds = time_of_particle * size.particles * size.substeps +
                       time_of_cell * fields * size.fluid_steps;
    size.cases_may_end =
      parameters.sweep.mode == "transient" && parameters.sweep.stop_when == "steady";
    return size;
  }

  void
  check_size(const RunParameters &parameters, MPI_Comm communicator)
  {
    const RunSize size   = expected_size(parameters);
    const auto    refuse = [](const std::string &parameter,
                           const double       number,
                           const double       most,
                           const std::string &of_what) {
      require(number <= most,
              parameter,
              "that makes " + text_of(number, 3) + " " + of_what +
                ", more than any run has (" + text_of(most, 3) + "); is the unit right?");
    };
    refuse("Contact/substep",
           parameters.sweep.longest_step() / parameters.dem.substep(),
           most_substeps_in_step,
           "substeps of the particles in a step of the fluid");
    refuse("Contact/substep", size.substeps, most_substeps, "substeps of the particles");
    refuse("Flow/time step", size.fluid_steps, most_fluid_steps, "steps of the fluid");
    refuse("Output/interval", size.outputs, most_outputs, "sets of ParaView files");

    const double room = room_for_rank(communicator),
                 needed =
                   memory_of_program + size.memory / mpi::n_mpi_processes(communicator);
    const bool fields_are_larger =
      memory_of_cell * size.cells > memory_of_particle * size.particles;
    require(needed <= room,
            fields_are_larger ? "Mesh/cell size" : "Particles/scale",
            text_of(size.cells, 3) + " cells and " + text_of(size.particles, 3) +
              " particles need about " + gigabytes(needed) +
              " of memory a rank, but this machine has " + gigabytes(room) +
              (fields_are_larger ? "; take larger cells, or more machines"
                                 : "; take a larger scale, or more machines"));
  }
} // namespace graupel
