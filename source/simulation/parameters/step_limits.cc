// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/read_numbers.h>
#include <graupel/simulation/parameters/step_limits.h>

#include <limits>
#include <sstream>

namespace graupel
{
  namespace
  {
    // A filter's standard deviation below which a particle pushes on its own
    // disturbance, in diameters, the same where bubbles move, and one beyond which it
    // blurs the vessel, in diameters of that [-].
    constexpr double least_filter = 0.99, least_of_bubbles = 1.99, largest_filter = 0.25;
    // Simulated particles across a vessel, below which walls are all that there is [-].
    constexpr double fewest_across = 5.;
    // Cells in simulated diameters, beyond which a bed's ends are smeared over them: 500
    // spheres of packed-bed/short.prm lose 7 % of their drop from cells of 1.9 to 3.1 of
    // them [-].
    constexpr double largest_cell = 3.;

    double
    response_at_rest(const RunParameters &parameters,
                     const double         void_fraction,
                     const double         velocity)
    {
      const auto types  = parameters.dem.types();
      const auto drags  = parameters.drags(parameters.dem.mean_original_diameter());
      double     result = std::numeric_limits<double>::infinity();
      for (std::size_t n = 0; n < types.size(); ++n)
        result = std::min(result,
                          stable_step_at_rest(drags[n],
                                              types[n].smallest_radius(),
                                              types[n].density,
                                              void_fraction,
                                              velocity));
      return result;
    }

    void
    warn_of_step(const RunParameters &parameters, std::vector<std::string> &said)
    {
      const SweepParameters &sweep = parameters.sweep;
      if (!sweep.fixed_step() || !sweep.has_fluid() || sweep.mode == "steady")
        return;
      double limit = std::numeric_limits<double>::infinity();
      for (const double velocity : sweep.superficial_velocities)
        limit =
          std::min(limit, response_at_rest(parameters, guessed_void_fraction, velocity));
      if (*sweep.fixed_step() > limit)
        said.push_back("in a bed at rest " + long_step(*sweep.fixed_step(), limit));
    }

    void
    warn_of_filter(const RunParameters &parameters, std::vector<std::string> &said)
    {
      const double       deviation = std::sqrt(2.) * parameters.filter_length();
      const double       diameter  = parameters.simulated_diameter();
      const double       vessel    = parameters.cylinder.diameter;
      std::ostringstream text;
      text << "Coupling/filter length = " << parameters.filter_length()
           << " m has a standard deviation of " << deviation << " m, ";
      if (deviation < least_filter * diameter)
        text << "less than a simulated particle (" << diameter
             << " m): it feels its own disturbance of the flow. Try auto";
      else if (deviation > largest_filter * vessel)
        text << "more than a quarter of the vessel (" << vessel
             << " m): the bed is smeared over all of it. Try less, or a smaller "
                "Particles/scale";
      else if (parameters.has_bubbles() && deviation < least_of_bubbles * diameter)
        text << "less than two simulated particles (of " << diameter
             << " m): where bubbles move, the finer the mesh the more these feel their "
                "own disturbance of the flow. Try auto";
      else
        return;
      said.push_back(text.str());
    }

    void
    warn_of_scale(const RunParameters &parameters, std::vector<std::string> &said)
    {
      const double across =
        parameters.cylinder.diameter / parameters.simulated_diameter();
      if (across >= fewest_across)
        return;
      std::ostringstream text;
      text << "only " << across << " simulated particles of "
           << parameters.simulated_diameter()
           << " m fit across the vessel: it is walls that the flow feels. Try a smaller "
              "Particles/scale than "
           << parameters.dem.particles.scale;
      said.push_back(text.str());
    }

    double
    longest_edge(const RunParameters &parameters)
    {
      return std::max(parameters.mesh.cell_size, parameters.mesh.cell_height);
    }

    bool
    has_bed(const RunParameters &parameters)
    {
      return parameters.filling.method != "none" && parameters.filling.count != 1;
    }

    void
    warn_of_cells(const RunParameters &parameters, std::vector<std::string> &said)
    {
      const double edge     = longest_edge(parameters);
      const double diameter = parameters.simulated_diameter();
      if (!has_bed(parameters) || edge <= largest_cell * diameter)
        return;
      std::ostringstream text;
      text << "cells of " << edge << " m are " << edge / diameter
           << " simulated particles of " << diameter
           << " m long: they smear the ends of a bed, which loses pressure drop by that. "
              "Try Mesh/cell size = "
           << 2. * diameter << ", or adaption";
      said.push_back(text.str());
    }

