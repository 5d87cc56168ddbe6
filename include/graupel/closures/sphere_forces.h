// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_closures_sphere_forces_h
#define graupel_closures_sphere_forces_h

#include <graupel/closures/fluid_properties.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace graupel
{
  // Forces and torques of a fluid on a sphere of diameter d and volume V beside drag and
  // pressure. With the interstitial velocity u and the vorticity w of the fluid, the
  // sphere's velocity v and spin s, and its spin in the fluid's frame W = w/2 - s,
  //
  //   Re = rho |u - v| d / mu,   Re_w = rho d^2 |w| / mu,   Re_W = rho d^2 |W| / mu,
  //
  //   virtual mass      F = C rho V (Du/Dt - dv/dt)
  //   shear lift        F = L d^2 (rho mu / |w|)^1/2 (u - v) x w
  //   spin lift         F = K pi/8 rho d^3 W x (u - v)
  //   rotational drag   T = R pi mu d^3 W
  //
  // The laws give the numbers C, L, K and R [-]. All hold for 0 < alpha <= 1 and
  // Reynolds numbers >= 0, and do not check it.

  /** C = 1/2 of one sphere in an unbounded fluid. Source: Lamb, Hydrodynamics (1932),
   * art. 92. */
  double constant_virtual_mass(const double alpha);

  /**
   * C = 1/2 (1 + 2 phi) / (1 - phi), phi = 1 - alpha: potential flow between the sphere
   * and a concentric one, at rest, that holds phi of solid (Lamb, art. 93).
   * Source: Zuber (1964), doi:10.1016/0009-2509(64)85067-3.
   */
  double zuber_virtual_mass(const double alpha);

  /**
   * L = 1.615, which is 6.46 / 4 in terms of the radius. For Re << Re_w^1/2 << 1.
   * Source: Saffman (1965), doi:10.1017/S0022112065000824, with the number of the
   * corrigendum, J. Fluid Mech. 31 (1968) 624.
   */
  double saffman_lift(const double reynolds, const double shear_reynolds);

  /**
   * Saffman's times, with b = Re_w / (2 Re),
   *
   *   exp(-Re/10) + 0.3314 b^1/2 (1 - exp(-Re/10)) up to Re = 40, else
   *   0.0524 (b Re)^1/2.
   *
   * A fit for 0.1 <= Re <= 100 and 0.005 < b < 0.4; it jumps by 0.02 at 40.
   * Source: Mei (1992), doi:10.1016/0301-9322(92)90012-6.
   */
  double saffman_mei_lift(const double reynolds, const double shear_reynolds);

  /** K = 1, for Re and Re_W << 1.
   * Source: Rubinow & Keller (1961), doi:10.1017/S0022112061000640. */
  double rubinow_keller_lift(const double reynolds);

  /**
   * K = 1 up to Re = 1, 0.178 + 0.822 Re^-0.522 beyond, to Re = 1000.
   * Source: Lun & Liu, Int. J. Multiphase Flow 23 (1997) 575.
   */
  double lun_liu_lift(const double reynolds);

  /** R = 1, which is T = 8 pi mu (d/2)^3 W, for Re_W << 1.
   * Source: Rubinow & Keller (1961), doi:10.1017/S0022112061000640. */
  double rubinow_keller_torque(const double spin_reynolds);

  /**
   * R = 1 up to Re_W = 32, (12.9 Re_W^1/2 + 128.4) / (64 pi) beyond, to Re_W = 1000:
   * T = C rho/2 (d/2)^5 |W| W with C = 64 pi / Re_W, else 12.9 / Re_W^1/2 + 128.4 / Re_W.
   * Source: Dennis, Singh & Ingham (1980), doi:10.1017/S0022112080001656.
   */
  double dennis_torque(const double spin_reynolds);

  /** What the program knows of a law. */
  template <typename Function>
  struct ForceLaw
  {
    /** As in a parameter file. */
    std::string name;
    Function   *number;
    /** The formula, in a line for the reader. */
    std::string form;
    /** Who found it. */
    std::string source;
  };
  using VirtualMassLaw    = ForceLaw<double(double)>;
  using ShearLiftLaw      = ForceLaw<double(double, double)>;
  using SpinLiftLaw       = ForceLaw<double(double)>;
  using RotationalDragLaw = ForceLaw<double(double)>;

  /** All laws. A new law adds one line there. */
  const std::vector<VirtualMassLaw>    &virtual_mass_laws();
  const std::vector<ShearLiftLaw>      &shear_lift_laws();
  const std::vector<SpinLiftLaw>       &spin_lift_laws();
  const std::vector<RotationalDragLaw> &rotational_drag_laws();

  /** Which forces there are beside drag, pressure and buoyancy. */
  struct ForceParameters
  {
    /** Names of the laws, or "none". */
    std::string virtual_mass = "none", shear_lift = "none", spin_lift = "none",
                rotational_drag = "none";
    /** Whether the solids carry their share of the viscous stress. */
    bool viscous_stress = false;

    /** Declares the section "Forces". */
    void declare(dealii::ParameterHandler &prm);

    /** Throws InputError where a law does not hold for spheres of this @p scale [-], or
     * in
     * @p model "A" or "B" (CouplingParameters::model). */
    void check(const double scale, const std::string &model) const;

    /** Whether any of them is wanted. */
    bool any() const;
  };

  /** The forces on the simulated spheres of a bed: laws and fluid together. Const, and
   * cheap enough for every sphere in every step. A force that is not wanted is 0. */
  class SphereForces
  {
  public:
    SphereForces(const ForceParameters &parameters, const FluidProperties &fluid);

    /** C rho V [kg] at the void fraction @p alpha [-], @p volume [m^3]. */
    double virtual_mass(const double alpha, const double volume) const;

    /**
     * Both lifts [N] on a sphere of @p diameter [m] that stands for s^3 spheres of
     * diameter/s, s = @p scale [-], with the same slip u - v [m/s] and vorticity [1/s]:
     * s^3 times the force on one of them. @p relative_spin W [rad/s].
     */
    dealii::Tensor<1, 3> lift(const double                diameter,
                              const double                scale,
                              const dealii::Tensor<1, 3> &slip,
                              const dealii::Tensor<1, 3> &vorticity,
                              const dealii::Tensor<1, 3> &relative_spin) const;

    /**
     * The mean torque of the rotational drag over @p step [s] on a free sphere of @p
     * diameter [m] and moment of inertia I = @p inertia [kg m^2],
     *
     *   T = I (1 - exp(-step / t)) / step W,   t = I / (R pi mu d^3),
     *
     * [N m]: with it the sphere ends the step as with the law, R being that of the
     * beginning, however long the step is.
     */
    dealii::Tensor<1, 3> torque(const double                diameter,
                                const double                inertia,
                                const double                step,
                                const dealii::Tensor<1, 3> &relative_spin) const;

  private:
    FluidProperties          fluid;
    const VirtualMassLaw    *virtual_mass_law;
    const ShearLiftLaw      *shear_lift_law;
    const SpinLiftLaw       *spin_lift_law;
    const RotationalDragLaw *rotational_drag_law;
  };
} // namespace graupel

#endif
