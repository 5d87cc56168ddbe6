#ifndef graupel_dem_contact_laws_h
#define graupel_dem_contact_laws_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <variant>

/**
 * Laws of contact as functions of numbers: no mesh, no lists, two bodies.
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

    PairMaterial(const Elasticity &first,
                 const Elasticity &second,
                 const Surface    &surface,
                 const double      normal_stiffness,
                 const double      stiffness_ratio);
  };

  /** Geometry and motion of two touching bodies. */
  struct Contact
  {
    /** Unit normal from the first body to the second. */
    dealii::Tensor<1, 3> normal;
    /** Overlap delta > 0 [m]. */
    double overlap;
    /** R* = R_1 R_2 / (R_1 + R_2); for a wall the radius of the sphere [m]. */
    double radius;
    /** m* = m_1 m_2 / (m_1 + m_2); for a wall the mass of the sphere [kg]. */
    double mass;
    /** Relative velocity of the surfaces at the contact point [m/s]. */
    dealii::Tensor<1, 3> velocity;
    /** The same, but the mean over the substep that led here [m/s]. */
    dealii::Tensor<1, 3> drift;
    /** Relative angular velocity, mean over the substep that led here [rad/s]. */
    dealii::Tensor<1, 3> spin_drift;
    /** Length of that substep, or of its part in contact [s]. */
    double step;
  };

  /** The memory of a contact: what it carries from substep to substep. */
  struct Springs
  {
    /** Tangential displacement [m]. */
    dealii::Tensor<1, 3> tangential;
    /** Rolling angle [rad]. */
    dealii::Tensor<1, 3> rolling;
  };

  /** What a contact does to the first body. */
  struct ContactAction
  {
    /** Force [N]. */
    dealii::Tensor<1, 3> force;
    /** Torque of the rolling resistance, without that of the force [N m]. */
    dealii::Tensor<1, 3> rolling_torque;
  };

  /** Stiffness and damping of a contact at its present overlap. */
  struct Stiffness
  {
    /** Elastic normal force [N]. */
    double normal_force;
    /** Normal damping [N s/m]. */
    double normal_damping;
    /** Tangential stiffness [N/m]. */
    double tangential;
    /** Tangential damping [N s/m]. */
    double tangential_damping;
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
    static Stiffness
    stiffness(const PairMaterial &pair, const Contact &contact)
    {
      const double a   = std::sqrt(contact.radius * contact.overlap);
      const double S_n = 2. * pair.young * a;
      const double S_t = 8. * pair.shear * a;
      const double gamma =
        2. * std::sqrt(5. / 6.) * pair.damping * std::sqrt(S_n * contact.mass);
      return {4. / 3. * pair.young * a * contact.overlap,
              gamma,
              S_t,
              gamma * pair.mindlin_damping_ratio};
    }
  };

  /**
   * Linear spring and dashpot: F_n = k_n delta, k_t = ratio k_n,
   * gamma = 2 beta sqrt(k m*). An impact returns exactly e.
   * Source: Cundall, Strack (1979), doi:10.1680/geot.1979.29.1.47.
   */
  struct LinearSpring
  {
    static Stiffness
    stiffness(const PairMaterial &pair, const Contact &contact)
    {
      const double k_n   = pair.normal_stiffness;
      const double k_t   = pair.stiffness_ratio * k_n;
      const double gamma = 2. * pair.damping * std::sqrt(k_n * contact.mass);
      return {k_n * contact.overlap, gamma, k_t, gamma * pair.linear_damping_ratio};
    }
  };

  /** Turns a spring into the plane normal to @p n and keeps its length. */
  inline void
  turn_into_plane(dealii::Tensor<1, 3> &spring, const dealii::Tensor<1, 3> &n)
  {
    const double out = spring * n;
    if (out == 0.)
      return;
    spring -= out * n;
    const double left = spring.norm_square();
    if (!(left > 0.))
      return;

    // sqrt(1 + q) by its series where that is exact to rounding: the plane
    // turns little in a substep, and the loop over contacts is short of roots.
    const double q = out * out / left;
    spring *= q < 1e-5 ? 1. + q * (0.5 - 0.125 * q) : std::sqrt(1. + q);
  }

  /** The part of a vector in the plane normal to @p n. */
  inline dealii::Tensor<1, 3>
  in_plane(const dealii::Tensor<1, 3> &vector, const dealii::Tensor<1, 3> &n)
  {
    return vector - (vector * n) * n;
  }

  /** No resistance to rolling. */
  struct FreeRolling
  {
    static dealii::Tensor<1, 3>
    torque(const PairMaterial &, const Contact &, const double, const double, Springs &)
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
    static dealii::Tensor<1, 3>
    torque(const PairMaterial &pair,
           const Contact      &contact,
           const double        normal_force,
           const double,
           Springs &)
    {
      const double limit = pair.rolling_resistance * contact.radius * normal_force;
      if (!(limit > 0.))
        return {};
      const auto   w       = in_plane(contact.spin_drift, contact.normal);
      const double inertia = 0.4 * contact.mass * contact.radius * contact.radius;
      const double w_c     = 2. * limit * contact.step / inertia;
      return (-limit / std::max(w.norm(), w_c)) * w;
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
    static dealii::Tensor<1, 3>
    torque(const PairMaterial &pair,
           const Contact      &contact,
           const double        normal_force,
           const double        tangential_stiffness,
           Springs            &springs)
    {
      const double limit = pair.rolling_resistance * contact.radius * normal_force;
      if (!(limit > 0.))
        {
          springs.rolling = dealii::Tensor<1, 3>();
          return {};
        }
      const double k_r = tangential_stiffness * contact.radius * contact.radius;
      turn_into_plane(springs.rolling, contact.normal);
      springs.rolling += contact.step * in_plane(contact.spin_drift, contact.normal);

      const double trial_square = k_r * k_r * springs.rolling.norm_square();
      if (trial_square > limit * limit)
        springs.rolling *= limit / std::sqrt(trial_square);
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
  template <class NormalLaw, class RollingLaw>
  [[gnu::always_inline]] inline ContactAction
  contact_action(const PairMaterial &pair, const Contact &contact, Springs &springs)
  {
    const Stiffness stiffness = NormalLaw::stiffness(pair, contact);
    const auto     &n         = contact.normal;

    const double approach = contact.velocity * n;
    const double F_n      = stiffness.normal_force + stiffness.normal_damping * approach;
    const double pressing = std::max(F_n, 0.);

    turn_into_plane(springs.tangential, n);
    springs.tangential += contact.step * in_plane(contact.drift, n);

    dealii::Tensor<1, 3> F_t =
      -stiffness.tangential * springs.tangential -
      stiffness.tangential_damping * (contact.velocity - approach * n);
    const double limit        = pair.friction * pressing;
    const double trial_square = F_t.norm_square();
    if (trial_square > limit * limit)
      {
        F_t *= limit / std::sqrt(trial_square);
        springs.tangential = (-1. / stiffness.tangential) * F_t;
      }

    return {F_t - F_n * n,
            RollingLaw::torque(pair, contact, pressing, stiffness.tangential, springs)};
  }

  /** The choice of laws, dispatched once a sweep over all contacts. */
  using NormalLaws  = std::variant<HertzMindlin, LinearSpring>;
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
