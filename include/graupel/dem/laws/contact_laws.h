// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_laws_contact_laws_h
#define graupel_dem_laws_contact_laws_h

#include <graupel/dem/numbers/lanes.h>
#include <graupel/dem/numbers/triple.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <variant>

/**
 * Laws of contact as functions of numbers: no mesh, no lists, two bodies. They are
 * templates over the type of a number: double, or Lanes of doubles for several
 * contacts at a time.
 *
 * Signs: the normal n points from the first body to the second. Velocities are
 * those of the first relative to the second, so u.n > 0 while they approach.
 * Force and rolling torque are those on the first body; the second receives
 * the opposite force and rolling torque.
 */
namespace graupel
{
  /** Elasticity of one body: Young's modulus [Pa] and Poisson's ratio [-]. */
  struct Elasticity
  {
    double young_modulus;
    double poisson_ratio;
  };

  /** What a pair of materials does in contact, given by the user. */
  struct Surface
  {
    /** Coefficient of restitution e [-], 0 < e <= 1. */
    double restitution;
    /** Coefficient of Coulomb friction mu [-]. */
    double friction;
    /** Coefficient of rolling resistance mu_r [-]. */
    double rolling_resistance;
    /** Work of adhesion w, twice the surface energy of equal bodies [J/m^2]. */
    double adhesion = 0.;
  };

  /** Numbers of one kind of contact that do not change from pair to pair. */
  struct PairMaterial
  {
    /** E*, 1/E* = (1-nu_1^2)/E_1 + (1-nu_2^2)/E_2 [Pa]. */
    double young;
    /** G*, 1/G* = 2(2-nu_1)(1+nu_1)/E_1 + 2(2-nu_2)(1+nu_2)/E_2 [Pa]. */
    double shear;
    /** Damping ratio beta = -ln e / sqrt(ln^2 e + pi^2) [-]. */
    double damping;
    /** Normal stiffness of the linear law [N/m]. */
    double normal_stiffness;
    /** Tangential over normal stiffness of the linear law [-]. */
    double stiffness_ratio;
    /** Tangential over normal damping, sqrt(S_t/S_n), of either law [-]. */
    double mindlin_damping_ratio;
    double linear_damping_ratio;
    /** See Surface. */
    double friction;
    double rolling_resistance;
    double adhesion;

    PairMaterial(const Elasticity &first,
                 const Elasticity &second,
                 const Surface    &surface,
                 const double      normal_stiffness,
                 const double      stiffness_ratio);
  };

  /** Geometry and motion of two touching bodies. */
  template <class Real>
  struct Contact
  {
    /** Unit normal from the first body to the second. */
    Triple<Real> normal;
    /** Overlap delta [m]; negative where adhesion holds separated bodies. */
    Real overlap;
    /** R* = R_1 R_2 / (R_1 + R_2); for a wall the radius of the sphere [m]. */
    Real radius;
    /** m* = m_1 m_2 / (m_1 + m_2); for a wall the mass of the sphere [kg]. */
    Real mass;
    /** Relative velocity of the surfaces at the contact point [m/s]. */
    Triple<Real> velocity;
    /** The same, but the mean over the substep that led here [m/s]. */
    Triple<Real> drift;
    /** Relative angular velocity, mean over the substep that led here [rad/s]. */
    Triple<Real> spin_drift;
    /** Length of that substep, or of its part in contact [s]. */
    Real step;
  };

  /** The memory of a contact: what it carries from substep to substep. */
  template <class Real>
  struct Springs
  {
    /** Tangential displacement [m]. */
    Triple<Real> tangential;
    /** Rolling angle [rad]. */
    Triple<Real> rolling;
  };

  /** What a contact does to the first body. */
  template <class Real>
  struct ContactAction
  {
    /** Force [N]. */
    Triple<Real> force;
    /** Torque of the rolling resistance, without that of the force [N m]. */
    Triple<Real> rolling_torque;
  };

  /** Stiffness and damping of a contact at its present overlap. */
  template <class Real>
  struct Stiffness
  {
    /** Elastic (and adhesive) normal force [N]. */
    Real normal_force;
    /** Normal damping [N s/m]. */
    Real normal_damping;
    /** Tangential stiffness [N/m]. */
    Real tangential;
    /** Tangential damping [N s/m]. */
    Real tangential_damping;
    /** What adhesion adds to the normal force in the limits of friction [N]. */
    Real holding_force;
  };

