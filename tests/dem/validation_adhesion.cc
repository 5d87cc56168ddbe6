// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "validation_vessel.h"

// Adhesion (JKR) against its closed forms, on the bare law of two spheres.
// Sources: Johnson, Kendall, Roberts (1971), doi:10.1098/rspa.1971.0141; impact:
// Thornton, Ning (1998), doi:10.1016/S0032-5910(98)00099-0.
namespace
{
  using namespace graupel;
  using dealii::numbers::PI;

  constexpr double w = 0.05, R = 5e-4, mass = 5.7e-6;

  PairMaterial
  pair(const double adhesion)
  {
    const Elasticity elastic{1e7, 0.33};
    return {elastic, elastic, Surface{1., 0., 0., adhesion}, 1000., 0.3};
  }

  // Normal force at an overlap and an approach speed, pressing positive.
  template <class Law>
  double
  normal_force(const PairMaterial &material, const double overlap)
  {
    Contact<double> contact;
    contact.normal  = {0., 0., 1.};
    contact.overlap = overlap;
    contact.radius  = R;
    contact.mass    = mass;
    contact.step    = 0.;
    Springs<double> springs{};
    return -contact_action<Law, FreeRolling>(material, contact, springs).force.z;
  }

  double
  jkr(const double overlap)
  {
    return normal_force<Jkr>(pair(w), overlap);
  }

  // Laws: the strongest pull is 3/2 pi w R*; a contact that begins, at overlap 0,
  // pulls with 4/3 pi w R*; one that ends, at -3 a_c^2 / R*, with 5/6 of pi w R*; the
  // force is zero at the overlap a^2 / (3 R*), a^3 = 9 pi w R*^2 / (2 E*); force and
  // overlap belong to one a. Limits: rounding; 0.1 % at the end, a double root, which
  // twelve of Newton's steps approach by halves; 1e-6 from 1.2 a_c on.
  TEST(ValidationAdhesion, ForcesInClosedForm)
  {
    const PairMaterial material = pair(w);
    const double       E = material.young, unit = PI * w * R;
    const double       a_c = std::cbrt(PI * w * R * R / (8. * E));
    const double       end = -3. * a_c * a_c / R;
    expect_near("end of contact [m]",
                Jkr::release_overlap(material, R),
                end,
                1e-12 * std::abs(end));

    double strongest = 0.;
    for (unsigned int k = 0; k <= 10000; ++k)
      strongest = std::min(strongest, jkr(end * (1. - 1e-9) * k / 10000.));
    expect_near("strongest pull over pi w R", strongest / unit, -1.5, 1e-6);
    expect_near("pull at the begin", jkr(0.) / unit, -4. / 3., 1e-12);
    expect_near("pull at the end", jkr(end * (1. - 1e-12)) / unit, -5. / 6., 1e-3);

    double error = 0.;
    for (double a = 1.2 * a_c; a < 40. * a_c; a *= 1.05)
      {
        const double overlap = a * a / R - std::sqrt(2. * PI * w * a / E);
        const double force =
          4. / 3. * E * a * a * a / R - std::sqrt(8. * PI * w * E * a * a * a);
        error = std::max(error, std::abs(jkr(overlap) - force));
      }
    expect_near("largest error of the force over pi w R", error / unit, 0., 1e-6);

    const double a_0 = std::cbrt(4.5 * PI * w * R * R / E);
    expect_near("force at rest over pi w R", jkr(a_0 * a_0 / (3. * R)) / unit, 0., 1e-11);
  }

  // Law: without adhesion the force is Hertz's; the terms with the root of w cancel at a
  // given overlap, so that for little of it the difference falls with w itself.
  TEST(ValidationAdhesion, LimitIsHertz)
  {
    const double overlap = 1e-5, hertz = normal_force<HertzMindlin>(pair(0.), overlap);
    expect_near("without adhesion over Hertz",
                normal_force<Jkr>(pair(0.), overlap) / hertz,
                1.,
                1e-13);
    const auto lack = [&](const double adhesion) {
      return 1. - normal_force<Jkr>(pair(adhesion), overlap) / hertz;
    };
    expect_near("lack of force over that with a hundredth of w",
                lack(1e-6) / lack(1e-8),
                100.,
                0.5);
  }

  // Two spheres under adhesion and a constant force, by velocity Verlet: begins at
  // @p start, ends where the contact does or, held, after tens of periods. Returns
  // whether it ended, and the relative speed with which they part.
  struct Outcome
  {
    bool   parted;
    double speed;
  };

  Outcome
  meet(const PairMaterial &material,
       const double        start,
       const double        v,
       const double        pull)
  {
    const double end = Jkr::release_overlap(material, R);
    const double dt  = 2e-8;
    double       x = start, u = v;
    double       force = normal_force<Jkr>(material, x) + pull;
    for (unsigned int k = 0; k < 400000; ++k)
      {
        u -= 0.5 * dt * force / mass;
        x += dt * u;
        if (x <= end)
          return {true, u};
        force = normal_force<Jkr>(material, x) + pull;
        u -= 0.5 * dt * force / mass;
      }
    return {false, 0.};
  }

  // Law: an impact loses the work 7.09 (w^5 R*^4 / E*^2)^(1/3) of parting: slower
  // spheres stick, faster ones part with what is left. Limits 0.2 % of the
  // critical speed: the digits of 7.09.
  TEST(ValidationAdhesion, ImpactSticksBelowTheCriticalSpeed)
  {
    const PairMaterial material = pair(w);
    const double       work =
      7.09 * std::cbrt(std::pow(w, 5) * std::pow(R, 4) / std::pow(material.young, 2));
    const double critical = std::sqrt(2. * work / mass);
    title("  critical speed [m/s] " + std::to_string(critical));
    EXPECT_FALSE(meet(material, 0., 0.997 * critical, 0.).parted);
    for (const double over : {1.05, 1.5, 3.})
      {
        const Outcome outcome = meet(material, 0., over * critical, 0.);
        EXPECT_TRUE(outcome.parted);
        expect_near("speed after over critical, before " + std::to_string(over),
                    -outcome.speed / critical,
                    std::sqrt(over * over - 1.),
                    2e-3 / std::sqrt(over * over - 1.));
      }
  }

  // Law: spheres pulled apart slowly part above 3/2 pi w R*, not below. They start at
  // rest under 99 % of this force, where it is in balance, with 0.5 % more or less.
  TEST(ValidationAdhesion, PullOff)
  {
    const PairMaterial material = pair(w);
    const double       limit    = 1.5 * PI * w * R;
    double             lower = 0.95 * Jkr::release_overlap(material, R), upper = 1e-5;
    double             weakest = lower;
    for (unsigned int k = 0; k < 10000; ++k)
      {
        const double x = lower + (upper - lower) * k / 10000.;
        if (jkr(x) < jkr(weakest))
          weakest = x;
      }
    lower = weakest;
    for (unsigned int k = 0; k < 100; ++k)
      {
        const double middle                           = 0.5 * (lower + upper);
        (jkr(middle) < -0.99 * limit ? lower : upper) = middle;
      }
    EXPECT_FALSE(meet(material, upper, 0., 0.992 * limit).parted);
    EXPECT_TRUE(meet(material, upper, 0., 1.005 * limit).parted);
  }
} // namespace
