#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/numbers/exact_sum.h>

#include <deal.II/base/numbers.h>

namespace graupel
{
  double
  sphere_volume_below(const double radius, const double height)
  {
    const double h = std::clamp(height, 0., 2. * radius);
    return dealii::numbers::PI / 3. * h * h * (3. * radius - h);
  }

  BedObservables::BedObservables(const ParticleArrays &particles,
                                 const Cylinder       &cylinder,
                                 MPI_Comm              communicator)
    : particles(particles)
    , cylinder(cylinder)
    , communicator(communicator)
  {
  }

  double
  BedObservables::largest_radius() const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      largest = std::max(largest, particles.body[i].radius);
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  std::vector<double>
  BedObservables::solid_volume_below(const std::vector<double> &planes) const
  {
    const ExactSum        zero(sphere_volume(largest_radius()));
    std::vector<ExactSum> sums(planes.size(), zero);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const double r      = particles.body[i].radius,
                     lowest = particles.body[i].position[2] - r;
        for (std::size_t k = 0; k < planes.size(); ++k)
          if (planes[k] > lowest)
            sums[k].add(sphere_volume_below(r, planes[k] - lowest));
      }
    return ExactSum::totals(sums, communicator);
  }

  double
  BedObservables::solid_volume_between(const double lower, const double upper) const
  {
    const auto below = solid_volume_below({lower, upper});
    return below[1] - below[0];
  }

  std::vector<double>
  BedObservables::solid_fractions(const std::vector<double> &planes) const
  {
    const auto          below = solid_volume_below(planes);
    std::vector<double> fractions;
    for (std::size_t k = 0; k + 1 < planes.size(); ++k)
      fractions.push_back((below[k + 1] - below[k]) /
                          (cylinder.cross_section() * (planes[k + 1] - planes[k])));
    return fractions;
  }

  double
  BedObservables::slab_fraction(const double middle, const double slab) const
  {
    return solid_fractions({middle - slab / 2., middle + slab / 2.})[0];
  }

  double
  BedObservables::top_of_bed(const double start,
                             const double threshold,
                             const double slab,
                             const double end) const
  {
    // The slab's fraction is continuous in its place, so bisection finds where
    // it falls through the threshold once a step has bracketed that.
    const double step    = slab / 8.;
    const auto   n_steps = static_cast<unsigned int>((end + slab - start) / step) + 2;
    std::vector<double> planes;
    for (unsigned int k = 0; k < n_steps + 8; ++k)
      planes.push_back(start - slab / 2. + k * step);
    const auto below = solid_volume_below(planes);

    const double least = threshold * cylinder.cross_section() * slab;
    unsigned int k     = 0;
    while (k + 1 < n_steps && below[k + 8] - below[k] >= least)
      ++k;
    if (k == 0)
      return start;

    double low = start + (k - 1) * step, high = start + k * step;
    while (high - low > 1e-7 * slab)
      {
        const double middle                                     = 0.5 * (low + high);
        (slab_fraction(middle, slab) >= threshold ? low : high) = middle;
      }
    return 0.5 * (low + high);
  }

  BedObservables::Bed
  BedObservables::bed() const
  {
    Bed          bed;
    const double slab  = 2. * largest_radius();
    const double total = solid_volume_between(-slab, cylinder.height + slab);
    if (!(total > 0.))
      return bed;

    // Start where all the solid would reach as a bed of usual density.
    const double area = cylinder.cross_section();
    bed.height        = total / (0.6 * area);
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const double h          = bed.height;
        bed.bulk_solid_fraction = solid_fractions({0.25 * h, 0.75 * h})[0];
        if (!(bed.bulk_solid_fraction > 0.))
          return Bed();
        bed.height =
          top_of_bed(0.5 * h, 0.5 * bed.bulk_solid_fraction, slab, cylinder.height);
        if (std::abs(bed.height - h) < 1e-6 * slab)
          break;
      }
    bed.mean_void_fraction = 1. - total / (area * bed.height);
    return bed;
  }
} // namespace graupel
