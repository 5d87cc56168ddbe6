#include <graupel/base/parameters.h>
#include <graupel/coupling/exchange.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // One component of a vector quantity of all own particles.
    template <typename Function>
    std::vector<double>
    by_row(const unsigned int n_rows, const Function &function)
    {
      std::vector<double> values(n_rows);
      for (unsigned int row = 0; row < n_rows; ++row)
        values[row] = function(row);
      return values;
    }

    // The surface of the bed lies between these parts of the mean solid fraction.
    constexpr double outside = 0.4, inside = 0.6;
    // Not even spheres in the densest order leave less void [-].
    constexpr double densest = 0.26;

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
    : law(law_void_fraction)
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
    law_alpha = law_void_fractions();
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

  void
  Exchange::deposit_void_fraction(const ParticleArrays &particles)
  {
    volume = by_row(particles.n_owned, [&](const unsigned int row) {
      return sphere_volume(particles.body[row].radius);
    });
    transfer.deposit(scratch, volume);
    filter.spread(solid_fraction, scratch);

    double on_mesh = 0., in_particles = 0.;
    for (unsigned int k = 0; k < solid_fraction.locally_owned_size(); ++k)
      {
        result.void_fraction.local_element(k) = 1. - solid_fraction.local_element(k);
        on_mesh +=
          nodes.measure().local_element(k) * (1. - result.void_fraction.local_element(k));
      }
    result.void_fraction.update_ghost_values();
    for (const double v : volume)
      in_particles += v;
    on_mesh      = dealii::Utilities::MPI::sum(on_mesh, nodes.mesh.communicator());
    in_particles = dealii::Utilities::MPI::sum(in_particles, nodes.mesh.communicator());
    volume_error = in_particles > 0. ? std::abs(on_mesh / in_particles - 1.) : 0.;
  }

  std::vector<double>
  Exchange::surface_factors(const std::vector<double> &alpha)
  {
    double solid = 0.;
    for (const double a : alpha)
      solid += 1. - a;
    const MPI_Comm communicator = nodes.mesh.communicator();
    solid                       = dealii::Utilities::MPI::sum(solid, communicator);
    const double n =
      dealii::Utilities::MPI::sum(static_cast<double>(alpha.size()), communicator);
    const double mean = std::max(solid / std::max(1., n), 1e-6);

    for (unsigned int k = 0; k < scratch.locally_owned_size(); ++k)
      {
        const double share = solid_fraction.local_element(k) / mean;
        scratch.local_element(k) =
          std::clamp((share - outside) / (inside - outside), 0., 1.);
      }
    scratch.update_ghost_values();
    filter.smooth(smooth_scratch, scratch);

    std::vector<double> chi, smooth_chi;
    transfer.sample(chi, scratch);
    transfer.sample(smooth_chi, smooth_scratch);
    for (unsigned int row = 0; row < chi.size(); ++row)
      chi[row] = smooth_chi[row] > 0. ? std::max(1., chi[row] / smooth_chi[row]) : 1.;
    return chi;
  }

  std::vector<double>
  Exchange::law_void_fractions()
  {
    std::vector<double> alpha;
    transfer.sample(alpha, result.void_fraction);
    std::vector<double> factor(alpha.size(), 1.);
    if (law.sharp_surface)
      factor = surface_factors(alpha);
    for (unsigned int row = 0; row < alpha.size(); ++row)
      factor[row] = std::max(1. - (1. - alpha[row]) * factor[row] * law.solid_ratio,
                             std::min(alpha[row], densest));
    return factor;
  }

  std::vector<double>
  Exchange::smooth_power(const int exponent)
  {
    for (unsigned int k = 0; k < scratch.locally_owned_size(); ++k)
      scratch.local_element(k) =
        std::pow(result.void_fraction.local_element(k), exponent);
    filter.smooth(smooth_scratch, scratch);
    std::vector<double> values;
    transfer.sample(values, smooth_scratch);
    return values;
  }

  void
  Exchange::update_drag(const ParticleArrays &particles)
  {
    const CostSheet::Scope             timing(costs, CostSheet::exchange);
    const unsigned int                 n = particles.n_owned;
    std::array<std::vector<double>, 3> velocity;
    for (unsigned int i = 0; i < 3; ++i)
      transfer.sample(velocity[i], smooth_velocity[i]);

    beta.resize(n);
    for (unsigned int row = 0; row < n; ++row)
      {
        dealii::Tensor<1, 3> slip;
        for (unsigned int i = 0; i < 3; ++i)
          slip[i] = velocity[i][row] - particles.body[row].velocity[i];
        try
          {
            const double a = law_alpha[row];
            beta[row]      = drags[particles.type[row]].beta(a,
                                                        slip.norm() / (of_slip[row] * a),
                                                        particles.body[row].radius) /
                        (of_drag[row] * a * a);
          }
        catch (const std::exception &error)
          {
            fail_at(particles.body[row].position, error.what());
          }
      }
    transfer.deposit(scratch, beta);
    filter.spread(result.drag, scratch);
    for (unsigned int i = 0; i < 3; ++i)
      {
        transfer.deposit(scratch, by_row(n, [&](const unsigned int row) {
                           return beta[row] * particles.body[row].velocity[i];
                         }));
        filter.spread(result.drag_source[i], scratch);
      }
  }

  std::vector<dealii::Tensor<1, 3>>
  Exchange::forces(const ParticleArrays &particles,
                   const FlowSolver     &flow,
                   const double          density,
                   const double          gravity)
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
              beta[row] * (velocity[row] - particles.body[row].velocity[i]) -
              volume[row] * gradient[row];
            fluid_force[i] += force[row][i];
          }
      }
    fluid_force = dealii::Utilities::MPI::sum(fluid_force, nodes.mesh.communicator());
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      force[row][2] += volume[row] * density * gravity;
    keep_ledger(flow, pressure_gradient);
    return force;
  }

  void
  Exchange::keep_ledger(const FlowSolver &flow, const NodalVectorField &pressure_gradient)
  {
    const double         share = result.shares_pressure ? 1. : 0.;
    dealii::Tensor<1, 3> lost;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < scratch.locally_owned_size(); ++k)
        {
          const double alpha = result.void_fraction.local_element(k);
          const double drag =
            result.drag.local_element(k) * flow.flux()[i].local_element(k) / alpha -
            result.drag_source[i].local_element(k);
          lost[i] += nodes.measure().local_element(k) *
                     (drag + share * alpha * pressure_gradient[i].local_element(k));
        }
    // The solids' share of the pressure is what the fluid's leaves of the total, which
    // the flow finds without the gradient at the nodes.
    lost = dealii::Utilities::MPI::sum(lost, nodes.mesh.communicator()) -
           share * flow.pressure_force();
    const double size = std::max(lost.norm(), fluid_force.norm());
    momentum_error    = size > 0. ? (lost - fluid_force).norm() / size : 0.;
  }
} // namespace graupel