  /**
   * Hertz's normal force, Mindlin's tangential stiffness (no slip):
   *
   *   F_n = 4/3 E* sqrt(R* delta) delta,    S_n = 2 E* sqrt(R* delta),
   *   S_t = 8 G* sqrt(R* delta),            gamma = 2 sqrt(5/6) beta sqrt(S m*).
   *
   * With this damping an impact returns exactly e, at any speed.
   * Sources: Tsuji, Tanaka, Ishida (1992), doi:10.1016/0032-5910(92)88030-L;
   * beta(e) for it: Antypov, Elliott (2011), doi:10.1209/0295-5075/94/50004.
   */
  struct HertzMindlin
  {
    /** Overlap below which a contact ends [m]. */
    template <class Real>
    static Real
    release_overlap(const PairMaterial &, const Real &)
    {
      return 0.;
    }

    template <class Real>
    [[gnu::always_inline]] static Stiffness<Real>
    stiffness(const PairMaterial &pair, const Contact<Real> &contact)
    {
      using std::sqrt;
      const Real a   = sqrt(contact.radius * contact.overlap);
      const Real S_n = 2. * pair.young * a;
      const Real S_t = 8. * pair.shear * a;
      const Real gamma =
        2. * std::sqrt(5. / 6.) * pair.damping * sqrt(S_n * contact.mass);
      return {4. / 3. * pair.young * a * contact.overlap,
              gamma,
              S_t,
              gamma * pair.mindlin_damping_ratio,
              0.};
    }
  };

  /**
   * Linear spring and dashpot: F_n = k_n delta, k_t = ratio k_n,
   * gamma = 2 beta sqrt(k m*). An impact returns exactly e.
   * Source: Cundall, Strack (1979), doi:10.1680/geot.1979.29.1.47.
   */
  struct LinearSpring
  {
    template <class Real>
    static Real
    release_overlap(const PairMaterial &, const Real &)
    {
      return 0.;
    }

    template <class Real>
    [[gnu::always_inline]] static Stiffness<Real>
    stiffness(const PairMaterial &pair, const Contact<Real> &contact)
    {
      using std::sqrt;
      const double k_n   = pair.normal_stiffness;
      const double k_t   = pair.stiffness_ratio * k_n;
      const Real   gamma = 2. * pair.damping * sqrt(k_n * contact.mass);
      return {k_n * contact.overlap, gamma, k_t, gamma * pair.linear_damping_ratio, 0.};
    }
  };

  /**
   * Adhesion of soft spheres after Johnson, Kendall and Roberts: with the radius a
   * of the contact area and the work of adhesion w,
   *
   *   delta = a^2/R* - sqrt(2 pi w a / E*),
   *   F_n   = 4 E* a^3 / (3 R*) - sqrt(8 pi w E* a^3).
   *
   * A contact begins at delta = 0, with a force that attracts, and ends at
   * delta = -3 a_c^2 / R*, a_c^3 = pi w R*^2 / (8 E*), where no a is left. The
   * strongest pull is F_c = 3/2 pi w R*; friction resists up to mu (F_n + 2 F_c).
   * Damping and tangential stiffness are those of HertzMindlin with this a.
   * Without adhesion it is HertzMindlin.
   * Sources: Johnson, Kendall, Roberts (1971), doi:10.1098/rspa.1971.0141;
   * friction: Thornton, Yin (1991), doi:10.1016/0032-5910(91)80178-L.
   */
  struct Jkr
  {
    template <class Real>
    static Real
    release_overlap(const PairMaterial &pair, const Real &radius)
    {
      using std::cbrt;
      using std::sqrt;
      // 3 a_c^2 / R* in the only part that differs from pair to pair, R*^(1/3).
      const double w   = dealii::numbers::PI * pair.adhesion / (8. * pair.young);
      const double own = 3. * std::cbrt(w * w);
      return -own * cube_root(radius);
    }

