// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/dem/bed/sphere_cuts.h>
#include <graupel/dem/numbers/exact_sum.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graupel
{
  using dealii::numbers::PI;
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    // Place of the first plane above z, which is the number of planes not above it.
    std::size_t
    planes_up_to(const std::vector<double> &planes, const double z)
    {
      return std::upper_bound(planes.begin(), planes.end(), z) - planes.begin();
    }

    // Planes from a start in steps until one is at or above the height over it.
    std::vector<double>
    planes_every(const double step, const double start, const double height)
    {
      std::vector<double> planes{start};
      while (planes.back() - start < height * (1. - 1e-12))
        planes.push_back(start + planes.size() * step);
      return planes;
    }
  } // namespace

  std::unordered_map<std::int64_t, unsigned int>
  rows_by_id(const ParticleArrays &particles)
  {
    std::unordered_map<std::int64_t, unsigned int> rows;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      rows[particles.id[i]] = i;
    return rows;
  }

  ContactCounts
  count_contacts(const ParticleArrays            &particles,
                 const std::vector<ContactState> &contacts)
  {
    ContactCounts counts;
    counts.particles.resize(particles.n_owned);
    counts.walls.resize(particles.n_owned);
    const auto rows = rows_by_id(particles);
    for (const auto &contact : contacts)
      {
        auto      &of_partner = contact.second < 0 ? counts.walls : counts.particles;
        const auto first      = rows.find(contact.first);
        if (first != rows.end())
          ++of_partner[first->second];
        const auto second = rows.find(contact.second);
        if (second != rows.end())
          ++of_partner[second->second];
      }
    return counts;
  }

  std::vector<RadialShell>
  shell_void_fractions(const ParticleArrays &particles,
                       const Cylinder       &cylinder,
                       const double          width,
                       const double          lower,
                       const double          upper,
                       MPI_Comm              communicator)
  {
    const double tube = cylinder.diameter / 2.;
    // Rounding must not make a last shell of no thickness.
    const auto n_shells =
      static_cast<unsigned int>(std::ceil(tube / width * (1. - 1e-9)));
    const auto outer_radius = [&](const unsigned int k) {
      return std::max(0., tube - k * width);
    };

    double largest = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      largest = std::max(largest, particles.body[i].radius);
    const ExactSum        zero(sphere_volume(mpi::max(largest, communicator)));
    std::vector<ExactSum> solid(n_shells, zero);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const auto  &body = particles.body[i];
        const double s    = std::hypot(body.position[0], body.position[1]);
        const double from = lower - body.position[2], to = upper - body.position[2];
        if (from >= body.radius || to <= -body.radius)
          continue;
        const auto volume_within = [&](const unsigned int k) {
          return sphere_volume_in_tube(body.radius, s, outer_radius(k), from, to);
        };
        unsigned int k = 0;
        while (k + 1 < n_shells && outer_radius(k + 1) >= s + body.radius)
          ++k;
        for (double outside = volume_within(k); k < n_shells && outside > 0.; ++k)
          {
            const double inside = k + 1 < n_shells ? volume_within(k + 1) : 0.;
            solid[k].add(outside - inside);
            outside = inside;
          }
      }

    const auto               volumes = ExactSum::totals(solid, communicator);
    std::vector<RadialShell> shells;
    for (unsigned int k = 0; k < n_shells; ++k)
      {
        const double outer = outer_radius(k);
        const double inner = k + 1 < n_shells ? outer_radius(k + 1) : 0.;
        const double shell = PI * (outer - inner) * (outer + inner) * (upper - lower);
        shells.push_back({tube - outer, tube - inner, 1. - volumes[k] / shell});
      }
    return shells;
  }

  std::vector<LoadLevel>
  load_profile(const ParticleArrays            &particles,
               const Vessel                    &vessel,
               const std::vector<ContactState> &contacts,
               const std::vector<double>       &planes,
               const double                     gravity,
               MPI_Comm                         communicator)
  {
    double largest = 0.;
    for (const auto &contact : contacts)
      largest = std::max(largest, std::abs(contact.force[2]));
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      largest = std::max(largest,
                         particles.mass[i] * std::abs(gravity) +
                           std::abs(particles.external_force[i][2]));
    const ExactSum zero(mpi::max(largest, communicator));

    // Through the planes; and of particles by the number of planes below them.
    std::vector<ExactSum> through(planes.size(), zero);
    std::vector<ExactSum> on_walls(planes.size() + 1, zero),
      weights(planes.size() + 1, zero);
    for (const auto &contact : contacts)
      {
        const double first      = contact.first_center[2];
        const bool   with_wall  = contact.second < 0;
        const bool   on_bottom  = with_wall && vessel.is_floor(wall_of(contact.second));
        const double second     = on_bottom ? -infinity : contact.second_center[2];
        const double on_upper_z = first > second ? contact.force[2] : -contact.force[2];
        if (with_wall && !on_bottom)
          on_walls[planes_up_to(planes, first)].add(contact.force[2]);
        else
          for (auto k = planes_up_to(planes, std::min(first, second));
               k < planes_up_to(planes, std::max(first, second));
               ++k)
            through[k].add(on_upper_z);
      }
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      weights[planes_up_to(planes, particles.body[i].position[2])].add(
        particles.mass[i] * gravity - particles.external_force[i][2]);

    const auto loads     = ExactSum::totals(through, communicator);
    const auto walls     = ExactSum::totals(on_walls, communicator);
    const auto of_weight = ExactSum::totals(weights, communicator);

    std::vector<LoadLevel> levels(planes.size());
    double                 wall_load = 0., weight = 0.;
    for (std::size_t k = planes.size(); k-- > 0;)
      {
        wall_load += walls[k + 1];
        weight += of_weight[k + 1];
        levels[k] = {planes[k], loads[k], wall_load, weight};
      }
    return levels;
  }

  std::vector<CoordinationSlab>
  coordination_profile(const ParticleArrays      &particles,
                       const ContactCounts       &counts,
                       const std::vector<double> &planes,
                       MPI_Comm                   communicator)
  {
    const std::size_t          n_slabs = planes.size() - 1;
    std::vector<unsigned long> sums(3 * n_slabs);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const auto above = planes_up_to(planes, particles.body[i].position[2]);
        if (above == 0 || above > n_slabs)
          continue;
        unsigned long *slab = &sums[3 * (above - 1)];
        slab[0] += 1;
        slab[1] += counts.particles[i];
        slab[2] += counts.walls[i];
      }
    mpi::sum(sums, communicator, sums);

    std::vector<CoordinationSlab> slabs;
    for (std::size_t k = 0; k < n_slabs; ++k)
      {
        const double n = std::max(1ul, sums[3 * k]);
        slabs.push_back({planes[k],
                         planes[k + 1],
                         sums[3 * k],
                         sums[3 * k + 1] / n,
                         sums[3 * k + 2] / n});
      }
    return slabs;
  }

  std::vector<unsigned long>
  coordination_histogram(const ContactCounts &counts,
                         const bool           with_walls,
                         MPI_Comm             communicator)
  {
    std::vector<unsigned long> histogram(1);
    for (std::size_t i = 0; i < counts.particles.size(); ++i)
      {
        const auto n = counts.particles[i] + (with_walls ? counts.walls[i] : 0);
        histogram.resize(std::max<std::size_t>(histogram.size(), n + 1));
        ++histogram[n];
      }
    histogram.resize(mpi::max<unsigned long>(histogram.size(), communicator));
    mpi::sum(histogram, communicator, histogram);
    return histogram;
  }

  BedProfiles
  bed_profiles(const Dem &dem, const BedObservables::Bed &of_bed, const double diameter)
  {
    const auto   &particles = dem.particles();
    const Vessel &vessel    = dem.vessel_shape();
    const auto    comm      = dem.communicator();
    // One sweep for both: counts need the contacts with ghosts, loads must not.
    const auto contacts = dem.contact_states(true);
    auto       own      = contacts;
    const auto rows     = rows_by_id(particles);
    own.erase(
      std::remove_if(own.begin(),
                     own.end(),
                     [&](const auto &contact) { return rows.count(contact.first) == 0; }),
      own.end());
    const auto counts = count_contacts(particles, contacts);

    const double bottom = of_bed.bottom, height = of_bed.height;
    BedProfiles  bed;
    bed.diameter = diameter;
    bed.cylinder = vessel.cylinder();
    if (vessel.is_straight())
      bed.section = vessel.cross_section(vessel.floor());
    bed.hydraulic_diameter = vessel.hydraulic_diameter();
    bed.bottom             = bottom;
    bed.height             = height;

    const auto slabs = planes_every(diameter / 4., bottom, height + diameter);
    const auto solid = BedObservables(particles, vessel, comm).solid_fractions(slabs);
    for (std::size_t k = 0; k < solid.size(); ++k)
      bed.axial.emplace_back(0.5 * (slabs[k] + slabs[k + 1]), 1. - solid[k]);
    if (vessel.is_tube())
      bed.radial = shell_void_fractions(particles,
                                        vessel.cylinder(),
                                        diameter / 20.,
                                        bottom + 0.25 * height,
                                        bottom + 0.75 * height,
                                        comm);
    bed.loads        = load_profile(particles,
                             vessel,
                             own,
                             planes_every(diameter / 2., bottom, height),
                             -dem.parameters().gravity()[2],
                             comm);
    bed.coordination = coordination_profile(
      particles, counts, planes_every(diameter, bottom, height + diameter), comm);
    bed.histogram            = coordination_histogram(counts, false, comm);
    bed.histogram_with_walls = coordination_histogram(counts, true, comm);
    return bed;
  }
} // namespace graupel
