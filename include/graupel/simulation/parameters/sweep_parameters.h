// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_sweep_parameters_h
#define graupel_simulation_parameters_sweep_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace graupel
{
  /** The flow phase: which superficial velocities, for how long. */
  struct SweepParameters
  {
    /** One flow case each, run one after the other on the same bed [m/s]. */
    std::vector<double> superficial_velocities{0.271, 0.320, 0.368, 0.423, 0.476, 0.534};
    /** "transient"; "steady": each case is the steady flow through the resting bed;
     * "automatic": steady as long as the bed rests; or "particles alone": no fluid. */
    std::string mode = "transient";
    /** Linear systems after which a steady flow has not been found [-]. */
    unsigned int maximum_solves = 100;
    /** Step of the fluid, and of the exchange with the particles: a length [s], or
     * "auto", which keeps to the particles' response and to the Courant number. */
    std::string time_step = "auto";
    /** Time in which the superficial velocity goes from one case's to the next [s]. */
    double ramp_time = 0.1;
    /** Courant number that no step of "auto" exceeds; 0: none [-]. */
    double courant_number = 2.;
    /** "flow-throughs" or "steady": when a case ends. */
    std::string stop_when = "flow-throughs";
    /** Times that the superficial velocity crosses the vessel's height [-]. */
    double flow_throughs = 2.;
    /** Of a case; 0: by flow-throughs [s]. */
    double duration = 0.;
    /** Relative change over the steady window below which a monitor is steady [-]. */
    double steady_tolerance = 1e-3;
    /** [s] */
    double steady_window = 0.1;
    /** Longest duration of a case that ends when steady [s]. */
    double maximum_time = 10.;

    /** The step that is kept to [s]; nothing with "auto". */
    std::optional<double> fixed_step() const;

    /** The step at most [s]: the fixed one, or what leaves twenty of them in the steady
     * window, so that what is watched in it has a course. */
    double longest_step() const;

    /** The velocity of each case [m/s]; one without any where the particles are alone. */
    std::vector<std::optional<double>> cases() const;

    /** Whether a fluid flows in the run. */
    bool has_fluid() const;

    /** Duration of a case at most [s]. */
    double case_duration(const double superficial_velocity, const double height) const;

    /**
     * Throws InputError if a flow case in a vessel of that height [m] ends while its
     * velocity still ramps up, so that its results are not those of its velocity.
     */
    void check_ramp(const double height) const;

    /** Declares the section "Flow". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };

  /** What is written, and where. */
  struct OutputParameters
  {
    /** Directory of the results; made if it does not exist. */
    std::string directory = "output";
    /** Time between two sets of ParaView files beside those at the ends of phases and
     * cases; 0: none [s]. */
    double interval = 0.;
    /** Of the fields: "vtu", or "hdf5" for HDF5 files that XDMF describes. */
    std::string field_format = "vtu";
    /** Points across the vessel of the mid-plane file [-]. */
    unsigned int midplane_points = 51;
    /** Annuli of the radial file [-]. */
    unsigned int annuli = 16;
    /** Whether contacts.pvd is written, after settling and at the end of each case. */
    bool force_chains = true;
    /** Wall-clock time between two checkpoints beside those at the ends of settling and
     * cases; 0: none [min]. */
    double checkpoint_interval = 10.;
    /** Points at which the fluid is watched: "NAME: x y z | ..." [m]. */
    std::string probes;
    /** Whether report.html is made at the end. */
    bool report = true;
    /** Published values that the report shows beside those of the run, by name. */
    std::string reference = "none";

    /** Declares the section "Output". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;
  };
} // namespace graupel

#endif
