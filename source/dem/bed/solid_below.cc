// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/solid_below.h>

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace graupel
{
  double
  sphere_volume_below(const double radius, const double height)
  {
    const double h = std::clamp(height, 0., 2. * radius);
    return dealii::numbers::PI / 3. * h * h * (3. * radius - h);
  }

  SolidBelow::SolidBelow(const ParticleArrays &particles, MPI_Comm communicator)
    : communicator(communicator)
  {
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const Body &body = particles.body[i];
        spheres.push_back({body.position[2] - body.radius, body.radius});
        largest = std::max(largest, body.radius);
      }
    largest = dealii::Utilities::MPI::max(largest, communicator);
    std::sort(spheres.begin(), spheres.end(), [](const Sphere &a, const Sphere &b) {
      return a.lowest < b.lowest;
    });
    before.push_back(ExactSum(sphere_volume(largest)));
    for (const Sphere &sphere : spheres)
      {
        before.push_back(before.back());
        before.back().add(sphere_volume_below(sphere.radius, 2. * sphere.radius));
      }
  }

  ExactSum
  SolidBelow::below(const double plane) const
  {
    const auto first_above = [&](const double height) {
      return std::upper_bound(
               spheres.begin(),
               spheres.end(),
               height,
               [](const double z, const Sphere &sphere) { return z < sphere.lowest; }) -
             spheres.begin();
    };
    // Those before are whole, those from the other one on are not reached.
    const std::size_t first = first_above(plane - 2. * largest);
    const std::size_t last  = first_above(plane);
    ExactSum          sum   = before[first];
    for (std::size_t i = first; i < last; ++i)
      sum.add(sphere_volume_below(spheres[i].radius, plane - spheres[i].lowest));
    return sum;
  }

  std::vector<double>
  SolidBelow::at(const std::vector<double> &planes) const
  {
    std::vector<ExactSum> sums;
    for (const double plane : planes)
      sums.push_back(below(plane));
    return ExactSum::totals(sums, communicator);
  }

  double
  SolidBelow::between(const double lower, const double upper) const
  {
    const auto volumes = at({lower, upper});
    return volumes[1] - volumes[0];
  }
} // namespace graupel
