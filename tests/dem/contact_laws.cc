// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/laws/contact_laws.h>

#include <gtest/gtest.h>

namespace
{
  using namespace graupel;
  using Vector  = Triple<double>;
  using Contact = graupel::Contact<double>;
  using Springs = graupel::Springs<double>;

  constexpr double young = 1e7, poisson = 0.33, radius = 1e-3, mass = 1.2e-5;

  PairMaterial
  material(const double restitution, const double friction, const double rolling)
  {
    return PairMaterial({young, poisson},
                        {young, poisson},
                        {restitution, friction, rolling},
                        1000.,
                        2. / 7.);
  }

  // Two equal spheres, the normal along x.
  Contact
  touching(const double overlap)
  {
    Contact contact;
    contact.normal  = Vector{1., 0., 0.};
    contact.overlap = overlap;
    contact.radius  = radius / 2.;
    contact.mass    = mass / 2.;
    contact.step    = 1e-6;
    return contact;
  }

  // A normal impact integrated far below the accuracy that is tested.
  template <class Law>
  double
  returned_fraction(const PairMaterial &pair)
  {
    const double start = 0.5, dt = 2e-9;
    double       overlap = 0., approach = start;
    do
      {
        Contact contact  = touching(std::max(overlap + 0.5 * dt * approach, 1e-16));
        contact.velocity = approach * contact.normal;
        Springs    springs;
        const auto action = contact_action<Law, FreeRolling>(pair, contact, springs);
        overlap += dt * approach;
        approach += dt * (action.force * contact.normal) / contact.mass;
      }
    while (overlap > 0.);
    return -approach / start;
  }

  // Law: the speed after a central impact is e times that before. Limit 0.5 %
  // of the approach speed: the largest error of the explicit steps used here.
  TEST(ContactLaws, ReturnRestitution)
  {
    for (const double e : {0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 1.})
      {
        EXPECT_NEAR(returned_fraction<HertzMindlin>(material(e, 0., 0.)), e, 5e-3);
        EXPECT_NEAR(returned_fraction<LinearSpring>(material(e, 0., 0.)), e, 5e-3);
      }
  }

  // E* = E / (2 (1 - nu^2)) and G* = G / (2 (2 - nu)) for equal bodies; a rigid
  // partner doubles both. Exact formulas: limit rounding.
  TEST(ContactLaws, EffectiveModuli)
  {
    const double G = young / (2. * (1. + poisson));
    const auto   m = material(0.5, 0.5, 0.1);
    EXPECT_NEAR(m.young, young / (2. * (1. - poisson * poisson)), 1e-12 * young);
    EXPECT_NEAR(m.shear, G / (2. * (2. - poisson)), 1e-12 * young);
    const PairMaterial rigid({young, poisson}, {1e30, poisson}, {0.5, 0.5, 0.1}, 1., 1.);
    EXPECT_NEAR(rigid.young, 2. * m.young, 1e-9 * young);
  }

  // Hertz: F = 4/3 E* sqrt(R*) delta^(3/2), without motion; formula, rounding.
  TEST(ContactLaws, HertzForceAndItsInverse)
  {
    const auto   m       = material(0.5, 0.5, 0.1);
    const auto   contact = touching(2e-5);
    Springs      springs;
    const auto   action = contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
    const double expected =
      4. / 3. * m.young * std::sqrt(radius / 2.) * std::pow(2e-5, 1.5);
    EXPECT_NEAR(-action.force.x, expected, 1e-12 * expected);
    EXPECT_EQ(action.force.y, 0.);
    EXPECT_NEAR(hertz_overlap(expected, m.young, radius / 2.), 2e-5, 1e-15);
  }

  // Mindlin: the tangential force grows by S_t = 8 G* sqrt(R* delta) per
  // displacement below the limit, against the displacement; formula, rounding.
  TEST(ContactLaws, MindlinSlope)
  {
    const auto m       = material(1., 10., 0.);
    auto       contact = touching(2e-5);
    contact.drift      = Vector{0., 0.01, 0.};
    Springs      springs;
    const auto   action = contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
    const double S_t    = 8. * m.shear * std::sqrt(radius / 2. * 2e-5);
    EXPECT_NEAR(action.force.y, -S_t * 0.01 * contact.step, 1e-12 * S_t * 1e-8);
    EXPECT_NEAR(springs.tangential.y, 1e-8, 1e-20);
  }

