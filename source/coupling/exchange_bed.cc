// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/closures/self_disturbance.h>
#include <graupel/coupling/exchange.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    // The surface of the bed lies between these parts of the mean solid fraction.
    constexpr double outside = 0.4, inside = 0.6;
    // Not even spheres in the densest order leave less void [-].
    constexpr double densest = 0.26;
    // Solid fraction of spheres packed at random as densely as they can be [-].
    constexpr double random_packing = 0.64;
    // Less than this is no void fraction of spheres, whatever the filter's overshoot [-].
    constexpr double impossible = 0.1;
    // A bed is no looser than the second; what is looser than the first is none [-].
    constexpr double no_bed = 0.05, bed = 0.15;
    // The surroundings of a particle, which say what counts of itself, are found so
    // often.
    constexpr unsigned int corrections = 4;
  } // namespace

  double
  Exchange::mean(const std::vector<double> &values) const
  {
    double sum = 0.;
    for (const double value : values)
      sum += value;
    const MPI_Comm communicator = nodes.mesh.communicator();
    const double   n =
      dealii::Utilities::MPI::sum(static_cast<double>(values.size()), communicator);
    return dealii::Utilities::MPI::sum(sum, communicator) / std::max(1., n);
  }

  void
  Exchange::deposit_void_fraction(const ParticleArrays &particles)
  {
    volume.resize(particles.n_owned);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      volume[row] = sphere_volume(particles.body[row].radius);
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

  void
  Exchange::check_void_fraction(const ParticleArrays &particles) const
  {
    const MPI_Comm communicator = nodes.mesh.communicator();
    double         least = 1., size = 0., diameter = 0.;
    for (unsigned int k = 0; k < solid_fraction.locally_owned_size(); ++k)
      if (const double alpha = 1. - solid_fraction.local_element(k); !(alpha >= least))
        {
          least = alpha;
          size  = std::cbrt(nodes.measure().local_element(k));
        }
    const double least_of_all = dealii::Utilities::MPI::min(least, communicator);
    if (least_of_all >= impossible)
      return;
    size = dealii::Utilities::MPI::max(least == least_of_all ? size : 0., communicator);
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      diameter = std::max(diameter, 2. * particles.body[row].radius);
    diameter = dealii::Utilities::MPI::max(diameter, communicator);
    std::ostringstream reason;
    reason << "the void fraction on the mesh falls to " << least_of_all
           << ", and spheres leave at least " << densest
           << " between them: a filter of length " << filter_length
           << " m does not spread spheres of up to " << diameter
           << " m far enough over cells of about " << size
           << " m. Take auto, or a length of at least 0.7 diameters, or cells (Mesh/cell "
              "size) of several diameters";
    throw InputError("Coupling/filter length", reason.str());
  }

  void
  Exchange::find_marks()
  {
    for (unsigned int n = 0; n < marks.size(); ++n)
      {
        marks[n].clear();
        for (const auto &edges : transfer.edges())
          marks[n].emplace_back(filter_length, n + 1, edges);
      }
  }

  double
  Exchange::own_solid(const unsigned int row, const unsigned int filters) const
  {
    const ParticleTransfer::Place &place = transfer.places()[row];
    return volume[row] * marks[filters - 1][place.cell].density(place.x);
  }

  std::vector<double>
  Exchange::surrounding_solids()
  {
    std::vector<double> solid(flow_alpha.size());
    isolation.resize(solid.size());
    for (unsigned int row = 0; row < solid.size(); ++row)
      {
        const double all = 1. - flow_alpha[row];
        const double own = std::min(all, own_solid(row, 1));
        solid[row]       = all - own;
        for (unsigned int n = 0; n < corrections; ++n)
          {
            isolation[row] = hard_sphere_structure_factor(solid[row]);
            solid[row]     = all - isolation[row] * own;
          }
      }
    return solid;
  }

  std::vector<double>
  Exchange::surface_factors(const std::vector<double> &solid)
  {
    const double mean_solid = std::max(mean(solid), 1e-6);
    for (unsigned int k = 0; k < scratch.locally_owned_size(); ++k)
      {
        const double share = solid_fraction.local_element(k) / mean_solid;
        scratch.local_element(k) =
          std::clamp((share - outside) / (inside - outside), 0., 1.);
      }
    scratch.update_ghost_values();
    filter.smooth(smooth_scratch, scratch);

    auto                factor     = transfer.sample(scratch);
    const auto          smooth_chi = transfer.sample(smooth_scratch);
    std::vector<double> within;
    for (unsigned int row = 0; row < factor.size(); ++row)
      {
        factor[row] =
          smooth_chi[row] > 0. ? std::max(1., factor[row] / smooth_chi[row]) : 1.;
        within.push_back(solid[row] * factor[row]);
      }
    const double mean_within = mean(within);
    for (unsigned int row = 0; row < factor.size(); ++row)
      {
        const double solid_of_bed = std::max(within[row], mean_within);
        const double is_bed =
          std::clamp((solid_of_bed - no_bed) / (bed - no_bed), 0., 1.);
        if (is_bed < 1.)
          factor[row] = 1. + is_bed * (factor[row] - 1.);
      }
    return factor;
  }

  std::vector<double>
  Exchange::law_void_fractions()
  {
    flow_alpha   = transfer.sample(result.void_fraction);
    surroundings = surrounding_solids();
    std::vector<double> alpha(surroundings.size(), 1.);
    if (law.sharp_surface)
      alpha = surface_factors(surroundings);
    for (unsigned int row = 0; row < alpha.size(); ++row)
      {
        // At a surface the neighbours are as close as within the bed.
        const double factor = alpha[row];
        isolation[row]      = hard_sphere_structure_factor(factor * surroundings[row]);
        surroundings[row] =
          std::max(0., 1. - flow_alpha[row] - isolation[row] * own_solid(row, 1));
        alpha[row] = std::max(1. - surroundings[row] * factor * law.solid_ratio,
                              std::min(flow_alpha[row], densest));
      }
    return alpha;
  }

  std::vector<double>
  Exchange::solid_fractions() const
  {
    std::vector<double> solid;
    for (const double alpha : law_alpha)
      solid.push_back(1. - alpha);
    return solid;
  }

  void
  Exchange::look_ahead(const ParticleArrays &particles)
  {
    next_alpha = law_alpha;
    const double ahead =
      response.step_before > 0. ? 0.5 * response.step / response.step_before : 0.;
    if (ahead == 0.)
      return;
    for (unsigned int row = 0; row < next_alpha.size(); ++row)
      if (const double before = particles.solid_fraction[row]; before > 0.)
        {
          const double now  = 1. - law_alpha[row];
          const double most = std::max(now, std::min(random_packing, 2. * now));
          next_alpha[row] =
            1. - std::clamp(now + ahead * (now - before), 0.5 * now, most);
        }
  }

  void
  Exchange::find_solid_gradient()
  {
    if (law.upstream == 0.)
      return;
    solid_gradient = transfer.sample_gradient(solid_fraction);
    for (unsigned int row = 0; row < solid_gradient.size(); ++row)
      {
        const ParticleTransfer::Place &place = transfer.places()[row];
        solid_gradient[row] -= isolation[row] * volume[row] *
                               (place.by_x * marks[0][place.cell].slopes(place.x));
      }
  }

  double
  Exchange::void_fraction_upstream(const unsigned int          row,
                                   const double                diameter,
                                   const dealii::Tensor<1, 3> &slip_velocity) const
  {
    const double speed = slip_velocity.norm();
    const double here  = next_alpha[row];
    if (law.upstream == 0. || !(speed > 0.))
      return here;
    const double difference = response.looseness[row] * law.upstream * diameter *
                              (solid_gradient[row] * slip_velocity) / speed;
    return std::clamp(here + difference, std::min(here, densest), 1.);
  }

  std::vector<double>
  Exchange::smooth_power(const int exponent)
  {
    for (unsigned int k = 0; k < scratch.locally_owned_size(); ++k)
      scratch.local_element(k) =
        std::pow(result.void_fraction.local_element(k), exponent);
    filter.smooth(smooth_scratch, scratch);
    auto values = transfer.sample(smooth_scratch);
    for (unsigned int row = 0; row < values.size(); ++row)
      values[row] *= 1. + (exponent + 1. / 3.) * isolation[row] * own_solid(row, 2);
    return values;
  }
} // namespace graupel