    void
    note_cells(const RunParameters &parameters, std::vector<std::string> &said)
    {
      const double edge      = longest_edge(parameters);
      const double diameter  = parameters.simulated_diameter();
      const double deviation = std::sqrt(2.) * parameters.filter_length();
      if (!has_bed(parameters) || edge > largest_cell * diameter)
        return; // or warned of
      const auto is_longer = [edge](const double length) {
        return edge > length * (1. + 1e-6);
      };
      const bool beyond_particle = is_longer(diameter),
                 beyond_filter   = is_longer(deviation);
      if (!beyond_particle && !beyond_filter)
        return;
      std::ostringstream text;
      text << "cells of " << edge << " m are longer than ";
      if (beyond_particle)
        text << "a simulated particle (" << diameter << " m)"
             << (beyond_filter ? " and " : "");
      if (beyond_filter)
        text << "the standard deviation of the filter (" << deviation << " m)";
      text << ": the ends of a bed are smeared over one of them, and a shallow bed loses "
              "some per cent of its pressure drop; its middle does not. "
              "Mesh/cell size = "
           << 0.65 * diameter << " resolves them";
      said.push_back(text.str());
    }

    void
    note_friction(const RunParameters &parameters, std::vector<std::string> &said)
    {
      const ContactParameters &contact = parameters.dem.contact;
      std::string              before, after;
      const auto               compare =
        [&](const std::string &name, const double packing, const double flow) {
          if (packing == flow)
            return;
          before += (before.empty() ? "Contact/packing " : ", Contact/packing ") + name +
                    " = " + text_of(packing);
          after +=
            (after.empty() ? "Contact/" : ", Contact/") + name + " = " + text_of(flow);
        };
      const Surface &particle = contact.particle_surface, &wall = contact.wall_surface;
      compare("particle friction", contact.packing_particle_friction, particle.friction);
      compare("wall friction", contact.packing_wall_friction, wall.friction);
      compare("particle rolling resistance",
              contact.packing_particle_rolling,
              particle.rolling_resistance);
      compare(
        "wall rolling resistance", contact.packing_wall_rolling, wall.rolling_resistance);
      if (!before.empty())
        said.push_back("while the bed is filled and settles: " + before +
                       "; from then on: " + after);
    }
  } // namespace

  StepLimits
  limits_at_rest(const RunParameters &parameters,
                 const double         void_fraction,
                 const double         velocity)
  {
    StepLimits             result;
    const MeshParameters  &mesh  = parameters.mesh;
    const SweepParameters &sweep = parameters.sweep;
    const double height = mesh.cell_height > 0. ? mesh.cell_height : mesh.cell_size;
    const double number = sweep.courant_number > 0.
                            ? sweep.courant_number
                            : std::numeric_limits<double>::infinity();
    result.response     = response_at_rest(parameters, void_fraction, velocity);
    result.courant      = velocity > 0. ? number * height * void_fraction / velocity
                                        : std::numeric_limits<double>::infinity();
    return result;
  }

  std::string
  long_step(const double step, const double limit)
  {
    std::ostringstream text;
    text << "Flow/time step = " << step
         << " s is longer than the particles take to respond "
         << "to the drag, " << limit
         << " s: how they do is not resolved in time. Try auto, or a step below this";
    return text.str();
  }

  std::vector<std::string>
  warnings(const RunParameters &parameters)
  {
    std::vector<std::string> said;
    if (!parameters.sweep.has_fluid())
      return said;
    warn_of_step(parameters, said);
    warn_of_filter(parameters, said);
    warn_of_scale(parameters, said);
    warn_of_cells(parameters, said);
    return said;
  }

  std::vector<std::string>
  notes(const RunParameters &parameters)
  {
    std::vector<std::string> said;
    if (parameters.sweep.has_fluid())
      note_cells(parameters, said);
    if (has_bed(parameters) && parameters.filling.start_from.empty())
      note_friction(parameters, said);
    return said;
  }
} // namespace graupel