  // Coulomb: |F_t| never exceeds mu F_n, equals it in sliding, and on reversal
  // the force unloads from there along Mindlin's slope (history lives through
  // sliding). Exact up to rounding.
  TEST(ContactLaws, CoulombLimitKeepsHistory)
  {
    const auto   m       = material(1., 0.3, 0.);
    auto         contact = touching(2e-5);
    const double F_n     = HertzMindlin::stiffness(m, contact).normal_force;
    const double S_t     = HertzMindlin::stiffness(m, contact).tangential;
    Springs      springs;

    contact.drift  = Vector{0., 0.6, 0.8};
    double sliding = 0.;
    for (unsigned int k = 0; k < 200; ++k)
      {
        const auto action =
          contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
        sliding = std::hypot(action.force.y, action.force.z);
        EXPECT_LE(sliding, 0.3 * F_n * (1. + 1e-12));
      }
    EXPECT_NEAR(sliding, 0.3 * F_n, 1e-12 * F_n);

    contact.drift     = -1e-2 * contact.drift;
    const auto action = contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
    EXPECT_NEAR(std::hypot(action.force.y, action.force.z),
                0.3 * F_n - S_t * 0.01 * contact.step,
                1e-10 * F_n);
  }

  // A spring follows the contact as it turns: it stays tangential and keeps its
  // length, for turns above and below the switch to the series. Rounding.
  TEST(ContactLaws, SpringTurnsWithThePlane)
  {
    for (const double angle : {1e-6, 1e-3, 2.9e-3, 3.5e-3, 0.1, 1.})
      {
        Vector       spring{0., 3e-6, 4e-6};
        const Vector n{std::cos(angle), std::sin(angle), 0.};
        turn_into_plane(spring, n);
        EXPECT_NEAR(spring.norm(), 5e-6, 5e-6 * 1e-14);
        EXPECT_NEAR(spring * n, 0., 5e-6 * 1e-14);
      }
  }

  // EPSD2: M = k_r theta with k_r = S_t R*^2 up to mu_r R* F_n; twisting about
  // the normal meets no resistance. Rounding.
  TEST(ContactLaws, RollingSpring)
  {
    const auto   m       = material(1., 0.5, 0.1);
    auto         contact = touching(2e-5);
    const auto   s       = HertzMindlin::stiffness(m, contact);
    const double k_r     = s.tangential * radius * radius / 4.;
    const double limit   = 0.1 * radius / 2. * s.normal_force;
    Springs      springs;

    contact.spin_drift = Vector{7., 2., 0.};
    auto action        = contact_action<HertzMindlin, SpringRolling>(m, contact, springs);
    EXPECT_NEAR(action.rolling_torque.y, -k_r * 2e-6, 1e-12 * limit);
    EXPECT_EQ(action.rolling_torque.x, 0.);
    for (unsigned int k = 0; k < 100000; ++k)
      action = contact_action<HertzMindlin, SpringRolling>(m, contact, springs);
    EXPECT_NEAR(action.rolling_torque.y, -limit, 1e-12 * limit);
  }

  // Constant torque: mu_r R* F_n against the rolling when fast; and a sphere
  // that rolls slowly comes to rest without ever turning back.
  TEST(ContactLaws, ConstantRollingTorque)
  {
    const auto   m       = material(1., 0.5, 0.1);
    auto         contact = touching(2e-5);
    const double F_n     = HertzMindlin::stiffness(m, contact).normal_force;
    Springs      springs;
    contact.spin_drift = Vector{0., 0., 1e4};
    const auto fast =
      contact_action<HertzMindlin, ConstantRollingTorque>(m, contact, springs);
    EXPECT_NEAR(fast.rolling_torque.z, -0.1 * radius / 2. * F_n, 1e-12 * F_n * radius);

    const double inertia = 0.4 * contact.mass * contact.radius * contact.radius;
    double       spin    = 1.;
    for (unsigned int k = 0; k < 200; ++k)
      {
        contact.spin_drift = Vector{0., 0., spin};
        const auto action =
          contact_action<HertzMindlin, ConstantRollingTorque>(m, contact, springs);
        spin += contact.step * action.rolling_torque.z / inertia;
        EXPECT_GE(spin, 0.);
      }
    EXPECT_LE(spin, 1e-12);
  }

