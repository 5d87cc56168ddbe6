// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/coupling/exchange.h>

namespace graupel
{
  namespace
  {
    // How far upstream Foscolo & Gibilaro's layers feel the void fraction, in diameters,
    // and from which density over the particles' on a fluid is taken for a liquid [-].
    constexpr double foscolo_gibilaro_distance = 2. / 3., least_liquid = 0.05;
  } // namespace

  void
  CouplingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Coupling");
    prm.add_parameter(
      "model",
      model,
      "A: fluid and solids share the pressure gradient by their volumes; B: it acts on "
      "the fluid alone, and the drag is larger by one over the void fraction. In a "
      "uniform "
      "bed both give the same pressure drop.",
      dealii::Patterns::Selection("A|B"));
    prm.add_parameter(
      "filter length",
      filter_length,
      "Length of the filter that spreads a particle's volume and drag over the "
      "mesh, and gathers fluid fields at the particle: a Gaussian of standard "
      "deviation 1.41 times this length. auto makes the standard deviation one "
      "diameter of a simulated particle, and two where a gas in transient mode is faster "
      "than the onset of fluidisation, in a vessel of eight diameters at least, as "
      "bubbles depend on the mesh with less; 0 is a plain deposit on the nearest nodes "
      "[m].");
    prm.add_parameter(
      "bed surface",
      bed_surface,
      "Where the filter smears the surface of a bed: sharp evaluates the drag law at the "
      "solid fraction within the bed, as if the bed ended at once; smeared at the one of "
      "the filter, which costs a bed 1.1 standard deviations of its length.",
      dealii::Patterns::Selection("sharp|smeared"));
    prm.add_parameter(
      "void fraction gradient",
      void_fraction_gradient,
      "foscolo-gibilaro: the drag of a particle that moves freely is that of the void "
      "fraction two thirds of a diameter upstream, the elasticity of a fluidised bed "
      "(Foscolo & Gibilaro (1984, 1987)): without it waves of void fraction grow in a "
      "bed in a liquid. A bed at rest has none of it. none: where the particle is. auto: "
      "foscolo-gibilaro in a fluid of more than a twentieth of the particles' density, "
      "none in a gas, whose bubbles it damps more than measurement says.",
      dealii::Patterns::Selection("auto|none|foscolo-gibilaro"));
    prm.add_parameter(
      "mixture",
      mixture,
      "Drag in a bed of several sizes. sauter mean: the law is evaluated for the Sauter "
      "mean diameter of the original particles and divided among the sizes after van der "
      "Hoef et al. (2005); own diameter: for each particle's own.",
      dealii::Patterns::Selection("sauter mean|own diameter"));
    prm.leave_subsection();
  }

  double
  CouplingParameters::length(const double simulated_diameter, const bool bubbles) const
  {
    // A standard deviation of one diameter: with less, the solid fraction at a particle
    // is no longer that of its surroundings; with more, the bed's surface is
    // smeared further. Of two where bubbles move: with less, particles push on their own
    // disturbance, the more the finer the mesh (doc/design.md).
    const double deviation = (bubbles ? 2. : 1.) * simulated_diameter;
    return number_or_word("Coupling/filter length", filter_length, {"auto"})
      .value_or(deviation / std::sqrt(2.));
  }

  double
  CouplingParameters::upstream(const double density_ratio) const
  {
    const bool is_wanted =
      void_fraction_gradient == "foscolo-gibilaro" ||
      (void_fraction_gradient == "auto" && density_ratio > least_liquid);
    return is_wanted ? foscolo_gibilaro_distance : 0.;
  }

  void
  CouplingParameters::check() const
  {
    const double value = length(1., false);
    require(value >= 0. && std::isfinite(value),
            "Coupling/filter length",
            "a filter cannot have a negative length; 0 switches it off, auto makes "
            "the filter one particle diameter wide");
  }

  Exchange::Exchange(const double                   filter_length,
                     const bool                     shares_pressure,
                     const LawVoidFraction         &law_void_fraction,
                     const std::vector<DragOfType> &drags,
                     const NodalSpace              &nodes,
                     CostSheet                     &costs,
                     const AddedForceLaws          &added_forces)
    : filter_length(filter_length)
    , law(law_void_fraction)
    , drags(drags)
    , nodes(nodes)
    , costs(costs)
    , filter(nodes, filter_length)
    , transfer(nodes)
    , result(nodes)
  {
    result.shares_pressure = shares_pressure;
    if (added_forces.parameters.any())
      added.emplace(added_forces, nodes);
    for (NodalVector *field : {&solid_fraction, &scratch, &smooth_scratch})
      nodes.initialize(*field);
    for (NodalVectorField *field :
         {&interstitial, &smooth_velocity, &gradient, &smooth_gradient})
      for (NodalVector &component : *field)
        {
          nodes.initialize(component);
          component.update_ghost_values();
        }
  }

  void
  Exchange::update_bed(const ParticleStore &store, const ParticleArrays &particles)
  {
    const CostSheet::Scope timing(costs, CostSheet::void_fraction);
    transfer.update(store);
    find_marks();
    deposit_void_fraction(particles);
    check_void_fraction(particles);
    law_alpha = law_void_fractions();
    find_solid_gradient();
    of_slip = smooth_power(-1);
    of_drag = result.shares_pressure ? smooth_power(-2) : of_slip;
  }

  void
  Exchange::follow(const FlowSolver &flow, const NodalVector &void_fraction)
  {
    gradient = flow.pressure_gradient();
    std::vector<NodalVector *> smoothed;
    const auto                 smooth = [&](NodalVector &x, const NodalVector &f) {
      x.zero_out_ghost_values();
      x.equ(1., f);
      smoothed.push_back(&x);
    };
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int k = 0; k < interstitial[i].locally_owned_size(); ++k)
          interstitial[i].local_element(k) =
            flow.flux()[i].local_element(k) / void_fraction.local_element(k);
        smooth(smooth_velocity[i], interstitial[i]);
        if (result.shares_pressure)
          smooth(smooth_gradient[i], gradient[i]);
      }
    filter.smooth(smoothed);
    if (added)
      added->follow(flow, filter);
  }

  void
  Exchange::update_drag(const ParticleArrays &particles)
  {
    const CostSheet::Scope timing(costs, CostSheet::exchange);
    response = held_response(particles);
    find_drag_coefficients(particles);
    find_added_forces(particles);
    answer.assign(particles.n_owned, 1.);
    result.solids.reset();
    std::vector<NodalVector *> fields;
    deposit(
      result.drag, [&](const unsigned int row) { return beta[row]; }, fields);
    for (unsigned int i = 0; i < 3; ++i)
      deposit(
        result.drag_source[i],
        [&](const unsigned int row) { return beta[row] * response.velocity[row][i]; },
        fields);
    filter.spread(fields);
    add_forces();
  }

  void
  Exchange::update_drag(const ParticleArrays   &particles,
                        const ParticleResponse &particle_response)
  {
    const CostSheet::Scope timing(costs, CostSheet::exchange);
    response = particle_response;
    find_drag_coefficients(particles);
    find_added_forces(particles);
    find_answers();
    if (!result.solids)
      result.solids.emplace(nodes);
    MovingSolids &solids = *result.solids;

    const auto drag = [&](const unsigned int row) { return answer[row] * beta[row]; };
    const auto flux = [&](const unsigned int row) {
      return volume[row] * response.mobility[row];
    };
    std::vector<NodalVector *> fields;
    const auto                 add = [&](NodalVector &x, const auto &value) {
      deposit(x, value, fields);
    };
    add(result.drag, drag);
    add(solids.by_velocity,
        [&](const unsigned int row) { return flux(row) * drag(row); });
    if (result.shares_pressure)
      {
        add(solids.pressure_share,
            [&](const unsigned int row) { return answer[row] * volume[row]; });
        add(solids.by_gradient, [&](const unsigned int row) {
          return flux(row) * answer[row] * volume[row];
        });
      }
    for (unsigned int i = 0; i < 3; ++i)
      {
        add(result.drag_source[i], [&](const unsigned int row) {
          return drag(row) * response.velocity[row][i];
        });
        add(solids.flux[i], [&](const unsigned int row) {
          return answer[row] * volume[row] * response.velocity[row][i];
        });
      }
    filter.spread(fields);
    put_back_old_fields();
    add_forces();
  }

  void
  Exchange::find_answers()
  {
    answer.resize(beta.size());
    double least = 1.;
    for (unsigned int row = 0; row < answer.size(); ++row)
      {
        answer[row] = 1. / (1. + (beta[row] + inertia(row)) * response.mobility[row]);
        least       = std::min(least, answer[row]);
      }
    least    = dealii::Utilities::MPI::min(least, nodes.mesh.communicator());
    old_part = std::clamp(4. * least - 2., 0., 1.);
  }

  std::vector<dealii::Tensor<1, 3>>
  Exchange::old_forces() const
  {
    auto force = transfer.sample(smooth_gradient);
    for (unsigned int row = 0; row < force.size(); ++row)
      force[row] = beta[row] * felt_velocity[row] - volume[row] * force[row];
    return force;
  }

  void
  Exchange::put_back_old_fields()
  {
    if (old_part == 0.)
      return;
    MovingSolids &solids = *result.solids;
    const auto    force  = old_forces();
    const double  shared = result.shares_pressure ? 1. : 0.;
    NodalVector   whole_drag, correction;
    for (NodalVector *field : {&whole_drag, &correction})
      nodes.initialize(*field);
    spread(whole_drag, [&](const unsigned int row) { return beta[row]; });
    const auto add = [&](NodalVector &x, const auto &value) {
      for (unsigned int k = 0; k < x.locally_owned_size(); ++k)
        x.local_element(k) += old_part * (correction.local_element(k) + value(k));
      nodes.distribute(x);
    };
    for (unsigned int i = 0; i < 3; ++i)
      {
        spread(correction, [&](const unsigned int row) {
          return (1. - answer[row]) * force[row][i];
        });
        add(result.drag_source[i], [&](const unsigned int k) {
          return (result.drag.local_element(k) - whole_drag.local_element(k)) *
                   interstitial[i].local_element(k) +
                 shared *
                   (solid_fraction.local_element(k) -
                    solids.pressure_share.local_element(k)) *
                   gradient[i].local_element(k);
        });
        spread(correction, [&](const unsigned int row) {
          return volume[row] * response.mobility[row] * answer[row] * force[row][i];
        });
        add(solids.flux[i], [&](const unsigned int k) {
          return solids.by_gradient.local_element(k) * gradient[i].local_element(k) -
                 solids.by_velocity.local_element(k) * interstitial[i].local_element(k);
        });
      }
  }

  std::vector<dealii::Tensor<1, 3>>
  Exchange::forces(const ParticleArrays       &particles,
                   const FlowSolver           &flow,
                   const double                density,
                   const dealii::Tensor<1, 3> &gravity)
  {
    const CostSheet::Scope timing(costs, CostSheet::exchange);
    follow(flow, result.void_fraction);

    const auto velocity = transfer.sample(smooth_velocity);
    const auto slope    = transfer.sample(smooth_gradient);

    std::vector<dealii::Tensor<1, 3>> force(particles.n_owned);
    fluid_force = 0.;
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        force[row] =
          beta[row] * (velocity[row] - response.velocity[row]) - volume[row] * slope[row];
        if (added)
          force[row] += added_force(row, velocity[row]);
        force[row] *= answer[row];
        fluid_force += force[row];
      }
    fluid_force = dealii::Utilities::MPI::sum(fluid_force, nodes.mesh.communicator());
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      force[row] -= (volume[row] * density) * gravity;
    keep_ledger(flow);
    return force;
  }

  void
  Exchange::keep_ledger(const FlowSolver &flow)
  {
    const double         model_share = result.shares_pressure ? 1. : 0.;
    dealii::Tensor<1, 3> lost;
    double               traffic = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < scratch.locally_owned_size(); ++k)
        {
          const double alpha = result.void_fraction.local_element(k);
          const double share = !result.shares_pressure ? 0.
                               : result.solids
                                 ? result.solids->pressure_share.local_element(k)
                                 : 1. - alpha;
          const double drag =
            result.drag.local_element(k) * flow.flux()[i].local_element(k) / alpha -
            result.drag_source[i].local_element(k);
          const double slope   = gradient[i].local_element(k);
          const double measure = nodes.measure().local_element(k);
          lost[i] += measure * (drag + (model_share - share) * slope);
          traffic += measure * (std::abs(drag) + std::abs(share * slope));
        }
    // The solids' share of the pressure is what the fluid's leaves of the total, which
    // the flow finds without the gradient at the nodes.
    lost = dealii::Utilities::MPI::sum(lost, nodes.mesh.communicator()) -
           model_share * flow.pressure_force();
    traffic        = dealii::Utilities::MPI::sum(traffic, nodes.mesh.communicator());
    momentum_error = traffic > 0. ? (lost - fluid_force).norm() / traffic : 0.;
  }

  double
  Exchange::stable_step(const ParticleArrays &particles) const
  {
    double step = std::numeric_limits<double>::infinity();
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      {
        const double radius = particles.body[row].radius, a = felt_alpha[row];
        const double slope = drags[particles.type[row]].slope(a, slip[row], radius) /
                             (of_drag[row] * a * a * (1. - own_part[row]));
        const double mass =
          particles.mass[row] + (added ? added->virtual_mass()[row] : 0.);
        step = std::min(step, graupel::stable_step(flow_alpha[row], mass, slope));
      }
    return dealii::Utilities::MPI::min(step, nodes.mesh.communicator());
  }
} // namespace graupel
