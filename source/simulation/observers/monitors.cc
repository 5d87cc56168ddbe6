// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/monitors.h>

namespace graupel
{
  Moment::Moment(const SimulationState &state,
                 const Value           &nominal_velocity,
                 const Value           &fed)
    : state(state)
    , nominal_velocity(nominal_velocity)
    , fed(fed)
  {
  }

  const BedObservables::Bed &
  Moment::bed() const
  {
    if (!found)
      found = state.bed();
    return *found;
  }

  Value
  Moment::upward_velocity(const double z) const
  {
    if (!state.fluid)
      return {};
    return state.fluid->fluid().flow_below(z) / state.fluid->cross_section(z);
  }

  double
  Moment::flow_height() const
  {
    const double height = state.parameters.cylinder.height;
    // A hair below the top, so that what leaves there is no part of it.
    return bed().exists ? std::min(bed().top, height * (1. - 1e-9)) : 0.5 * height;
  }

  namespace
  {
    Value
    superficial_velocity(const Moment &now)
    {
      return now.upward_velocity(now.flow_height());
    }

    Value
    nominal_velocity(const Moment &now)
    {
      return now.nominal_velocity;
    }

    Value
    pressure_drop(const Moment &now)
    {
      if (!now.state.fluid)
        return {};
      return now.state.fluid->pressure_drop();
    }

    Value
    bed_height(const Moment &now)
    {
      return now.bed().exists ? Value(now.bed().height) : Value();
    }

    Value
    bed_bottom(const Moment &now)
    {
      return now.bed().exists ? Value(now.bed().bottom) : Value();
    }

    Value
    expanded_height(const Moment &now)
    {
      return now.bed().exists ? Value(now.bed().expanded_height) : Value();
    }

    Value
    center_of_mass(const Moment &now)
    {
      if (now.state.dem.n_global() == 0)
        return {};
      return now.state.observables.center_of_mass();
    }

    Value
    mean_void_fraction(const Moment &now)
    {
      return now.bed().exists ? Value(now.bed().mean_void_fraction) : Value();
    }

    Value
    bottom_force(const Moment &now)
    {
      return now.state.dem.bottom_force();
    }

    Value
    wall_force(const Moment &now)
    {
      return now.state.dem.wall_force();
    }

    Value
    support_force(const Moment &now)
    {
      return now.state.dem.supported_weight();
    }

    // Buoyancy included, against gravity.
    Value
    fluid_force(const Moment &now)
    {
      if (!now.state.fluid)
        return {};
      return now.state.fluid->flow_force_against_gravity() + now.state.fluid->buoyancy();
    }

    Value
    weight(const Moment &now)
    {
      return now.state.dem.weight();
    }

    Value
    kinetic_energy(const Moment &now)
    {
      if (now.state.dem.n_global() == 0)
        return {};
      return now.state.dem.mean_kinetic_energy();
    }

    Value
    maximum_speed(const Moment &now)
    {
      if (now.state.dem.n_global() == 0)
        return {};
      return now.state.dem.maximum_speed();
    }

    Value
    particles(const Moment &now)
    {
      return now.state.dem.n_global();
    }

    Value
    departed_particles(const Moment &now)
    {
      return now.state.dem.n_departed();
    }

    Value
    fed_particles(const Moment &now)
    {
      return now.fed;
    }

    // A number of the fluid's last step.
    template <typename Number>
    std::function<Value(const Moment &)>
    of_step(Number FlowSolver::Report::*member)
    {
      return [member](const Moment &now) -> Value {
        if (!now.state.fluid)
          return {};
        return static_cast<double>(now.state.last_step.*member);
      };
    }

    Value
    momentum_imbalance(const Moment &now)
    {
      if (!now.state.fluid)
        return {};
      return now.state.fluid->exchange().momentum_imbalance();
    }

    Value
    solid_volume_error(const Moment &now)
    {
      if (!now.state.fluid)
        return {};
      return now.state.fluid->exchange().solid_volume_error();
    }

    Value
    cells(const Moment &now)
    {
      return now.state.mesh.triangulation().n_global_active_cells();
    }
  } // namespace

  const std::vector<Quantity<Moment>> &
  monitors()
  {
    using Report = FlowSolver::Report;
    static const std::vector<Quantity<Moment>> table{
      {"superficial_velocity",
       "m/s",
       "upward volumetric flow at the top of the bed, or at half of the vessel's height "
       "without a bed, over the empty cross-section there",
       superficial_velocity},
      {"nominal_velocity", "m/s", "V of the flow case, on its ramp", nominal_velocity},
      {"pressure_drop", "Pa", "pressure drop", pressure_drop},
      {"bed_height", "m", "bed height", bed_height},
      {"bed_bottom", "m", "where the bed begins, over the vessel's bottom", bed_bottom},
      {"expanded_height",
       "m",
       "bed height that does not jump where bubbles and slugs pass",
       expanded_height},
      {"center_of_mass",
       "m",
       "height of the center of mass of the particles",
       center_of_mass},
      {"mean_void_fraction", "-", "mean void fraction", mean_void_fraction},
      {"bottom_force", "N", "bottom force", bottom_force},
      {"wall_force", "N", "wall force", wall_force},
      {"support_force", "N", "support: what all walls carry", support_force},
      {"fluid_force", "N", "fluid force", fluid_force},
      {"weight", "N", "weight of the particles", weight},
      {"kinetic_energy_per_particle",
       "J",
       "mean kinetic energy of a particle, spin included",
       kinetic_energy},
      {"maximum_speed", "m/s", "speed of the fastest particle", maximum_speed},
      {"particles", "-", "particles in the vessel", particles},
      {"departed_particles",
       "-",
       "particles that have left through open ends since the run began",
       departed_particles},
      {"fed_particles",
       "-",
       "particles that the feeds have brought in since the flow began",
       fed_particles},
      {"mass_imbalance",
       "-",
       "ledger of this step: fluid mass in, out and stored",
       of_step(&Report::mass_imbalance)},
      {"momentum_imbalance",
       "-",
       "ledger of this step: momentum exchanged",
       momentum_imbalance},
      {"solid_volume_error",
       "-",
       "ledger of this step: solid volume",
       solid_volume_error},
      {"linear_iterations",
       "-",
       "iterations of the linear solver in this step",
       of_step(&Report::iterations)},
      {"cells", "-", "cells of the mesh", cells},
      {"worst_node_imbalance",
       "-",
       "largest residual of the discrete continuity equation at a node, over the flow",
       of_step(&Report::worst_node_imbalance)},
      {"worst_cell_imbalance",
       "-",
       "largest surplus of volume of one cell (a discretisation error), over the flow",
       of_step(&Report::worst_cell_imbalance)}};
    return table;
  }

  const Value &
  MonitorRow::operator[](const std::string &monitor) const
  {
    return values[place_of(monitor, monitors())];
  }

  std::string
  monitors_header()
  {
    return "time,phase,case," + header(monitors());
  }

  std::string
  csv_row(const MonitorRow &row)
  {
    return cell_text(row.time, "s") + "," + row.phase + "," +
           std::to_string(row.flow_case) + "," + csv_row(monitors(), row.values);
  }

  Value
  mean_since(const std::vector<MonitorRow> &rows,
             const double                   from,
             const std::string             &name)
  {
    const std::size_t place = place_of(name, monitors());
    double            sum   = 0.;
    unsigned int      n     = 0;
    for (const MonitorRow &row : rows)
      if (row.time >= from && row.values[place])
        {
          sum += *row.values[place];
          ++n;
        }
    return n > 0 ? Value(sum / n) : Value();
  }
} // namespace graupel
