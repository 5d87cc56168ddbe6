#include <graupel/dem/contact_laws.h>

#include <gtest/gtest.h>

namespace
{
  using namespace graupel;
  using Vector = dealii::Tensor<1, 3>;

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
    contact.normal  = Vector({1., 0., 0.});
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
    EXPECT_NEAR(-action.force[0], expected, 1e-12 * expected);
    EXPECT_EQ(action.force[1], 0.);
    EXPECT_NEAR(hertz_overlap(expected, m.young, radius / 2.), 2e-5, 1e-15);
  }

  // Mindlin: the tangential force grows by S_t = 8 G* sqrt(R* delta) per
  // displacement below the limit, against the displacement; formula, rounding.
  TEST(ContactLaws, MindlinSlope)
  {
    const auto m       = material(1., 10., 0.);
    auto       contact = touching(2e-5);
    contact.drift      = Vector({0., 0.01, 0.});
    Springs      springs;
    const auto   action = contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
    const double S_t    = 8. * m.shear * std::sqrt(radius / 2. * 2e-5);
    EXPECT_NEAR(action.force[1], -S_t * 0.01 * contact.step, 1e-12 * S_t * 1e-8);
    EXPECT_NEAR(springs.tangential[1], 1e-8, 1e-20);
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

    contact.drift  = Vector({0., 0.6, 0.8});
    double sliding = 0.;
    for (unsigned int k = 0; k < 200; ++k)
      {
        const auto action =
          contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
        sliding = std::hypot(action.force[1], action.force[2]);
        EXPECT_LE(sliding, 0.3 * F_n * (1. + 1e-12));
      }
    EXPECT_NEAR(sliding, 0.3 * F_n, 1e-12 * F_n);

    contact.drift     = -1e-2 * contact.drift;
    const auto action = contact_action<HertzMindlin, FreeRolling>(m, contact, springs);
    EXPECT_NEAR(std::hypot(action.force[1], action.force[2]),
                0.3 * F_n - S_t * 0.01 * contact.step,
                1e-10 * F_n);
  }

  // A spring follows the contact as it turns: it stays tangential and keeps its
  // length, for turns above and below the switch to the series. Rounding.
  TEST(ContactLaws, SpringTurnsWithThePlane)
  {
    for (const double angle : {1e-6, 1e-3, 2.9e-3, 3.5e-3, 0.1, 1.})
      {
        Vector       spring({0., 3e-6, 4e-6});
        const Vector n({std::cos(angle), std::sin(angle), 0.});
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

    contact.spin_drift = Vector({7., 2., 0.});
    auto action        = contact_action<HertzMindlin, SpringRolling>(m, contact, springs);
    EXPECT_NEAR(action.rolling_torque[1], -k_r * 2e-6, 1e-12 * limit);
    EXPECT_EQ(action.rolling_torque[0], 0.);
    for (unsigned int k = 0; k < 100000; ++k)
      action = contact_action<HertzMindlin, SpringRolling>(m, contact, springs);
    EXPECT_NEAR(action.rolling_torque[1], -limit, 1e-12 * limit);
  }

  // Constant torque: mu_r R* F_n against the rolling when fast; and a sphere
  // that rolls slowly comes to rest without ever turning back.
  TEST(ContactLaws, ConstantRollingTorque)
  {
    const auto   m       = material(1., 0.5, 0.1);
    auto         contact = touching(2e-5);
    const double F_n     = HertzMindlin::stiffness(m, contact).normal_force;
    Springs      springs;
    contact.spin_drift = Vector({0., 0., 1e4});
    const auto fast =
      contact_action<HertzMindlin, ConstantRollingTorque>(m, contact, springs);
    EXPECT_NEAR(fast.rolling_torque[2], -0.1 * radius / 2. * F_n, 1e-12 * F_n * radius);

    const double inertia = 0.4 * contact.mass * contact.radius * contact.radius;
    double       spin    = 1.;
    for (unsigned int k = 0; k < 200; ++k)
      {
        contact.spin_drift = Vector({0., 0., spin});
        const auto action =
          contact_action<HertzMindlin, ConstantRollingTorque>(m, contact, springs);
        spin += contact.step * action.rolling_torque[2] / inertia;
        EXPECT_GE(spin, 0.);
      }
    EXPECT_LE(spin, 1e-12);
  }

  // pi R sqrt(rho/G) / (0.1631 nu + 0.8766) for glass-like numbers, by hand:
  // G = 1e7/2.66 Pa, sqrt(2700/G) = 0.0267993 s/m, times pi 1.6e-3 / 0.930423.
  TEST(ContactLaws, RayleighTime)
  {
    EXPECT_NEAR(rayleigh_time(1.6e-3, 2700., {1e7, 0.33}), 1.44781e-4, 1e-9);
  }
} // namespace
