// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/parameters/sweep_parameters.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // Steps of "auto" in the steady window at least [-].
    constexpr double steps_in_window = 20.;
  } // namespace

  std::optional<double>
  SweepParameters::fixed_step() const
  {
    return number_or_word("Flow/time step", time_step, {"auto"});
  }

  double
  SweepParameters::longest_step() const
  {
    return fixed_step().value_or(steady_window / steps_in_window);
  }

  std::vector<std::optional<double>>
  SweepParameters::cases() const
  {
    if (mode == "particles alone")
      return {std::nullopt};
    return {superficial_velocities.begin(), superficial_velocities.end()};
  }

  bool
  SweepParameters::has_fluid() const
  {
    return mode != "particles alone" && !superficial_velocities.empty();
  }

  double
  SweepParameters::case_duration(const double superficial_velocity,
                                 const double height) const
  {
    return duration > 0.           ? duration
           : stop_when == "steady" ? maximum_time
                                   : flow_throughs * height / superficial_velocity;
  }

  void
  SweepParameters::check_ramp(const double height) const
  {
    if (mode == "steady")
      return;
    for (const double velocity : superficial_velocities)
      {
        std::ostringstream reason;
        reason << "the case of " << velocity << " m/s ends after "
               << case_duration(velocity, height)
               << " s, while its velocity still ramps up; choose a shorter ramp (0 is a "
                  "jump), or longer cases by Flow/flow-throughs or Flow/maximum time";
        require(
          case_duration(velocity, height) > ramp_time, "Flow/ramp time", reason.str());
      }
  }

  void
  SweepParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Flow");
    prm.add_parameter(
      "superficial velocities",
      superficial_velocities,
      "The flow cases, one superficial velocity each, run one after the other "
      "on the same bed: V of the boundary conditions. Where these set the flow by "
      "themselves, by a pressure say, it is a name only, and what really flows is "
      "reported. An empty list ends the run after settling [m/s].");
    prm.add_parameter(
      "mode",
      mode,
      "transient: fluid and particles move through time; steady: each case is the steady "
      "flow through the resting bed, found in some ten linear systems, after which the "
      "particles are held against it for one steady window; automatic: steady while the "
      "bed rests against the flow, and transient from where it does not; particles "
      "alone: "
      "no fluid at all, the particles move for Flow/duration.",
      dealii::Patterns::Selection("transient|steady|automatic|particles alone"));
    prm.add_parameter("maximum solves",
                      maximum_solves,
                      "Linear systems after which a steady flow has not been found [-].");
    prm.add_parameter(
      "time step",
      time_step,
      "Step of the fluid; particles take their own smaller substeps within it. auto: the "
      "longest that resolves how the particles of a moving bed respond to the drag, and "
      "the Courant number, at most a twentieth of the steady window. A number is kept "
      "to, "
      "and told where it is longer than these two [s].");
    prm.add_parameter(
      "ramp time",
      ramp_time,
      "Time in which the superficial velocity, or in steady flow its force on the "
      "particles, goes from that of one case to the next at the beginning of a case. A "
      "bed that is unloaded at once swings, and loosens; 0 for a jump [s].");
    prm.add_parameter(
      "Courant number",
      courant_number,
      "Largest speed of the fluid times step over cell size that steps of "
      "auto keep to: up to 2, mean, rms and height of a bubbling bed are "
      "those of 0.5 within their statistical error; 0: whatever it is [-].");
    prm.add_parameter(
      "stop when",
      stop_when,
      "When a case ends: after a number of flow-throughs (the rule of Ricklick & "
      "Baran), or when pressure drop, bottom force and bed height are steady.",
      dealii::Patterns::Selection("flow-throughs|steady"));
    prm.add_parameter(
      "flow-throughs",
      flow_throughs,
      "How often the superficial velocity must cross the height of the vessel: "
      "the case lasts n H / V_s [-].");
    prm.add_parameter("duration",
                      duration,
                      "Simulated time of a case, in place of a number of flow-throughs; "
                      "0 for these [s].");
    prm.add_parameter(
      "steady tolerance",
      steady_tolerance,
      "Relative change within the steady window below which a monitor counts as "
      "steady [-].");
    prm.add_parameter("steady window",
                      steady_window,
                      "Simulated time over which the monitors are watched [s].");
    prm.add_parameter("maximum time",
                      maximum_time,
                      "Longest duration of a case that ends when steady [s].");
    prm.leave_subsection();
  }

  void
  SweepParameters::check() const
  {
    for (const double velocity : superficial_velocities)
      require(velocity >= 0. && std::isfinite(velocity),
              "Flow/superficial velocities",
              "a superficial velocity is not negative; where the fluid enters is told by "
              "the boundary conditions");
    require(duration >= 0. && std::isfinite(duration),
            "Flow/duration",
            "must not be negative; 0 is for a number of flow-throughs");
    require(mode != "particles alone" || duration > 0.,
            "Flow/duration",
            "particles alone move for this time: choose a positive one, in seconds");
    for (const double velocity : superficial_velocities)
      require(velocity > 0. || duration > 0. || stop_when == "steady" ||
                mode == "steady" || mode == "particles alone",
              "Flow/duration",
              "a case of no superficial velocity has no flow-through to end with: give "
              "its duration, in seconds");
    const double step = fixed_step().value_or(1.);
    require(step > 0. && std::isfinite(step),
            "Flow/time step",
            "the fluid needs a positive step, in seconds; auto finds one");
    require(
      flow_throughs > 0., "Flow/flow-throughs", "must be positive; the paper takes 2");
    require(
      steady_tolerance > 0., "Flow/steady tolerance", "must be positive; 1e-3 is usual");
    require(steady_window >= 2. * longest_step(),
            "Flow/steady window",
            "must hold at least two of Flow/time step");
    require(maximum_time > 0., "Flow/maximum time", "must be positive");
    require(ramp_time >= 0., "Flow/ramp time", "must not be negative; 0 is a jump");
    require(courant_number >= 0.,
            "Flow/Courant number",
            "must not be negative; 0 switches it off, 1 to 5 is usual");
    require(maximum_solves >= 2, "Flow/maximum solves", "must be at least 2");
  }

  void
  OutputParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter("directory",
                      directory,
                      "Directory of the results; it is made if it does not exist.",
                      dealii::Patterns::Anything());
    prm.add_parameter(
      "interval",
      interval,
      "Simulated time between two sets of ParaView files, beside those at the "
      "end of every phase and flow case; 0 for no more than these [s].");
    prm.add_parameter(
      "field format",
      field_format,
      "Files of the fields of the fluid and of their means: vtu has each cell with corners "
      "of its own; hdf5, for large runs, has each node once, in HDF5 files that "
      "solution.xdmf and averages.xdmf describe, without subdomain and refinement "
      "level.",
      dealii::Patterns::Selection("vtu|hdf5"));
    prm.add_parameter("mid-plane points",
                      midplane_points,
                      "Points across the vessel at which the mid-plane is sampled [-].");
    prm.add_parameter(
      "annuli", annuli, "Annuli of equal width in the radial profiles [-].");
    prm.add_parameter(
      "force chains",
      force_chains,
      "Whether the contacts are written for ParaView, after settling and at "
      "the end of each flow case.");
    prm.add_parameter(
      "checkpoint interval",
      checkpoint_interval,
      "Wall-clock time between two checkpoints while the fluid flows, from which "
      "--resume "
      "goes on, beside those at the ends of settling and of each flow case and before a "
      "step that fails; 0 for no more than these [min].");
    prm.add_parameter("probes",
                      probes,
                      "Points at which the fluid is watched in probes.csv: NAME: x y z, "
                      "separated by bars "
                      "(|), as in \"low: 0 0 0.01 | high: 0 0 0.15\" [m].",
                      dealii::Patterns::Anything());
    prm.add_parameter(
      "report", report, "Whether report.html is made at the end of the run.");
    prm.add_parameter(
      "reference",
      reference,
      "Published values of the same bed that the report shows beside those of the run: "
      "ricklick-baran-2014 has Table 1 of their paper for beds of 1.6 mm spheres at "
      "scale "
      "1 or 2 in a vessel of 25 mm.",
      dealii::Patterns::Selection("none|ricklick-baran-2014"));
    prm.leave_subsection();
  }

  void
  OutputParameters::check() const
  {
    require(!directory.empty(), "Output/directory", "name a directory");
    require(interval >= 0., "Output/interval", "must not be negative; 0 switches it off");
    require(checkpoint_interval >= 0.,
            "Output/checkpoint interval",
            "must not be negative; 0 switches it off");
    require(midplane_points >= 3, "Output/mid-plane points", "needs at least 3 points");
    require(annuli >= 2, "Output/annuli", "needs at least 2 annuli");
  }
} // namespace graupel
