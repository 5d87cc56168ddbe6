// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/bed_correlations.h>
#include <graupel/simulation/observers/case_result.h>

namespace graupel
{
  namespace
  {
    // Share of the weight in the fluid that the walls still carry when the bed counts as
    // lifted: at its onset the paper has 0.016 and 0.028 N of 0.5 N. A bed that bubbles
    // comes down again and again, and rubs against walls: it may leave them more.
    constexpr double lifted_load = 0.05, bubbling_load = 0.2;
    // Particles move if their kinetic energy is that of a fall through more than this
    // part of a diameter.
    constexpr double moving_fall = 0.01;
    // Part of a case, at its end, over which its numbers are means.
    constexpr double averaged_part = 0.25;
    // A bed further above the floor than this part of its height does not stand on it.
    constexpr double most_gap = 0.5;
    // Slices of the bed over which Ergun's gradient is summed.
    constexpr unsigned int n_slices = 32;
  } // namespace

  CaseView::CaseView(const Moment &end, const CaseCourse &course)
    : end(end)
    , course(course)
  {
    const SimulationState &state = end.state;
    if (!state.fluid)
      return;
    const auto n_slabs = static_cast<unsigned int>(std::max(
      10l,
      std::lround(state.parameters.cylinder.height / state.parameters.mesh.cell_size)));
    axial              = axial_profile(fields_of(*state.fluid), n_slabs);
    if (end.bed().exists)
      look_at_middle();
  }

  FlowFields
  fields_of(const CoupledFlow &flow)
  {
    return {flow.nodes(),
            flow.exchange().medium().void_fraction,
            flow.fluid().flux()[2],
            flow.fluid().pressure()};
  }

  void
  CaseView::look_at_middle()
  {
    const SimulationState &state = end.state;
    const double           low = end.bed().bottom, high = end.bed().top;
    const FlowFields       fields = fields_of(*state.fluid);
    const double lower = low + 0.25 * (high - low), upper = low + 0.75 * (high - low);
    radial = radial_profile(fields, state.parameters.output.annuli, lower, upper);
    middle_void_fraction = 1. - state.observables.solid_volume_between(lower, upper) /
                                  state.dem.vessel_shape().volume(lower, upper);
    // The slabs must tell the two heights apart.
    if (axial.size() >= 2 && upper - lower > axial[1].height - axial[0].height)
      middle_gradient =
        (pressure_at(axial, lower) - pressure_at(axial, upper)) / (upper - lower);
  }

  SeriesStatistics
  CaseView::over_window(const std::string &monitor) const
  {
    return course.window.empty() ? SeriesStatistics()
                                 : course.window[place_of(monitor, monitors())];
  }

  Value
  CaseView::mean(const std::string &monitor) const
  {
    if (!course.window.empty())
      return over_window(monitor).mean;
    return mean_since(
      course.rows, course.begin + (1. - averaged_part) * course.simulated_time, monitor);
  }

  std::optional<CaseView::WholeBed>
  CaseView::whole_bed() const
  {
    const auto &bed = end.bed();
    if (bed.exists &&
        bed.bottom - end.state.dem.vessel_shape().floor() > most_gap * bed.height)
      return {};
    if (bed.exists)
      return WholeBed{bed.bottom, bed.height, bed.mean_void_fraction};
    const BedResult &rest = end.state.rest;
    if (rest.height && end.state.dem.n_global() == rest.particle_count)
      return WholeBed{*rest.bottom, *rest.height, *rest.mean_void_fraction};
    return {};
  }

  double
  CaseView::velocity_at(const double z) const
  {
    return end.upward_velocity(z).value_or(0.);
  }

  double
  CaseView::ergun_gradient(const double void_fraction, const double velocity) const
  {
    if (velocity == 0.)
      return 0.;
    return std::copysign(ergun_pressure_gradient(end.state.parameters.fluid,
                                                 end.state.rest.original_diameter,
                                                 void_fraction,
                                                 std::abs(velocity)),
                         velocity);
  }

  namespace
  {
    std::function<Value(const CaseView &)>
    mean_of(const std::string &monitor)
    {
      return [monitor](const CaseView &flow) { return flow.mean(monitor); };
    }

    std::function<Value(const CaseView &)>
    rms_of(const std::string &monitor)
    {
      return [monitor](const CaseView &flow) { return flow.over_window(monitor).rms; };
    }

    Value
    pressure_drop_error(const CaseView &flow)
    {
      return flow.over_window("pressure_drop").error;
    }

