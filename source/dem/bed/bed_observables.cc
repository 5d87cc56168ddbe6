// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/bed_observables.h>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    // Of a bed that has not been looked at.
    constexpr double usual_solid_fraction = 0.6;
    // A bed with more than this part of its solid below it stands on the floor.
    constexpr double loose_part = 0.05;
    // The densest packing of equal spheres; nothing random comes near.
    constexpr double least_void_fraction = 0.26;
    // Levels that a slab of one diameter spans.
    constexpr unsigned int levels_of_slab = 8;
    // Parts of the bed's solid fraction at which a level is none of it, and all of it.
    constexpr double no_bed = 0.25, all_bed = 0.75;
  } // namespace

  // The solid below levels a slab's eighth apart, from a slab below the floor on.
  struct BedObservables::Profile
  {
    const SolidBelow   &exact;
    double              slab, first, step;
    std::vector<double> below;

    double
    total() const
    {
      return below.back();
    }

    double
    level(const std::size_t k) const
    {
      return first + k * step;
    }

    // Linear between the levels.
    double
    below_at(const double z) const
    {
      const double place = std::clamp((z - first) / step, 0., below.size() - 1.);
      const auto   k     = std::min<std::size_t>(place, below.size() - 2);
      return below[k] + (place - k) * (below[k + 1] - below[k]);
    }

    // Below which there is this part of the solid.
    double
    quantile(const double part) const
    {
      const double wanted = part * total();
      const auto   k      = std::max<std::ptrdiff_t>(
        1, std::lower_bound(below.begin(), below.end(), wanted) - below.begin());
      return level(k - 1) + step * (wanted - below[k - 1]) / (below[k] - below[k - 1]);
    }
  };

  BedObservables::BedObservables(const ParticleArrays &particles,
                                 const Vessel         &vessel,
                                 MPI_Comm              communicator)
    : particles(particles)
    , vessel(vessel)
    , communicator(communicator)
  {
  }

  double
  BedObservables::solid_volume_between(const double lower, const double upper) const
  {
    return SolidBelow(particles, communicator).between(lower, upper);
  }

  double
  BedObservables::center_of_mass() const
  {
    double heaviest = 0., highest = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        heaviest = std::max(heaviest, particles.mass[i]);
        highest  = std::max(highest, std::abs(particles.body[i].position[2]));
      }
    heaviest = dealii::Utilities::MPI::max(heaviest, communicator);
    highest  = dealii::Utilities::MPI::max(highest, communicator);
    ExactSum mass(heaviest), moment(heaviest * highest);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        mass.add(particles.mass[i]);
        moment.add(particles.mass[i] * particles.body[i].position[2]);
      }
    const auto totals = ExactSum::totals({mass, moment}, communicator);
    return totals[1] / totals[0];
  }

  std::vector<double>
  BedObservables::solid_fractions(const std::vector<double> &planes) const
  {
    const auto          below = SolidBelow(particles, communicator).at(planes);
    std::vector<double> fractions;
    for (std::size_t k = 0; k + 1 < planes.size(); ++k)
      {
        const double space = vessel.volume(planes[k], planes[k + 1]);
        fractions.push_back(space > 0. ? (below[k + 1] - below[k]) / space : 0.);
      }
    return fractions;
  }

  double
  BedObservables::area_near(const double z) const
  {
    return vessel.cross_section(std::clamp(z, vessel.floor(), vessel.ceiling()));
  }

  double
  BedObservables::slab_fraction(const Profile &solid, const double middle) const
  {
    const double half = solid.slab / 2.;
    return solid.exact.between(middle - half, middle + half) /
           (area_near(middle) * solid.slab);
  }

  double
  BedObservables::fraction_at_level(const Profile &solid, const std::size_t k) const
  {
    constexpr unsigned int half = levels_of_slab / 2;
    return (solid.below[k + half] - solid.below[k - half]) /
           (area_near(solid.level(k)) * solid.slab);
  }

  double
  BedObservables::edge_of_bed(const Profile &solid,
                              const double   start,
                              const double   threshold,
                              const bool     upwards) const
  {
    constexpr std::ptrdiff_t half  = levels_of_slab / 2;
    const double             place = (start - solid.first) / solid.step;
    const std::ptrdiff_t     way   = upwards ? 1 : -1;
    const auto               begin =
      static_cast<std::ptrdiff_t>(upwards ? std::ceil(place) : std::floor(place));
    const auto beyond = [&](const std::ptrdiff_t k) {
      return upwards ? solid.total() - solid.below[k] : solid.below[k];
    };
    const auto           n    = static_cast<std::ptrdiff_t>(solid.below.size());
    std::ptrdiff_t       last = begin - way; // that is bed
    const std::ptrdiff_t none = last;
    for (std::ptrdiff_t k = begin; k >= half && k + half < n; k += way)
      if (fraction_at_level(solid, k) >= threshold)
        last = k;
      else if (beyond(k) < loose_part * solid.total())
        break;
    if (last == none && slab_fraction(solid, start) < threshold)
      return start;
    return edge_between(solid,
                        last == none ? start : solid.level(last),
                        solid.level(last + way),
                        threshold);
  }

  // The slab's fraction is continuous in its place, so bisection finds where it falls
  // through the threshold.
  double
  BedObservables::edge_between(const Profile &solid,
                               double         bed,
                               double         beyond,
                               const double   threshold) const
  {
    while (std::abs(beyond - bed) > 1e-7 * solid.slab)
      {
        const double middle                                        = 0.5 * (bed + beyond);
        (slab_fraction(solid, middle) >= threshold ? bed : beyond) = middle;
      }
    return 0.5 * (bed + beyond);
  }

  BedObservables::Profile
  BedObservables::profile(const SolidBelow &exact) const
  {
    const double slab = 2. * exact.largest_radius();
    Profile      result{exact, slab, vessel.floor() - slab, slab / levels_of_slab, {}};
    const auto   n = 2 + static_cast<unsigned int>(
                         (vessel.ceiling() + slab - result.first) / result.step);
    std::vector<double> planes;
    for (unsigned int k = 0; k < n; ++k)
      planes.push_back(result.level(k));
    result.below       = exact.at(planes);
    const double under = result.below.front();
    for (double &volume : result.below)
      volume -= under;
    return result;
  }

  // False if the middle half is empty.
  bool
  BedObservables::measure_middle(const Profile &solid, Bed &bed) const
  {
    const double h     = bed.top - bed.bottom;
    const double lower = bed.bottom + 0.25 * h, upper = bed.bottom + 0.75 * h;
    const double space      = vessel.volume(lower, upper);
    bed.bulk_solid_fraction = space > 0. ? solid.exact.between(lower, upper) / space : 0.;
    return bed.bulk_solid_fraction > 0.;
  }

  BedObservables::Bed
  BedObservables::standing_bed(const Profile &solid) const
  {
    // Start where all the solid would reach as a bed of usual density.
    Bed bed;
    bed.bottom = vessel.floor();
    bed.height = vessel.depth_of(solid.total(), usual_solid_fraction);
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const double h = bed.height;
        bed.top        = bed.bottom + h;
        if (!measure_middle(solid, bed))
          return Bed();
        bed.top =
          edge_of_bed(solid, bed.bottom + 0.5 * h, 0.5 * bed.bulk_solid_fraction, true);
        bed.height = bed.top - bed.bottom;
        if (std::abs(bed.height - h) < 1e-6 * solid.slab)
          break;
      }
    return bed;
  }

  // Whether there is next to nothing below the middle of the solid, once the solid
  // fraction has fallen to half.
  bool
  BedObservables::hangs(const Profile &solid) const
  {
    constexpr unsigned int half  = levels_of_slab / 2;
    const double           lower = solid.quantile(0.25), upper = solid.quantile(0.75);
    const double           space = vessel.volume(lower, upper);
    if (!(space > 0.))
      return false;
    const double threshold = 0.5 * 0.5 * solid.total() / space;
    const auto   middle =
      static_cast<std::size_t>((solid.quantile(0.5) - solid.first) / solid.step);
    for (std::size_t k = middle; k >= levels_of_slab + half; --k)
      if (k + half < solid.below.size() && fraction_at_level(solid, k) < threshold)
        return solid.below[k] < loose_part * solid.total();
    return false;
  }

  BedObservables::Bed
  BedObservables::hanging_bed(const Profile &solid) const
  {
    const double middle = solid.quantile(0.5);
    Bed          bed;
    bed.bottom = solid.quantile(0.25);
    bed.top    = solid.quantile(0.75);
    // Twice as high as the middle half.
    const double margin = 0.5 * (bed.top - bed.bottom);
    bed.bottom -= margin;
    bed.top += margin;
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const double before = bed.top - bed.bottom;
        if (!measure_middle(solid, bed))
          return Bed();
        const double threshold = 0.5 * bed.bulk_solid_fraction;
        bed.bottom             = edge_of_bed(solid, middle, threshold, false);
        bed.top                = edge_of_bed(solid, middle, threshold, true);
        if (std::abs(bed.top - bed.bottom - before) < 1e-6 * solid.slab)
          break;
      }
    if (bed.top > vessel.ceiling() - 0.5 * solid.slab)
      bed.top = vessel.ceiling();
    return bed;
  }

  double
  BedObservables::expanded_height(const Profile &solid) const
  {
    const double        floor = vessel.floor(), ceiling = vessel.ceiling();
    std::vector<double> levels;
    for (unsigned int k = 0; floor + k * solid.step < ceiling; ++k)
      levels.push_back(floor + k * solid.step);
    levels.push_back(ceiling);

    // Of the slabs around the levels, as far as they lie in the vessel.
    std::vector<double> fractions;
    double              weighted = 0., weight = 0.;
    for (const double z : levels)
      {
        const double lower = z - 0.5 * solid.slab, upper = z + 0.5 * solid.slab;
        const double space  = vessel.volume(lower, upper);
        const double volume = solid.below_at(upper) - solid.below_at(lower);
        fractions.push_back(space > 0. ? volume / space : 0.);
        weighted += volume * fractions.back();
        weight += volume;
      }
    if (!(weighted > 0.))
      return 0.;

    const auto part_of_bed = [&](const std::size_t k) {
      const double relative = fractions[k] * weight / weighted;
      const double below    = solid.below_at(levels[k]) / solid.total();
      return std::max(std::clamp((relative - no_bed) / (all_bed - no_bed), 0., 1.),
                      2. * std::min(below, 1. - below));
    };
    double height = 0.;
    for (std::size_t k = 0; k + 1 < levels.size(); ++k)
      height += 0.5 * (levels[k + 1] - levels[k]) * (part_of_bed(k) + part_of_bed(k + 1));
    return height;
  }

  BedObservables::Bed
  BedObservables::bed() const
  {
    const SolidBelow exact(particles, communicator);
    const double     slab = 2. * exact.largest_radius();
    if (!(slab > 0.) || !(vessel.volume(vessel.floor(), vessel.ceiling()) > 0.))
      return Bed();
    const Profile solid = profile(exact);
    if (!(solid.total() > 0.))
      return Bed();
    Bed bed            = hangs(solid) ? hanging_bed(solid) : standing_bed(solid);
    bed.height         = bed.top - bed.bottom;
    const double space = vessel.volume(bed.bottom, bed.top);
    if (!(bed.height >= slab && space > 0.))
      return Bed();
    bed.mean_void_fraction =
      1. - exact.between(bed.bottom - slab, bed.top + slab) / space;
    bed.exists = bed.mean_void_fraction >= least_void_fraction;
    if (!bed.exists)
      return Bed();
    bed.expanded_height = expanded_height(solid);
    return bed;
  }
} // namespace graupel
