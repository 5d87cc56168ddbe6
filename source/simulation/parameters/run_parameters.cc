// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/progress.h>
#include <graupel/base/read_numbers.h>
#include <graupel/closures/bed_correlations.h>
#include <graupel/dem/bed/wall_layer.h>
#include <graupel/simulation/parameters/probe_points.h>
#include <graupel/simulation/parameters/run_parameters.h>
#include <graupel/simulation/parameters/run_size.h>
#include <graupel/simulation/parameters/step_limits.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Diameters across a vessel below which gas makes slugs, and a filter of two diameters
    // would be more than a quarter of it [-].
    constexpr double narrowest_of_bubbles = 8.;

    // Of a particle, far beyond any that drag laws are made for [-].
    constexpr double most_reynolds = 1e9;
  } // namespace

  void
  RunParameters::declare(dealii::ParameterHandler &prm)
  {
    cylinder.declare(prm);
    mesh.declare(prm);
    adaption.declare(prm);
    dem.declare(prm);
    filling.declare(prm);
    settling.declare(prm);
    feeds.declare(prm);
    fluid.declare(prm);
    drag.declare(prm);
    coupling.declare(prm);
    forces.declare(prm);
    original_bed.declare(prm);
    flow.declare(prm);
    sweep.declare(prm);
    averages.declare(prm);
    output.declare(prm);
    study.declare(prm);
    manufactured.declare(prm);
  }

  void
  RunParameters::check() const
  {
    cylinder.check();
    dem.check(cylinder);
    mesh.check(cylinder);
    adaption.check();
    filling.check(cylinder, dem);
    settling.check();
    feeds.check(cylinder, dem);
    fluid.check();
    coupling.check();
    for (const ParticleType &type : dem.types())
      forces.check(type.scale, coupling.model);
    check_original_bed();
    read_probes(output.probes);
    drag.check(dem.particles.scale, dem.mean_original_diameter());
    flow.check();
    sweep.check();
    check_averages();
    output.check();
    study.check();
    manufactured.check();
    require(!dem.walls.is_periodic() || sweep.superficial_velocities.empty(),
            "Walls/top",
            "the fluid enters at the bottom and leaves at the top, so the ends cannot be "
            "periodic while it flows; leave Flow/superficial velocities empty for "
            "particles alone");
    for (const double velocity : sweep.superficial_velocities)
      {
        const double reynolds =
          fluid.density * velocity * dem.mean_original_diameter() / fluid.viscosity;
        require(
          reynolds <= most_reynolds,
          "Flow/superficial velocities",
          "a particle has the Reynolds number " + text_of(reynolds, 3) +
            ", for which no drag law holds; are velocities in m/s and Fluid/viscosity "
            "in Pa s?");
      }
    require(
      filter_length() <= cylinder.diameter,
      "Coupling/filter length",
      "a filter longer than the vessel's diameter would smear the bed over all of it; "
      "one particle diameter is usual");
  }

  RunParameters
  RunParameters::of_original_bed() const
  {
    RunParameters original       = *this;
    original.dem.particles.scale = 1.;
    for (ParticleType &type : original.dem.particles.further_types)
      type.scale = 1.;
    original.filling.count      = 0;
    original.filling.mass       = 0.;
    original.filling.bed_height = original_bed.measured_height;
    original.filling.start_from.clear();
    original.filling.file.clear();
    if (filling.method != "rain")
      original.filling.method = "packing";
    original.settling.target_void_fraction = original_bed.target_void_fraction;
    return original;
  }

  void
  RunParameters::check_original_bed() const
  {
    original_bed.check();
    if (original_bed.void_fraction == "measured")
      check_measured_bed();
    if (original_bed.void_fraction == "correlation")
      check_wall_layer();
  }

  void
  RunParameters::check_measured_bed() const
  {
    const RunParameters original = of_original_bed();
    try
      {
        original.filling.check(cylinder, original.dem);
      }
    catch (const InputError &error)
      {
        std::ostringstream text;
        text << "a bed of original particles " << original_bed.measured_height
             << " m high cannot be filled into the vessel of Geometry/height = "
             << cylinder.height << " m (" << error.what() << ")";
        throw InputError("Original bed/measured height", text.str());
      }
  }

  void
  RunParameters::check_averages() const
  {
    averages.check();
    require(
      !averages.are_wanted() || adaption.interval <= 0.,
      "Averages/to",
      "means over time are taken at the nodes of one mesh, and Mesh adaption/interval "
      "changes it; set that to 0, or this, for no averages");
    if (!averages.are_wanted() || sweep.stop_when == "steady")
      return;
    for (const auto &velocity : sweep.cases())
      {
        const double duration =
          sweep.case_duration(velocity.value_or(0.), cylinder.height);
        std::ostringstream reason;
        reason << "a case ends after " << duration
               << " s, before the window of its averages begins; choose an earlier one, "
                  "or longer cases by Flow/duration";
        require(sweep.mode == "steady" || sweep.mode == "automatic" ||
                  duration > averages.from,
                "Averages/from",
                reason.str());
      }
  }

  void
  RunParameters::check_wall_layer() const
  {
    const auto refused_if = [](const bool is_so, const std::string &reason) {
      require(!is_so,
              "Original bed/void fraction",
              "the correlation follows the layer at the wall of a cylinder, but " +
                reason + "; choose measured, or the void fraction itself");
    };
    refused_if(dem.walls.from_mesh ||
                 !Vessel(cylinder, dem.walls.walls(cylinder)).is_tube(),
               "other walls cut this one");
    refused_if(cylinder.diameter < narrowest_tube * simulated_diameter(),
               "this one is less than three simulated particles across");
    refused_if(!common_scale(), "the types of particles have several scales");
  }

  std::optional<double>
  RunParameters::common_scale() const
  {
    for (const ParticleType &type : dem.types())
      if (type.scale != dem.particles.scale)
        return {};
    return dem.particles.scale;
  }

  double
  RunParameters::simulated_diameter() const
  {
    return dem.mean_simulated_diameter();
  }

  bool
  RunParameters::has_bubbles() const
  {
    const std::vector<double> &velocities = sweep.superficial_velocities;
    if (!sweep.has_fluid() || sweep.mode != "transient" || velocities.empty() ||
        cylinder.diameter < narrowest_of_bubbles * simulated_diameter() ||
        coupling.upstream(fluid.density / dem.particles.density) > 0.)
      return false;
    return *std::max_element(velocities.begin(), velocities.end()) >
           ergun_onset_velocity(fluid,
                                dem.mean_original_diameter(),
                                guessed_void_fraction,
                                dem.particles.density,
                                dem.particles.gravity);
  }

  double
  RunParameters::filter_length() const
  {
    return coupling.length(simulated_diameter(), has_bubbles());
  }

  std::vector<DragOfType>
  RunParameters::drags(const double sauter) const
  {
    std::vector<DragOfType> result;
    const bool              is_mixture = coupling.mixture == "sauter mean";
    for (const ParticleType &type : dem.types())
      {
        const double diameter = is_mixture ? sauter : type.diameter;
        result.push_back({Drag(drag, fluid, diameter, type.scale),
                          0.5 * type.scale * diameter,
                          is_mixture});
      }
    return result;
  }

  std::string
  RunParameters::describe() const
  {
    const double       diameter = dem.mean_original_diameter();
    std::ostringstream text;
    text << std::setprecision(4);
    const auto line = [&](const std::string &name,
                          const auto         value,
                          const std::string &unit) {
      text << "  " << std::left << std::setw(46) << name << value << " " << unit << '\n';
    };
    text << "Sizes\n";
    line("vessel diameter / simulated particle",
         cylinder.diameter / simulated_diameter(),
         "-");
    line("simulated particle diameter", simulated_diameter(), "m");
    line("filter length", filter_length(), "m");
    line("cell size aimed at", mesh.cell_size, "m");
    const RunSize size = expected_size(*this);
    text << "Expected, within a factor of two or three but for the cells\n";
    line("cells of the mesh", size.cells, "");
    line("particles", size.particles, "");
    line("substeps of the particles", size.substeps, "");
    line("steps of the fluid", size.fluid_steps, "");
    line("memory, beside " + text_of(memory_of_rank, 2) + " GB a rank",
         1e-9 * size.memory,
         "GB");
    line("room on the disk", 1e-9 * size.disk, "GB");
    line(size.cases_may_end ? "CPU time, at most" : "CPU time",
         spoken_duration(size.cpu_seconds),
         "");
    text << "Steps\n";
    line("characteristic (Rayleigh) time of a contact", dem.characteristic_time(), "s");
    line("substep of the particles", dem.substep(), "s");
    line(sweep.fixed_step() ? "step of the fluid" : "step of the fluid, auto, at most",
         sweep.longest_step(),
         "s");
    line("substeps in a step of the fluid",
         std::ceil(sweep.longest_step() / dem.substep()),
         "");

    const double bed_height = 0.9 * cylinder.height;
    const double load       = (1. - guessed_void_fraction) * dem.particles.density *
                        dem.particles.gravity * bed_height * simulated_diameter() *
                        simulated_diameter();
    line("overlap under a bed of 0.9 of the height",
         dem.overlap_under(load) / simulated_diameter() * 100.,
         "% of the diameter");
    text << "Flow through a bed of void fraction " << guessed_void_fraction << '\n';
    line("particle / fluid density", dem.particles.density / fluid.density, "-");
    line("onset of fluidisation by Ergun",
         ergun_onset_velocity(fluid,
                              diameter,
                              guessed_void_fraction,
                              dem.particles.density,
                              dem.particles.gravity),
         "m/s");
    for (const double velocity : sweep.superficial_velocities)
      {
        const double gradient =
          ergun_pressure_gradient(fluid, diameter, guessed_void_fraction, velocity);
        const double weight = (1. - guessed_void_fraction) *
                              (dem.particles.density - fluid.density) *
                              dem.particles.gravity;
        text << "  superficial velocity " << velocity
             << " m/s: Re = " << fluid.density * velocity * diameter / fluid.viscosity
             << ", Ergun's gradient " << gradient << " Pa/m = " << gradient / weight
             << " of the weight, at most "
             << sweep.case_duration(velocity, cylinder.height) << " s\n";
        const StepLimits limits = limits_at_rest(*this, guessed_void_fraction, velocity);
        text << "    step of the fluid by the particles' response " << limits.response
             << " s, by the Courant number " << sweep.courant_number << " "
             << limits.courant << " s\n";
      }
    for (const std::string &warning : warnings(*this))
      text << "warning: " << warning << '\n';
    for (const std::string &note : notes(*this))
      text << "note: " << note << '\n';
    return text.str();
  }
} // namespace graupel