    Value
    pressure_frequency(const CaseView &flow)
    {
      return flow.over_window("pressure_drop").frequency;
    }

    Value
    averaged_time(const CaseView &flow)
    {
      return flow.course.averaged_time > 0. ? Value(flow.course.averaged_time) : Value();
    }

    std::function<Value(const CaseView &)>
    last_of(const std::string &monitor)
    {
      const std::size_t place = place_of(monitor, monitors());
      return [place](const CaseView &flow) { return monitors()[place].value(flow.end); };
    }

    // Mean over the window of the averages, as a bed that bubbles has no last state worth
    // telling; without one, at the end.
    std::function<Value(const CaseView &)>
    mean_or_last_of(const std::string &monitor)
    {
      const auto last = last_of(monitor);
      return [monitor, last](const CaseView &flow) {
        return flow.course.window.empty() ? last(flow) : flow.over_window(monitor).mean;
      };
    }

    // A number of the case's course.
    template <typename Number>
    std::function<Value(const CaseView &)>
    of_course(Number CaseCourse::*member)
    {
      return [member](const CaseView &flow) -> Value {
        return static_cast<double>(flow.course.*member);
      };
    }

    Value
    superficial_velocity(const CaseView &flow)
    {
      return flow.mean("superficial_velocity");
    }

    Value
    nominal_velocity(const CaseView &flow)
    {
      return flow.course.nominal_velocity;
    }

    // Over the bed, with what flows through each slice of it.
    Value
    ergun_drop(const CaseView &flow)
    {
      const auto bed = flow.whole_bed();
      if (!flow.end.state.fluid || !bed)
        return {};
      double sum = 0.;
      for (unsigned int n = 0; n < n_slices; ++n)
        sum += flow.ergun_gradient(
          bed->void_fraction,
          flow.velocity_at(bed->bottom + (n + 0.5) / n_slices * bed->height));
      return sum / n_slices * bed->height;
    }

    Value
    relative_deviation(const Value &value, const Value &expected)
    {
      if (!value || !expected || *expected == 0.)
        return {};
      return *value / *expected - 1.;
    }

    Value
    deviation_from_ergun(const CaseView &flow)
    {
      return relative_deviation(flow.mean("pressure_drop"), ergun_drop(flow));
    }

    double
    middle_velocity(const CaseView &flow)
    {
      return flow.velocity_at(0.5 * (flow.end.bed().bottom + flow.end.bed().top));
    }

    Value
    gradient_deviation_from_ergun(const CaseView &flow)
    {
      if (!flow.middle_gradient || !flow.whole_bed())
        return {};
      return relative_deviation(
        flow.middle_gradient,
        flow.ergun_gradient(*flow.middle_void_fraction, middle_velocity(flow)));
    }

    Value
    wall_channelling(const CaseView &flow)
    {
      if (flow.radial.empty() || !flow.whole_bed() || middle_velocity(flow) == 0.)
        return {};
      return wall_channelling_deviation(flow.radial,
                                        flow.end.state.parameters.fluid,
                                        flow.end.state.rest.original_diameter,
                                        std::abs(middle_velocity(flow)),
                                        *flow.middle_void_fraction);
    }

    Value
    bed_rise(const CaseView &flow)
    {
      static const auto height = mean_or_last_of("bed_height"),
                        bottom = mean_or_last_of("bed_bottom");
      const auto &rest         = flow.end.state.rest;
      const Value h = height(flow), b = bottom(flow);
      if (!h || !b || !rest.height)
        return {};
      return *b + *h - (*rest.bottom + *rest.height);
    }

    bool
    particles_move(const CaseView &flow)
    {
      const SimulationState &state  = flow.end.state;
      const Value            energy = flow.mean("kinetic_energy_per_particle");
      const double           fall   = moving_fall * state.parameters.simulated_diameter();
      return energy && *energy > state.dem.weight() / state.dem.n_global() * fall;
    }

    Value
    fluidized(const CaseView &flow)
    {
      const SimulationState &state   = flow.end.state;
      const Value            support = flow.mean("support_force");
      if (!state.fluid || !support || state.dem.n_global() == 0)
        return {};
      const double net_weight = state.dem.weight() - state.fluid->buoyancy();
      const double load       = particles_move(flow) ? bubbling_load : lifted_load;
      return *support <= load * net_weight ? 1. : 0.;
    }
  } // namespace