    /** Radius of the contact area [m], for an overlap above release_overlap(). */
    template <class Real>
    static Real
    contact_radius(const PairMaterial &pair, const Contact<Real> &contact)
    {
      using std::max;
      using std::sqrt;
      // With s = sqrt(a): s^4/R - c s - delta = 0, convex, and Newton's method
      // falls to the root from above; this start is above for any overlap.
      const double c = std::sqrt(2. * dealii::numbers::PI * pair.adhesion / pair.young);
      const Real   b = cube_root(contact.radius * c);
      const Real   R = contact.radius;
      const Real   above = max(contact.overlap, Real(0.));
      Real         s     = sqrt(sqrt(R * above) + b * b);
      for (unsigned int k = 0; k < n_newton_steps; ++k)
        {
          const Real cube  = s * s * s / R;
          const Real slope = 4. * cube - c;
          const Real move  = (s * cube - c * s - contact.overlap) / slope;
          s -= select(slope > Real(0.), move, Real(0.));
        }
      return s * s;
    }

    template <class Real>
    [[gnu::always_inline]] static Stiffness<Real>
    stiffness(const PairMaterial &pair, const Contact<Real> &contact)
    {
      using std::sqrt;
      const Real   a = contact_radius(pair, contact);
      const double pull =
        std::sqrt(8. * dealii::numbers::PI * pair.adhesion * pair.young);
      const Real S_n = 2. * pair.young * a;
      const Real gamma =
        2. * std::sqrt(5. / 6.) * pair.damping * sqrt(S_n * contact.mass);
      return {a * (4. / 3. * pair.young * a * a / contact.radius - pull * sqrt(a)),
              gamma,
              8. * pair.shear * a,
              gamma * pair.mindlin_damping_ratio,
              3. * dealii::numbers::PI * pair.adhesion * contact.radius};
    }

  private:
    // From the start above, the error of the root is at rounding after these; but
    // where the contact ends the root is double, and its error 2^-12 of the start.
    static constexpr unsigned int n_newton_steps = 12;

    static double
    cube_root(const double x)
    {
      return std::cbrt(x);
    }

    static Lanes
    cube_root(const Lanes &x)
    {
      return Lanes([&](auto lane) { return std::cbrt(x[lane]); });
    }
  };

  /** Turns a spring into the plane normal to @p n and keeps its length. */
  template <class Real>
  [[gnu::always_inline]] inline void
  turn_into_plane(Triple<Real> &spring, const Triple<Real> &n)
  {
    using std::sqrt;
    const Real out = spring * n;
    spring -= out * n;
    const Real left = spring.norm_square();

    // sqrt(1 + q) by its series where that is exact to rounding: the plane
    // turns little in a substep, and the loop over contacts is short of roots.
    const Real q      = select(left > Real(0.), out * out / left, Real(0.));
    Real       length = 1. + q * (0.5 - 0.125 * q);
    if (some(q >= Real(1e-5)))
      length = select(q >= Real(1e-5), sqrt(1. + q), length);
    spring *= length;
  }

  /** The part of a vector in the plane normal to @p n. */
  template <class Real>
  [[gnu::always_inline]] inline Triple<Real>
  in_plane(const Triple<Real> &vector, const Triple<Real> &n)
  {
    return vector - (vector * n) * n;
  }

  /** No resistance to rolling. */
  struct FreeRolling
  {
    template <class Real>
    [[gnu::always_inline]] static Triple<Real>
    torque(const PairMaterial &,
           const Contact<Real> &,
           const Real &,
           const Real &,
           Springs<Real> &)
    {
      return {};
    }
  };

  /**
   * Constant torque against the rolling, M = -mu_r R* F_n w/|w|, w being the
   * relative angular velocity without the twist about the normal.
   * Source: Ai, Chen, Rotter, Ooi (2011), doi:10.1016/j.powtec.2010.09.030,
   * model A.
   *
   * Below w_c = 2 mu_r R* F_n dt / (2/5 m* R*^2) the torque falls linearly with
   * w. Without that a resting sphere would be thrown to and fro by a torque
   * that turns it past rest within one substep; with it, its rotation decays.
   * The price is that a sphere on a slope creeps at up to w_c.
   */
  struct ConstantRollingTorque
  {
    template <class Real>
    [[gnu::always_inline]] static Triple<Real>
    torque(const PairMaterial  &pair,
           const Contact<Real> &contact,
           const Real          &normal_force,
           const Real &,
           Springs<Real> &)
    {
      using std::max;
      const Real limit   = pair.rolling_resistance * contact.radius * normal_force;
      const auto w       = in_plane(contact.spin_drift, contact.normal);
      const Real inertia = 0.4 * contact.mass * contact.radius * contact.radius;
      const Real w_c     = 2. * limit * contact.step / inertia;
      const Real size    = max(w.norm(), w_c);
      return select(size > Real(0.), -limit / size, Real(0.)) * w;
    }
  };

