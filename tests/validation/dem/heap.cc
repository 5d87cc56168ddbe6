// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "beds.h"

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;
  using Vector = dealii::Tensor<1, 3>;

  constexpr double d = 5e-3;

  // Angle of repose [deg] by Zhou et al.: 68.61 mu_pp^0.27 mu_pw^0.22 m_pp^0.06
  // m_pw^0.12 d^-0.2 with the lengths of rolling resistance m (here mu_r R*) and d in
  // mm. Source: Zhou, Xu, Yu, Zulli (2002), doi:10.1016/S0032-5910(01)00520-4.
  double
  zhou(const double mu, const double mu_r)
  {
    const double m_pp = 1e3 * mu_r * d / 4., m_pw = 1e3 * mu_r * d / 2.;
    return 68.61 * std::pow(mu, 0.49) * std::pow(m_pp, 0.06) * std::pow(m_pw, 0.12) *
           std::pow(1e3 * d, -0.2);
  }

  // Slope [deg] of the surface of a heap about the axis: the highest sphere of each of
  // twelve sectors in each ring of one diameter, mean over the sectors, fitted by a
  // line between the rings of 80 % and 20 % of the height.
  double
  slope(const Dem &dem)
  {
    constexpr unsigned int n_rings = 40, n_sectors = 12;
    std::vector<double>    top(n_rings * n_sectors, 0.);
    const auto            &p = dem.particles();
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const Point<3> &x    = p.body[i].position;
        const auto      ring = static_cast<unsigned int>(std::hypot(x[0], x[1]) / d);
        const auto      sector =
          static_cast<unsigned int>((std::atan2(x[1], x[0]) / PI + 1.) * 5.999);
        if (ring < n_rings)
          top[ring * n_sectors + sector] =
            std::max(top[ring * n_sectors + sector], x[2] + d / 2.);
      }
    std::vector<double> all(top.size());
    MPI_Allreduce(
      top.data(), all.data(), top.size(), MPI_DOUBLE, MPI_MAX, dem.communicator());
    std::vector<double> height(n_rings, 0.);
    for (unsigned int r = 0; r < n_rings; ++r)
      for (unsigned int s = 0; s < n_sectors; ++s)
        height[r] += all[r * n_sectors + s] / n_sectors;
    const double highest = *std::max_element(height.begin() + 1, height.end());
    double       n = 0., x = 0., y = 0., xx = 0., xy = 0.;
    for (unsigned int r = 1; r < n_rings; ++r)
      if (height[r] < 0.8 * highest && height[r] > 0.2 * highest)
        {
          const double at = (r + 0.5) * d;
          n += 1.;
          x += at;
          y += height[r];
          xx += at * at;
          xy += at * height[r];
        }
    return std::atan((x * y - n * xy) / (n * xx - x * x)) * 180. / PI;
  }

  // Highest sphere that does not fall [m].
  double
  top_of_heap(const Dem &dem)
  {
    double highest = 0.;
    for (unsigned int i = 0; i < dem.particles().n_owned; ++i)
      if (dem.particles().body[i].velocity[2] > -0.1)
        highest = std::max(highest, dem.particles().body[i].position[2]);
    return dealii::Utilities::MPI::max(highest, dem.communicator());
  }

  // Spheres dropped on the axis, a few at a time, from just above the heap, until it
  // is at rest.
  double
  angle_of_heap(const double mu_r)
  {
    DemParameters p;
    p.particles.diameter       = d;
    p.contact.particle_surface = {0.5, 0.5, mu_r};
    p.contact.wall_surface     = {0.5, 0.5, mu_r};
    ValidationVessel       vessel(p, 80. * d, 30. * d);
    constexpr unsigned int count = 3000, at_a_time = 5;
    unsigned int           seed   = 7;
    double                 height = 0.;
    const auto             next   = [&]() {
      seed = seed * 1664525u + 1013904223u;
      return seed / 4294967296.;
    };
    for (unsigned int n = 0; n < count; n += at_a_time)
      {
        height = std::max(height, top_of_heap(vessel.dem) + 4. * d);
        const double             turn = 2. * PI * next();
        std::vector<NewParticle> added;
        for (unsigned int k = 0; k < at_a_time; ++k)
          {
            const double angle = turn + 2. * PI * k / at_a_time;
            added.push_back(
              {Point<3>(1.2 * d * std::cos(angle), 1.2 * d * std::sin(angle), height),
               d / 2.,
               Vector({0., 0., -0.5})});
          }
        vessel.dem.insert(added);
        vessel.dem.advance(0.012);
      }
    vessel.dem.advance(2.);
    return slope(vessel.dem);
  }

  // Laws: a heap is the steeper the more its spheres resist rolling; with mu = 0.5 and
  // mu_r = 0.1 to 0.3 its slope is that of Zhou et al. within 5 degrees, the scatter of
  // their own data and of how a heap is formed.
  TEST(Heap, AngleOfRepose)
  {
    double before = 0.;
    for (const double mu_r : {0.02, 0.1, 0.3})
      {
        const double angle = angle_of_heap(mu_r);
        if (mu_r >= 0.1)
          expect_near("mu_r = " + std::to_string(mu_r) + ", angle of repose [deg]",
                      angle,
                      zhou(0.5, mu_r),
                      5.);
        else
          title("  mu_r = " + std::to_string(mu_r) + ", angle " + std::to_string(angle));
        EXPECT_GT(angle, before + 1.);
        before = angle;
      }
  }
} // namespace
