#include <graupel/simulation/packed_bed.h>

#include <iomanip>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Share of the weight that bottom and wall still carry when the bed counts
    // as lifted: at its onset the paper has 0.016 and 0.028 N of 0.5 N.
    constexpr double lifted_load = 0.05;
    // A void fraction that no random bed of spheres falls below [-].
    constexpr double densest_bed = 0.3;
    // Part of a case, at its end, over which its numbers are means.
    constexpr double averaged_part = 0.25;

    // A bed whose height changes by more [-] while it is held against the steady flow
    // has another flow: it is looked for again, so often.
    constexpr double       unmoved    = 1e-4;
    constexpr unsigned int most_looks = 5;
    // Beyond this change of height [-] the bed does not rest against the steady flow; nor
    // does it if the fluid carries more than this part of the weight.
    constexpr double moved        = 2e-3;
    constexpr double most_carried = 0.93;
    // Between two looks at a bed that is held [s].
    constexpr double hold_piece = 5e-3;

    // A step of the fluid that fails is tried with its half, so often.
    constexpr unsigned int maximum_halvings = 6;

    std::string
    describe_case(const CaseResult &result)
    {
      std::ostringstream text;
      text << std::setprecision(4) << "V_s " << result.superficial_velocity
           << " m/s: " << result.pressure_drop << " Pa, Ergun "
           << result.ergun_pressure_drop << " Pa (" << std::showpos
           << result.deviation_from_ergun * 100. << " %, middle half "
           << result.gradient_deviation_from_ergun * 100. << " %)" << std::noshowpos
           << ", bottom force " << result.bottom_force << " N"
           << (result.fluidized ? ", the bed has lifted" : "")
           << (result.steady ? "" : ", not steady");
      return text.str();
    }
  } // namespace

  void
  PackedBed::flow()
  {
    const auto &velocities = parameters.sweep.superficial_velocities;
    for (std::size_t n = summary.cases.size(); n < velocities.size(); ++n)
      {
        summary.cases.push_back(run_case(velocities[n]));
        progress.say(describe_case(summary.cases.back()));
        files.write_cases(summary.cases);
        save();
      }
  }

  CaseResult
  PackedBed::run_case(const double superficial_velocity)
  {
    const unsigned int number = summary.cases.size() + 1;
    const double       wall = Progress::steady_seconds(), cpu = cpu_seconds();
    std::ostringstream name;
    name << "flow " << number << "/" << parameters.sweep.superficial_velocities.size()
         << ", V_s " << superficial_velocity << " m/s";

    // A resumed case has begun to move already.
    bool is_still = parameters.sweep.mode == "steady" ||
                    (parameters.sweep.mode == "automatic" && !in_case);
    if (!in_case)
      begin_case(superficial_velocity);
    if (is_still)
      {
        progress.start_phase(name.str(), 0., parameters.sweep.maximum_solves, "solves");
        is_still = run_steady(number);
        progress.finish_phase();
      }
    if (!is_still)
      {
        const double duration = parameters.sweep.case_duration(
          superficial_velocity, parameters.cylinder.height);
        progress.start_phase(name.str(), 0., duration);
        run_transient(number, duration);
        progress.finish_phase();
      }
    in_case = false;

    CaseResult result;
    result.superficial_velocity = superficial_velocity;
    result.steady               = is_still || steady.is_steady();
    result.simulated_time       = time - case_begin;
    evaluate(result, number);
    result.wall_seconds = Progress::steady_seconds() - wall;
    result.cpu_seconds  = dealii::Utilities::MPI::sum(cpu_seconds() - cpu, communicator);
    return result;
  }

  void
  PackedBed::begin_case(const double superficial_velocity)
  {
    in_case    = true;
    ramp_from  = summary.cases.empty() ? 0. : summary.cases.back().superficial_velocity;
    case_begin = time;
    case_velocity = superficial_velocity;
    steady        = SteadyMonitor(
      parameters.sweep.steady_window, parameters.sweep.steady_tolerance, dem.weight());
    case_rows.clear();
  }

  void
  PackedBed::set_velocity_on_ramp(const double time_in_case)
  {
    const double ramp = parameters.sweep.ramp_time;
    const double part = ramp > 0. ? std::min(1., time_in_case / ramp) : 1.;
    coupled->set_superficial_velocity(ramp_from + part * (case_velocity - ramp_from));
  }

  void
  PackedBed::run_transient(const unsigned int number, const double duration)
  {
    step_limit = parameters.sweep.time_step;
    while (time - case_begin < duration * (1. - 1e-12))
      {
        const double aim = next_step(duration - (time - case_begin));
        set_velocity_on_ramp(time - case_begin + aim);
        const double step = step_fluid(aim);
        adapt_if_due();
        move_particles(step);
        record_monitor(number);
        write_fields_if_due();
        progress.update(time - case_begin);
        if (parameters.sweep.stop_when == "steady" && steady.is_steady())
          break;
        save_if_due();
      }
  }

  bool
  PackedBed::run_steady(const unsigned int number)
  {
    const bool   must_rest    = parameters.sweep.mode == "automatic";
    unsigned int n            = 0;
    double       force_before = coupled->exchange().total_force()[2];
    coupled->set_superficial_velocity(case_velocity);
    for (unsigned int look = 0; look < most_looks; ++look)
      {
        try
          {
            last_report =
              coupled->find_steady_state([&](const double) { progress.update(++n); });
          }
        catch (const SolverFailure &error)
          {
            if (!must_rest)
              fail_with_checkpoint(error);
            break;
          }
        const double force = coupled->exchange().total_force()[2];
        if (must_rest && force > most_carried * dem.weight())
          break;
        const double shift = std::abs(hold_particles(force_before));
        force_before       = force;
        if (must_rest && (shift > moved || !parameters.settling.is_met_by(dem)))
          {
            ramp_from = case_velocity;
            break;
          }
        if (must_rest && shift > unmoved)
          continue;
        std::ostringstream text;
        text << "steady flow after " << n << " linear systems";
        progress.say(text.str());
        record_monitor(number);
        return true;
      }
    progress.say("the bed does not rest against this flow: fluid and particles move");
    case_begin = time;
    return false;
  }

  double
  PackedBed::hold_particles(const double force_before)
  {
    const double height = observables.bed().height;
    const auto   change = [&]() { return observables.bed().height / height - 1.; };
    const double force  = coupled->exchange().total_force()[2];
    const double before = std::clamp(force > 0. ? force_before / force : 0., 0., 1.);
    const double ramp   = parameters.sweep.ramp_time;
    const double end    = ramp + parameters.sweep.steady_window;
    const auto   n      = static_cast<unsigned int>(std::ceil(end / hold_piece));
    double       last   = 1.; // factor on the forces now
    for (unsigned int piece = 1; piece <= n; ++piece)
      {
        const double part   = ramp > 0. ? std::min(1., piece * end / n / ramp) : 1.;
        const double factor = part + (1. - part) * before;
        for (dealii::Tensor<1, 3> &f : dem.particles().external_force)
          f *= factor / last;
        last = factor;
        move_particles(end / n);
        if (parameters.sweep.mode == "automatic" && change() > moved)
          break;
      }
    return change();
  }

  double
  PackedBed::next_step(const double remaining) const
  {
    double       step = std::min(parameters.sweep.time_step, step_limit);
    const double rate = coupled->fluid().courant_rate();
    if (parameters.sweep.courant_number > 0. && rate > 0.)
      step = std::min(step, parameters.sweep.courant_number / rate);
    // Steps of one length to the end, so that the last is not a tiny one.
    return remaining / std::ceil(remaining / step * (1. - 1e-12));
  }

  double
  PackedBed::step_fluid(double step)
  {
    for (unsigned int halvings = 0;; ++halvings)
      try
        {
          last_report = coupled->step(step);
          step_limit  = 2. * step;
          return step;
        }
      catch (const SolverFailure &error)
        {
          if (halvings == maximum_halvings)
            fail_with_checkpoint(error);
          step *= 0.5;
          std::ostringstream text;
          text << "at " << time << " s: " << error.what() << " Trying a step of " << step
               << " s.";
          progress.say(text.str());
        }
  }

  void
  PackedBed::move_particles(const double step)
  {
    dem.advance(step);
    time += step;
    summary.ledger.record(last_report.mass_imbalance,
                          coupled->exchange().momentum_imbalance(),
                          coupled->exchange().solid_volume_error());
  }

  void
  PackedBed::record_monitor(const unsigned int number)
  {
    MonitorRow row           = monitor("flow");
    row.flow_case            = number;
    row.superficial_velocity = parameters.sweep.superficial_velocities[number - 1];
    files.add_monitor(row);
    case_rows.push_back(row);
    steady.record(row);
  }

  MonitorRow
  PackedBed::monitor(const std::string &phase) const
  {
    MonitorRow row;
    row.time          = time;
    row.phase         = phase;
    row.pressure_drop = coupled->pressure_drop();
    row.bed_height    = observables.bed().height;
    row.bottom_force  = dem.bottom_force();
    row.wall_force    = dem.wall_force();
    row.fluid_force =
      coupled->exchange().total_force()[2] +
      parameters.fluid.density * parameters.dem.particles.gravity * dem.solid_volume();
    row.kinetic_energy       = dem.mean_kinetic_energy();
    row.maximum_speed        = dem.maximum_speed();
    row.mass_imbalance       = last_report.mass_imbalance;
    row.momentum_imbalance   = coupled->exchange().momentum_imbalance();
    row.solid_volume_error   = coupled->exchange().solid_volume_error();
    row.linear_iterations    = last_report.iterations;
    row.cells                = mesh.triangulation().n_global_active_cells();
    row.worst_node_imbalance = last_report.worst_node_imbalance;
    row.worst_cell_imbalance = last_report.worst_cell_imbalance;
    return row;
  }

  void
  PackedBed::write_fields_if_due()
  {
    if (parameters.output.interval <= 0. || time < next_output)
      return;
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    files.add_fields(
      time, coupled->nodes(), coupled->exchange().medium(), coupled->fluid());
    files.add_particles(time, dem);
    next_output = time + parameters.output.interval;
  }

  void
  PackedBed::evaluate(CaseResult &result, const unsigned int number)
  {
    const CostSheet::Scope timing(summary.costs, CostSheet::output);
    const MonitorRow       mean =
      mean_since(case_rows, time - averaged_part * result.simulated_time);
    const auto   bed      = observables.bed();
    const double diameter = summary.bed.original_diameter;
    const double velocity = result.superficial_velocity;

    result.bed_height         = bed.height;
    result.bed_rise           = bed.height - summary.bed.height;
    result.mean_void_fraction = bed.mean_void_fraction;
    result.pressure_drop      = mean.pressure_drop;
    result.bottom_force       = mean.bottom_force;
    result.wall_force         = mean.wall_force;
    result.fluid_force        = mean.fluid_force;
    result.weight             = dem.weight();
    result.fluidized = mean.bottom_force + mean.wall_force <= lifted_load * dem.weight();
    // A bed that has come apart has no height: Ergun's value is then the resting one's.
    const bool is_whole        = bed.mean_void_fraction > densest_bed;
    result.ergun_pressure_drop = ergun_pressure_drop(
      parameters.fluid,
      diameter,
      is_whole ? bed.mean_void_fraction : summary.bed.mean_void_fraction,
      velocity,
      is_whole ? bed.height : summary.bed.height);
    result.deviation_from_ergun = result.pressure_drop / result.ergun_pressure_drop - 1.;

    const FlowFields fields{coupled->nodes(),
                            coupled->exchange().medium().void_fraction,
                            coupled->fluid().flux()[2],
                            coupled->fluid().pressure()};
    const auto       n_slabs = static_cast<unsigned int>(
      std::max(10l, std::lround(parameters.cylinder.height / parameters.mesh.cell_size)));
    const auto   axial = axial_profile(fields, n_slabs);
    const double lower = bed.bottom + 0.25 * bed.height,
                 upper = bed.bottom + 0.75 * bed.height;
    const double middle_void_fraction =
      1. - observables.solid_fractions({lower, upper})[0];
    const double gradient =
      (pressure_at(axial, lower) - pressure_at(axial, upper)) / (upper - lower);
    result.gradient_deviation_from_ergun =
      gradient / ergun_pressure_gradient(
                   parameters.fluid, diameter, middle_void_fraction, velocity) -
      1.;

    const auto radial = radial_profile(fields, parameters.output.annuli, lower, upper);
    result.wall_channelling_deviation = wall_channelling_deviation(
      radial, parameters.fluid, diameter, velocity, middle_void_fraction);

    files.write_axial(number, axial, result);
    files.write_radial(number, radial, parameters.cylinder.diameter / 2.);
    files.write_mid_plane(number, mid_plane(fields, parameters.output.midplane_points));
    files.add_fields(
      time, coupled->nodes(), coupled->exchange().medium(), coupled->fluid());
    files.add_particles(time, dem);
    if (parameters.output.force_chains)
      files.add_contacts(time, dem);
  }
} // namespace graupel
