// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "validation_impact.h"

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;
  using Vector = dealii::Tensor<1, 3>;

  // Follows one contact, and compares it with Hertz's impact: at each substep force
  // and overlap by his law, overlap and speed by the energy; the largest of both, the
  // duration, the speed after.
  void
  follow_elastic_impact(ValidationVessel              &vessel,
                        const HertzImpact             &hertz,
                        const double                   stiffness,
                        const double                   v,
                        const std::function<double()> &approach)
  {
    auto        &dem   = vessel.dem;
    const double dt    = dem.substep();
    double       force = 0., overlap = 0., law_error = 0., energy_error = 0.;
    unsigned int touching = 0;
    for (unsigned int s = 0; s < 1.2 * fineness; ++s)
      {
        dem.advance(dt);
        double now[2] = {0., 0.};
        for (const auto &contact : dem.contact_states())
          {
            now[0] = contact.overlap;
            now[1] = contact.force.norm();
          }
        now[0] = dealii::Utilities::MPI::max(now[0], dem.communicator());
        now[1] = dealii::Utilities::MPI::max(now[1], dem.communicator());
        touching += now[0] > 0.;
        overlap   = std::max(overlap, now[0]);
        force     = std::max(force, now[1]);
        law_error = std::max(
          law_error, std::abs(now[1] - stiffness * std::pow(now[0], 1.5)) / hertz.force);
        const double u  = approach() / v;
        const double by = 1. - std::pow(now[0] / hertz.overlap, 2.5);
        energy_error    = std::max(energy_error, std::abs(u * u - by));
      }
    expect_near("largest force [N]", force, hertz.force, 1e-3 * hertz.force);
    expect_near("largest overlap [m]", overlap, hertz.overlap, 1e-3 * hertz.overlap);
    expect_near("duration [s]", touching * dt, hertz.duration, 2. * dt);
    expect_near("force over overlap, relative", law_error, 0., 1e-9);
    expect_near("energy over overlap, relative", energy_error, 0., 1e-3);
    expect_near("speed after [m/s]", approach(), -v, 1e-3 * v);
  }

  // Limits: 0.1 %, the time error with 400 substeps (second order, measured 1e-5);
  // the duration to the substep.
  TEST(ValidationImpact, Test1ElasticNormalOfTwoSpheres)
  {
    for (const Solid &solid : {glass, limestone})
      {
        const double      R = 0.01, v = 10.;
        DemParameters     p     = parameters(solid, R, 1., 0.35);
        const HertzImpact hertz = pair_impact(p, 2. * v);
        p.contact.substep       = hertz.duration / fineness;
        ValidationVessel vessel(p, 8. * R, 8. * R);
        vessel.dem.insert(
          {{Point<3>(-R, 0., 4. * R), R, Vector({v, 0., 0.})},
           {Point<3>(R * (1. + gap), 0., 4. * R), R, Vector({-v, 0., 0.})}});
        title(std::string("two spheres of ") + solid.name);
        const double k = 4. / 3. *
                         p.materials(false, vessel_walls({})).particles[0].young *
                         std::sqrt(R / 2.);
        follow_elastic_impact(vessel, hertz, k, 2. * v, [&]() {
          return vessel.body(0).velocity[0] - vessel.body(1).velocity[0];
        });
      }
  }

  TEST(ValidationImpact, Test2ElasticNormalOnAPlane)
  {
    for (const Solid &solid : {light_alloy, magnesium_alloy})
      {
        const double      R = 0.1, v = 0.2;
        DemParameters     p     = parameters(solid, R, 1., 0.);
        const HertzImpact hertz = plane_impact(p, v);
        p.contact.substep       = hertz.duration / fineness;
        ValidationVessel vessel(p, 8. * R, 8. * R);
        vessel.dem.insert({{Point<3>(0., 0., R * (1. + gap)), R, Vector({0., 0., -v})}});
        title(std::string("sphere of ") + solid.name);
        const double k =
          4. / 3. * p.materials(false, vessel_walls({})).walls[0].young * std::sqrt(R);
        follow_elastic_impact(
          vessel, hertz, k, v, [&]() { return -vessel.body(0).velocity[2]; });
      }
  }

  // Law: e returns. Limit 0.002: time error of a damper that sets in steeply, and of
  // the last substep, at 400 substeps.
  TEST(ValidationImpact, Test3Restitution)
  {
    for (const Solid &solid : {aluminium_oxide, cast_iron})
      for (const double e : {0.2, 0.4, 0.6, 0.8, 1.})
        {
          const double  R = 2.5e-3, v = 3.9;
          DemParameters p            = parameters(solid, R, e, 0.);
          const double  elastic_time = plane_impact(p, v).duration;
          p.contact.substep          = elastic_time / fineness;
          ValidationVessel vessel(p, 8. * R, 8. * R);
          vessel.dem.insert(
            {{Point<3>(0., 0., R * (1. + gap)), R, Vector({0., 0., -v})}});
          vessel.dem.advance(4. * elastic_time);
          expect_near(std::string(solid.name) + ", returned over approach speed",
                      vessel.body(0).velocity[2] / v,
                      e,
                      2e-3);
        }
  }

  // Laws: gross sliding, tan(angle) > 7/2 mu (1 + e): tangential restitution
  // 1 - mu (1 + e) / tan(angle), spin 5/2 mu (1 + e) v_n / R. Limits 0.5 %: the
  // overlap shortens the arm by 0.3 %. Sticking: the article's curves for aluminium
  // oxide, limits 2 % of their range.
  TEST(ValidationImpact, Test4ObliqueByAngle)
  {
    const double              R = 2.5e-3, v = 3.9, mu = 0.092, e = 0.98;
    const std::vector<double> angles = {5., 10., 20., 30., 40., 50., 60., 70., 80., 85.};
    const std::vector<double> article_restitution = {0.95, 0.69, 0.62, 0.68};
    const std::vector<double> article_spin        = {19., 213., 510., 616.};
    for (const Solid &solid : {aluminium_oxide, aluminium_alloy})
      {
        std::vector<double> normal, tangential, spin(angles.size(), 0.);
        for (const double angle : angles)
          {
            normal.push_back(v * std::cos(angle * PI / 180.));
            tangential.push_back(v * std::sin(angle * PI / 180.));
          }
        const auto after = after_impacts(
          parameters(solid, R, e, mu), normal.back(), normal, tangential, spin);
        for (unsigned int k = 0; k < angles.size(); ++k)
          {
            const std::string at = std::string(solid.name) + ", " +
                                   std::to_string(static_cast<int>(angles[k])) + " deg: ";
            const double e_t  = after[k].velocity[0] / tangential[k];
            const double turn = after[k].spin[1];
            const double J    = mu * (1. + e) * normal[k];
            if (angles[k] >= 40.)
              {
                expect_near(
                  at + "tangential restitution", e_t, 1. - J / tangential[k], 5e-3);
                expect_near(at + "spin [rad/s]", turn, 2.5 * J / R, 5e-3 * 2.5 * J / R);
                expect_near(at + "rebound angle [deg]",
                            std::atan(slip(after[k]) / after[k].velocity[2]) * 180. / PI,
                            std::atan((tangential[k] - 3.5 * J) / (e * normal[k])) *
                              180. / PI,
                            0.1);
              }
            else if (solid.density == aluminium_oxide.density)
              {
                expect_near(
                  at + "tangential restitution", e_t, article_restitution[k], 0.02);
                expect_near(at + "spin [rad/s]", turn, article_spin[k], 13.);
              }
          }
      }
  }

  // Constant normal speed, varied tangential speed u; all over mu v_n. Laws: in gross
  // sliding spin 5 and recoil u - 7, less what the overlap takes from the arm: limit
  // 1.5 of the largest overlap over R of that. Sticking: finite elements, quoted by the
  // article for steel; limit 7 % of the range, since a spring without partial slip
  // spins less than theirs. Below u = 1.5 it is no match for them (at u = 0.9 its spin
  // is 0.1, theirs 0.7), whether its force is stiffness times way or is added up in
  // steps; nothing is claimed there.
  TEST(ValidationImpact, Test5ObliqueByTangentialSpeed)
  {
    const double              R = 1e-5, v = 5., mu = 0.3;
    const std::vector<double> along           = {2., 3., 4., 5., 6., 7.5, 10., 20.};
    const std::vector<double> finite_elements = {1.94, 3.11, 4.11, 4.70, 4.95};
    for (const Solid &solid : {steel, polyethylene})
      {
        std::vector<double> normal(along.size(), v), tangential, spin(along.size(), 0.);
        for (const double u : along)
          tangential.push_back(u * mu * v);
        const DemParameters p     = parameters(solid, R, 1., mu);
        const auto          after = after_impacts(p, v, normal, tangential, spin);
        const double        arm   = 1.5 * plane_impact(p, v).overlap / R;
        for (unsigned int k = 0; k < along.size(); ++k)
          {
            const std::string at =
              std::string(solid.name) + ", u = " + std::to_string(along[k]) + ": ";
            const double turn   = R * after[k].spin[1] / (mu * v);
            const double recoil = slip(after[k]) / (mu * v);
            if (along[k] > 7.)
              {
                expect_near(at + "spin", turn, 5., 5. * arm);
                expect_near(at + "recoil", recoil, along[k] - 7., 5. * arm);
              }
            else if (solid.density == steel.density)
              expect_near(at + "spin", turn, finite_elements[k], 0.35);
          }
      }
  }
} // namespace