  /**
   * Elastic-plastic spring without viscous part (EPSD2): a rolling spring of
   * stiffness k_r = k_t R*^2 whose torque is limited to mu_r R* F_n.
   * Sources: Iwashita, Oda (1998), doi:10.1061/(ASCE)0733-9399(1998)124:3(285);
   * Ai, Chen, Rotter, Ooi (2011), doi:10.1016/j.powtec.2010.09.030.
   */
  struct SpringRolling
  {
    template <class Real>
    [[gnu::always_inline]] static Triple<Real>
    torque(const PairMaterial  &pair,
           const Contact<Real> &contact,
           const Real          &normal_force,
           const Real          &tangential_stiffness,
           Springs<Real>       &springs)
    {
      using std::sqrt;
      const Real limit = pair.rolling_resistance * contact.radius * normal_force;
      const Real k_r   = tangential_stiffness * contact.radius * contact.radius;
      turn_into_plane(springs.rolling, contact.normal);
      springs.rolling += contact.step * in_plane(contact.spin_drift, contact.normal);

      const Real trial_square = k_r * k_r * springs.rolling.norm_square();
      const auto yielding     = trial_square > limit * limit;
      if (some(yielding))
        springs.rolling *= select(yielding, limit / sqrt(trial_square), Real(1.));
      return -k_r * springs.rolling;
    }
  };

  /**
   * The whole contact: normal force, tangential spring with history, Coulomb's
   * limit, rolling resistance. Moves @p springs through the substep.
   *
   * The normal force is not clipped where damping makes it attractive at the
   * end of an impact: clipping there would return more than e. Coulomb's limit
   * and the rolling limit are zero then. In sliding the spring is set to what
   * it alone must be for the Coulomb force, so history goes on through sliding.
   */
  template <class NormalLaw, class RollingLaw, class Real>
  [[gnu::always_inline]] inline ContactAction<Real>
  contact_action(const PairMaterial  &pair,
                 const Contact<Real> &contact,
                 Springs<Real>       &springs)
  {
    using std::max;
    using std::sqrt;
    const Stiffness<Real> stiffness = NormalLaw::stiffness(pair, contact);
    const auto           &n         = contact.normal;

    const Real approach = contact.velocity * n;
    const Real F_n      = stiffness.normal_force + stiffness.normal_damping * approach;
    const Real pressing = max(F_n + stiffness.holding_force, Real(0.));

    turn_into_plane(springs.tangential, n);
    springs.tangential += contact.step * in_plane(contact.drift, n);

    Triple<Real> F_t = -stiffness.tangential * springs.tangential -
                       stiffness.tangential_damping * (contact.velocity - approach * n);
    const Real limit        = pair.friction * pressing;
    const Real trial_square = F_t.norm_square();
    const auto sliding      = trial_square > limit * limit;
    if (some(sliding))
      {
        F_t *= select(sliding, limit / sqrt(trial_square), Real(1.));
        const Real          compliance = -1. / stiffness.tangential;
        const Triple<Real> &spring     = springs.tangential;
        springs.tangential             = {select(sliding, compliance * F_t.x, spring.x),
                                          select(sliding, compliance * F_t.y, spring.y),
                                          select(sliding, compliance * F_t.z, spring.z)};
      }

    return {F_t - F_n * n,
            RollingLaw::torque(pair, contact, pressing, stiffness.tangential, springs)};
  }

  /** The choice of laws, dispatched once a sweep over all contacts. */
  using NormalLaws  = std::variant<HertzMindlin, LinearSpring, Jkr>;
  using RollingLaws = std::variant<FreeRolling, ConstantRollingTorque, SpringRolling>;

  /**
   * Rayleigh time pi R sqrt(rho/G) / (0.1631 nu + 0.8766), the time that a
   * surface wave needs around a sphere [s].
   * Source: Li, Xu, Thornton (2005), doi:10.1016/j.powtec.2005.09.002.
   */
  double rayleigh_time(const double      radius,
                       const double      density,
                       const Elasticity &elasticity);

  /** Overlap at which Hertz's law carries @p force: (3 F / (4 E* sqrt(R*)))^(2/3) [m]. */
  double hertz_overlap(const double force, const double young, const double radius);
} // namespace graupel

#endif