  // The law for several contacts at a time is the law for one. Limit: products
  // and sums may be contracted differently here.
  TEST(ContactLaws, LanesEqualScalars)
  {
    const auto              m = material(0.5, 0.3, 0.1);
    graupel::Contact<Lanes> contacts;
    graupel::Springs<Lanes> memories;
    std::vector<Contact>    contact(n_lanes, touching(2e-5));
    std::vector<Springs>    springs(n_lanes);
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        contact[l].overlap       = 1e-5 * (l + 1.);
        contact[l].velocity      = Vector{0.01 * l, -0.2, 0.1};
        contact[l].drift         = Vector{0.02 * l, 0.3 * l, 0.1};
        contact[l].spin_drift    = Vector{1., 20. * l, -3.};
        springs[l].tangential    = Vector{1e-7, 2e-7 * l, -1e-7};
        springs[l].rolling       = Vector{0., 1e-4 * l, 1e-4};
        contacts.normal.x[l]     = 1.;
        contacts.overlap[l]      = contact[l].overlap;
        contacts.radius[l]       = contact[l].radius;
        contacts.mass[l]         = contact[l].mass;
        contacts.step[l]         = contact[l].step;
        contacts.velocity.x[l]   = contact[l].velocity.x;
        contacts.velocity.y[l]   = contact[l].velocity.y;
        contacts.velocity.z[l]   = contact[l].velocity.z;
        contacts.drift.x[l]      = contact[l].drift.x;
        contacts.drift.y[l]      = contact[l].drift.y;
        contacts.drift.z[l]      = contact[l].drift.z;
        contacts.spin_drift.x[l] = contact[l].spin_drift.x;
        contacts.spin_drift.y[l] = contact[l].spin_drift.y;
        contacts.spin_drift.z[l] = contact[l].spin_drift.z;
        memories.tangential.x[l] = springs[l].tangential.x;
        memories.tangential.y[l] = springs[l].tangential.y;
        memories.tangential.z[l] = springs[l].tangential.z;
        memories.rolling.x[l]    = springs[l].rolling.x;
        memories.rolling.y[l]    = springs[l].rolling.y;
        memories.rolling.z[l]    = springs[l].rolling.z;
      }
    const auto actions =
      contact_action<HertzMindlin, SpringRolling>(m, contacts, memories);
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        const auto action =
          contact_action<HertzMindlin, SpringRolling>(m, contact[l], springs[l]);
        const double F = action.force.norm();
        EXPECT_NEAR(actions.force.x[l], action.force.x, 1e-13 * F);
        EXPECT_NEAR(actions.force.y[l], action.force.y, 1e-13 * F);
        EXPECT_NEAR(
          actions.rolling_torque.y[l], action.rolling_torque.y, 1e-13 * F * radius);
        EXPECT_NEAR(memories.tangential.y[l], springs[l].tangential.y, 1e-18);
        EXPECT_NEAR(memories.rolling.y[l], springs[l].rolling.y, 1e-15);
      }
  }

  // pi R sqrt(rho/G) / (0.1631 nu + 0.8766) for glass-like numbers, by hand:
  // G = 1e7/2.66 Pa, sqrt(2700/G) = 0.0267993 s/m, times pi 1.6e-3 / 0.930423.
  TEST(ContactLaws, RayleighTime)
  {
    EXPECT_NEAR(rayleigh_time(1.6e-3, 2700., {1e7, 0.33}), 1.44781e-4, 1e-9);
  }
} // namespace
