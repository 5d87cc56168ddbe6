// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_dem_validation_impact_h
#define graupel_tests_dem_validation_impact_h

#include "validation_vessel.h"

// The eight impact tests of Chung, Ooi (2011), doi:10.1007/s10035-011-0277-0. Where
// spheres meet a plane it is the bottom of a vessel, 1e7 times as stiff. One run holds
// all impacts of a curve, side by side. References: Hertz's impact (Timoshenko, Goodier,
// Theory of Elasticity, sec. 142) and rigid bodies in gross sliding; where spheres
// stick, points of the article's curves. Materials, speeds and these points are not
// from the article itself but from where others rebuilt it, the tests of Yade, Kratos
// Multiphysics and PySPH.
namespace graupel
{
  struct Solid
  {
    const char *name;
    double      young, poisson, density;
  };

  inline const Solid glass{"glass", 4.8e10, 0.2, 2800.};
  inline const Solid limestone{"limestone", 2e10, 0.25, 2500.};
  inline const Solid light_alloy{"aluminium alloy", 7e10, 0.3, 2699.};
  inline const Solid magnesium_alloy{"magnesium alloy", 4e10, 0.35, 1800.};
  inline const Solid aluminium_oxide{"aluminium oxide", 3.8e11, 0.23, 4000.};
  inline const Solid cast_iron{"cast iron", 1e11, 0.25, 7000.};
  inline const Solid aluminium_alloy{"aluminium alloy", 7e10, 0.33, 2700.};
  inline const Solid steel{"steel", 2.08e11, 0.3, 7850.};
  inline const Solid polyethylene{"polyethylene", 1e9, 0.4, 1400.};
  inline const Solid copper{"copper", 1.2e11, 0.35, 8900.};

  // Hertz's elastic impact of two bodies with the approach speed v.
  struct HertzImpact
  {
    HertzImpact(const double young,
                const double radius,
                const double mass,
                const double v)
      : overlap(std::pow(15. * mass * v * v / (16. * young * std::sqrt(radius)), 0.4))
      , force(4. / 3. * young * std::sqrt(radius) * std::pow(overlap, 1.5))
      , duration(0.8 * std::sqrt(dealii::numbers::PI) * std::tgamma(0.4) /
                 std::tgamma(0.9) * overlap / v)
    {
    }

    double overlap, force, duration;
  };

  inline DemParameters
  parameters(const Solid &solid,
             const double radius,
             const double restitution,
             const double friction)
  {
    DemParameters p;
    p.particles.diameter          = 2. * radius;
    p.particles.density           = solid.density;
    p.particles.gravity           = 0.;
    p.contact.rolling_model       = "none";
    p.contact.particle_elasticity = {solid.young, solid.poisson};
    p.contact.wall_elasticity     = {1e7 * solid.young, solid.poisson};
    p.contact.particle_surface    = {restitution, friction, 0.};
    p.contact.wall_surface        = {restitution, friction, 0.};
    return p;
  }

  inline HertzImpact
  plane_impact(const DemParameters &p, const double v)
  {
    return {p.materials(false, vessel_walls({})).walls[0].young,
            p.particles.simulated_radius(),
            p.particles.simulated_mass(),
            v};
  }

  inline HertzImpact
  pair_impact(const DemParameters &p, const double v)
  {
    return {p.materials(false, vessel_walls({})).particles[0].young,
            p.particles.simulated_radius() / 2.,
            p.particles.simulated_mass() / 2.,
            v};
  }

  // Substeps in contact.
  constexpr double fineness = 400.;
  // Gap before the impact, over the radius.
  constexpr double gap = 1e-6;

  // Motion of a sphere's contact point along x, relative to the plane z = 0.
  inline double
  slip(const Body &body)
  {
    return body.velocity[0] - body.radius * body.spin[1];
  }

  // All impacts of a curve on the bottom at the same time; returns the motion after.
  inline std::vector<Body>
  after_impacts(DemParameters              p,
                const double               slowest,
                const std::vector<double> &normal,
                const std::vector<double> &tangential,
                const std::vector<double> &spin)
  {
    const double      R        = p.particles.simulated_radius();
    const double      fastest  = *std::max_element(normal.begin(), normal.end());
    const HertzImpact shortest = plane_impact(p, fastest);
    p.contact.substep          = shortest.duration / fineness;
    // They stand on the y axis, so that none meets another.
    const double             width = 4. * R * (normal.size() + 1);
    ValidationVessel         vessel(p, width, 0.5 * width);
    std::vector<NewParticle> spheres;
    for (unsigned int k = 0; k < normal.size(); ++k)
      spheres.push_back({dealii::Point<3>(0.,
                                          4. * R * (k + 0.5 - 0.5 * normal.size()),
                                          R * (1. + 0.01 * gap)),
                         R,
                         dealii::Tensor<1, 3>({tangential[k], 0., -normal[k]}),
                         dealii::Tensor<1, 3>({0., spin[k], 0.})});
    vessel.dem.insert(spheres);
    const double longest = 2. * plane_impact(p, slowest).duration;
    vessel.dem.advance(longest + 0.02 * gap * R / slowest);
    std::vector<Body> after;
    for (unsigned int k = 0; k < normal.size(); ++k)
      after.push_back(vessel.body(k));
    return after;
  }
} // namespace graupel

#endif
