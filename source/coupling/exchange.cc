#include <graupel/base/parameters.h>
#include <graupel/coupling/exchange.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    [[noreturn]] void
    fail_at(const dealii::Point<3> &position, const std::string &reason)
    {
      std::ostringstream message;
      message << "At the particle at (" << position << ") m: " << reason;
      throw std::runtime_error(message.str());
    }
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
      "diameter of a simulated particle, 0 is a plain deposit on the nearest "
      "nodes [m].");
    prm.add_parameter(
      "bed surface",
      bed_surface,
      "Where the filter smears the surface of a bed: sharp evaluates the drag law at the "
      "solid fraction within the bed, as if the bed ended at once; smeared at the one of "
      "the filter, which costs a bed 1.1 standard deviations of its length.",
      dealii::Patterns::Selection("sharp|smeared"));
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
  CouplingParameters::length(const double simulated_diameter) const
  {
    // A standard deviation of one diameter: with less, the solid fraction at a particle
    // is no longer that of its surroundings; with more, the bed's surface is
    // smeared further (doc/design.md).
    return number_or_word("Coupling/filter length", filter_length, {"auto"})
      .value_or(simulated_diameter / std::sqrt(2.));
  }

  void
  CouplingParameters::check() const
  {
    const double value = length(1.);
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
                     CostSheet                     &costs)
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
    for (NodalVector *field : {&solid_fraction, &scratch, &smooth_scratch})
      nodes.initialize(*field);
    for (NodalVectorField *field : {&interstitial, &smooth_velocity, &smooth_gradient})
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
    deposit_void_fraction(particles);
    check_void_fraction(particles);
    law_alpha = law_void_fractions(particles);
    of_slip   = smooth_power(-1);
    of_drag   = result.shares_pressure ? smooth_power(-2) : of_slip;
  }

  void
  Exchange::follow(const NodalVectorField &flux, const NodalVector &void_fraction)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int k = 0; k < interstitial[i].locally_owned_size(); ++k)
          interstitial[i].local_element(k) =
            flux[i].local_element(k) / void_fraction.local_element(k);
        filter.smooth(smooth_velocity[i], interstitial[i]);
      }
  }

  template <typename Function>
  void
  Exchange::spread(NodalVector &x, const Function &value)
  {
    std::vector<double> values(beta.size());
    for (unsigned int row = 0; row < values.size(); ++row)
      values[row] = value(row);
    transfer.deposit(scratch, values);
    filter.spread(x, scratch);
  }

  void
  Exchange::find_drag_coefficients(const ParticleArrays &particles)
  {
    const unsigned int                 n = particles.n_owned;
    std::array<std::vector<double>, 3> velocity;
    for (unsigned int i = 0; i < 3; ++i)
      transfer.sample(velocity[i], smooth_velocity[i]);

    beta.resize(n);
    slip.resize(n);
    for (unsigned int row = 0; row < n; ++row)
      {
        dealii::Tensor<1, 3> relative;
        for (unsigned int i = 0; i < 3; ++i)
          relative[i] = velocity[i][row] - particles.body[row].velocity[i];
        const double a = law_alpha[row];
        slip[row]      = relative.norm() / (of_slip[row] * a);
        try
          {
            beta[row] =
              drags[particles.type[row]].beta(a, slip[row], particles.body[row].radius) /
              (of_drag[row] * a * a);
          }
        catch (const std::exception &error)
          {
            fail_at(particles.body[row].position, error.what());
          }
      }
  }

  void
  Exchange::update_drag(const ParticleArrays &particles)
  {
    const CostSheet::Scope timing(costs, CostSheet::exchange);
    find_drag_coefficients(particles);
    response = held_response(particles);
    answer.assign(particles.n_owned, 1.);
    result.solids.reset();
    spread(result.drag, [&](const unsigned int row) { return beta[row]; });
    for (unsigned int i = 0; i < 3; ++i)
      spread(result.drag_source[i], [&](const unsigned int row) {
        return beta[row] * response.velocity[row][i];
      });
  }

  void
  Exchange::update_drag(const ParticleArrays   &particles,
                        const ParticleResponse &particle_response)
  {
    const CostSheet::Scope timing(costs, CostSheet::exchange);
    find_drag_coefficients(particles);
    response = particle_response;
    answer.resize(particles.n_owned);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      answer[row] = 1. / (1. + beta[row] * response.mobility[row]);
    if (!result.solids)
      result.solids.emplace(nodes);
    MovingSolids &solids = *result.solids;

    const auto drag = [&](const unsigned int row) { return answer[row] * beta[row]; };
    const auto flux = [&](const unsigned int row) {
      return volume[row] * response.mobility[row];
    };
    spread(result.drag, drag);
    spread(solids.by_velocity,
           [&](const unsigned int row) { return flux(row) * drag(row); });
    if (result.shares_pressure)
      {
        spread(solids.pressure_share,
               [&](const unsigned int row) { return answer[row] * volume[row]; });
        spread(solids.by_gradient, [&](const unsigned int row) {
          return flux(row) * answer[row] * volume[row];
        });
      }
    for (unsigned int i = 0; i < 3; ++i)
      {
        spread(result.drag_source[i], [&](const unsigned int row) {
          return drag(row) * response.velocity[row][i];
        });
        spread(solids.flux[i], [&](const unsigned int row) {
          return answer[row] * volume[row] * response.velocity[row][i];
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
    const NodalVectorField pressure_gradient = flow.pressure_gradient();
    follow(flow.flux(), result.void_fraction);

    std::vector<dealii::Tensor<1, 3>> force(particles.n_owned);
    std::vector<double>               velocity, gradient;
    fluid_force = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        transfer.sample(velocity, smooth_velocity[i]);
        gradient.assign(particles.n_owned, 0.);
        if (result.shares_pressure)
          {
            filter.smooth(smooth_gradient[i], pressure_gradient[i]);
            transfer.sample(gradient, smooth_gradient[i]);
          }
        for (unsigned int row = 0; row < particles.n_owned; ++row)
          {
            force[row][i] =
              answer[row] * (beta[row] * (velocity[row] - response.velocity[row][i]) -
                             volume[row] * gradient[row]);
            fluid_force[i] += force[row][i];
          }
      }
    fluid_force = dealii::Utilities::MPI::sum(fluid_force, nodes.mesh.communicator());
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      force[row] -= (volume[row] * density) * gravity;
    keep_ledger(flow, pressure_gradient);
    return force;
  }

  void
  Exchange::keep_ledger(const FlowSolver &flow, const NodalVectorField &pressure_gradient)
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
          const double gradient = pressure_gradient[i].local_element(k);
          const double measure  = nodes.measure().local_element(k);
          lost[i] += measure * (drag + (model_share - share) * gradient);
          traffic += measure * (std::abs(drag) + std::abs(share * gradient));
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
        const double radius = particles.body[row].radius, a = law_alpha[row];
        const double slope =
          drags[particles.type[row]].slope(a, slip[row], radius) / (of_drag[row] * a * a);
        step = std::min(
          step, graupel::stable_step(flow_alpha[row], particles.mass[row], slope));
      }
    return dealii::Utilities::MPI::min(step, nodes.mesh.communicator());
  }
} // namespace graupel
