// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_parameters_run_parameters_h
#define graupel_simulation_parameters_run_parameters_h

#include <graupel/coupling/exchange.h>
#include <graupel/dem/packing/feed.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>
#include <graupel/fluid/manufactured_solution.h>
#include <graupel/mesh/adaption.h>
#include <graupel/simulation/parameters/averages_parameters.h>
#include <graupel/simulation/parameters/original_bed_parameters.h>
#include <graupel/simulation/parameters/study_parameters.h>
#include <graupel/simulation/parameters/sweep_parameters.h>

namespace graupel
{
  /** Everything that a parameter file says: read once, const ever after. */
  struct RunParameters
  {
    Cylinder               cylinder;
    MeshParameters         mesh;
    AdaptionParameters     adaption;
    DemParameters          dem;
    FillingParameters      filling;
    SettlingParameters     settling;
    FeedsParameters        feeds;
    FluidProperties        fluid;
    DragParameters         drag;
    CouplingParameters     coupling;
    ForceParameters        forces;
    OriginalBedParameters  original_bed;
    FlowParameters         flow;
    SweepParameters        sweep;
    AveragesParameters     averages;
    OutputParameters       output;
    StudyParameters        study;
    ManufacturedParameters manufactured;

    /** Every parameter by its path, as the file or its default has it. */
    std::map<std::string, std::string> texts;

    /** Declares every section of the parameter file. */
    void declare(dealii::ParameterHandler &prm);

    /** Throws InputError for values that cannot be, alone or together. */
    void check() const;

    /** Diameter of a simulated particle [m]. */
    double simulated_diameter() const;
    /** The scale of all types; none if they have several [-]. */
    std::optional<double> common_scale() const;
    /** Whether bubbles of a gas are to be followed: in transient mode, faster than a bed
     * of the guessed void fraction is lifted by Ergun's equation, in a vessel of eight
     * diameters at least. */
    bool has_bubbles() const;
    /** Filter length in use [m]. */
    double filter_length() const;

    /** The drag on each type, in a mixture of this original @p sauter mean diameter [m].
     */
    std::vector<DragOfType> drags(const double sauter) const;

    /**
     * What --check tells: the dimensionless groups, the sizes and the step
     * sizes that follow from the parameters.
     */
    std::string describe() const;

    /** Of a short bed of the original particles, to be measured. */
    RunParameters of_original_bed() const;

  private:
    void check_original_bed() const;
    void check_averages() const;
    void check_measured_bed() const;
    void check_wall_layer() const;
  };
} // namespace graupel

#endif