  const std::vector<Quantity<CaseView>> &
  case_quantities()
  {
    static const std::vector<Quantity<CaseView>> table{
      {"superficial_velocity",
       "m/s",
       "what really flowed: upward volumetric flow at the top of the bed, or at half of "
       "the vessel's height without a bed, over the empty cross-section there",
       superficial_velocity,
       "superficial velocity",
       "m/s"},
      {"nominal_velocity",
       "m/s",
       "V of the case, from `Flow/superficial velocities`",
       nominal_velocity},
      {"pressure_drop",
       "Pa",
       "pressure drop",
       mean_of("pressure_drop"),
       "pressure drop",
       "Pa"},
      {"pressure_drop_rms",
       "Pa",
       "rms of the pressure drop about its mean over the window of `Averages`; empty "
       "without one, as in the next three",
       rms_of("pressure_drop"),
       "rms",
       "Pa"},
      {"pressure_drop_error",
       "Pa",
       "statistical (standard) error of that mean, by blocks",
       pressure_drop_error},
      {"pressure_frequency",
       "Hz",
       "where the spectrum of the pressure drop is highest",
       pressure_frequency,
       "frequency",
       "Hz"},
      {"averaged_time", "s", "time of the window that the case had", averaged_time},
      {"ergun_pressure_drop", "Pa", "Ergun's value", ergun_drop, "Ergun", "Pa"},
      {"deviation_from_ergun",
       "-",
       "deviation from Ergun",
       deviation_from_ergun,
       "deviation",
       "%",
       100.},
      {"gradient_deviation_from_ergun",
       "-",
       "gradient deviation",
       gradient_deviation_from_ergun,
       "in the middle half",
       "%",
       100.},
      {"wall_channelling_deviation", "-", "wall-channelling deviation", wall_channelling},
      {"bed_height",
       "m",
       "bed height at the end; over a window of `Averages` its mean, as in the next two "
       "and the mean void fraction",
       mean_or_last_of("bed_height"),
       "bed height",
       "mm",
       1e3},
      {"bed_bottom",
       "m",
       "where the bed begins, over the vessel's bottom",
       mean_or_last_of("bed_bottom")},
      {"expanded_height",
       "m",
       "bed height that does not jump where bubbles and slugs pass, mean",
       mean_of("expanded_height")},
      {"expanded_height_rms",
       "m",
       "rms of the same about its mean over a window of `Averages`; empty without one",
       rms_of("expanded_height")},
      {"bed_rise", "m", "top of the bed less that before the flow", bed_rise},
      {"mean_void_fraction",
       "-",
       "mean void fraction",
       mean_or_last_of("mean_void_fraction")},
      {"bottom_force", "N", "bottom force", mean_of("bottom_force"), "bottom force", "N"},
      {"wall_force", "N", "wall force", mean_of("wall_force")},
      {"support_force",
       "N",
       "support: what all walls carry",
       mean_of("support_force"),
       "support",
       "N"},
      {"fluid_force", "N", "fluid force", mean_of("fluid_force")},
      {"weight", "N", "weight of the particles", mean_of("weight")},
      {"particles", "-", "particles in the vessel", last_of("particles"), "particles"},
      {"departed_particles",
       "-",
       "particles that have left through open ends since the run began",
       last_of("departed_particles")},
      {"fed_particles",
       "-",
       "particles that the feeds have brought in since the flow began",
       last_of("fed_particles")},
      {"fluidized",
       "flag",
       "the bed has lifted: in the mean the walls carry at most a twentieth of the "
       "weight "
       "in the fluid; or at most a fifth while the particles move, with the kinetic "
       "energy "
       "of a fall through more than a hundredth of a diameter",
       fluidized,
       "the bed has lifted",
       "flag"},
      {"steady",
       "flag",
       "the monitors had become steady when the case ended",
       of_course(&CaseCourse::is_steady),
       "steady",
       "flag"},
      {"simulated_time",
       "s",
       "simulated time of the case",
       of_course(&CaseCourse::simulated_time)},
      {"wall_seconds",
       "s",
       "wall-clock time of the case",
       of_course(&CaseCourse::wall_seconds)},
      {"cpu_seconds",
       "s",
       "processor time of the case, summed over the ranks",
       of_course(&CaseCourse::cpu_seconds)}};
    return table;
  }

  const Value &
  CaseResult::operator[](const std::string &quantity) const
  {
    return values[place_of(quantity, case_quantities())];
  }
} // namespace graupel
