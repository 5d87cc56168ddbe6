// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_closures_scaling_h
#define graupel_closures_scaling_h

#include <graupel/closures/drag_laws.h>
#include <graupel/closures/fluid_properties.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace graupel
{
  // A simulated sphere of diameter d_s = s d stands for s^3 original spheres of
  // diameter d. Every form below gives the drag number N_in = C_in Re_s [-] with
  // which the simulated sphere feels beta_p = pi/8 mu d_s N_in, from a law, the
  // void fraction [-], the simulated sphere's Re_s = rho |u - v| d_s / mu [-],
  // and s >= 1 [-]. None looks at anything else.

  /**
   * The drag of the s^3 original spheres, C_in = s C(Re_s / s), so that
   * beta_p = s^3 beta_p(d) at the same slip and void fraction. Holds for every
   * law; a law that switches does so at the original Reynolds number.
   */
  double exact_drag_number(const DragLaw &law,
                           const double   alpha,
                           const double   reynolds,
                           const double   scale);

  /**
   * The closure as printed, C_in = s (s C(Re_s) - 1.75), limited to positive
   * values. It exceeds the exact one for Ergun's law by s (7/3 (s - 1) - 1.75),
   * and is not the identity at s = 1; kept to reproduce the paper.
   * Source: Ricklick & Baran (2014), eqs. 12 to 15.
   */
  double ricklick_baran_drag_number(const DragLaw &law,
                                    const double   alpha,
                                    const double   reynolds,
                                    const double   scale);

  /**
   * A formula of the user's for C_in, in muParser's syntax, of the variables
   *   Cd     the law's C_d at the simulated sphere's Reynolds number [-]
   *   Re     that Reynolds number, Re_s [-]
   *   alpha  void fraction [-]
   *   s      scale [-]
   *   d      diameter of the original spheres [m]
   * Cd is infinite at rest, so a Reynolds number below 1e-6 counts as 1e-6; in
   * air that is a slip of 1e-8 m/s past a sphere of 1.6 mm.
   *
   * Copies share one compiled formula: not for two threads at once.
   */
  class ScalingExpression
  {
  public:
    /** Throws InputError("Coupling/scaling expression", ...) if it does not parse. */
    ScalingExpression(const std::string &formula,
                      const double       scale,
                      const double       diameter);

    /**
     * N_in [-]. Throws std::runtime_error with Re and alpha if the formula
     * gives a negative value, or none.
     */
    double drag_number(const DragLaw &law,
                       const double   alpha,
                       const double   reynolds) const;

  private:
    struct Compiled;

    std::shared_ptr<Compiled> compiled;
  };

  /** The choice of drag law and of the form of scaling. */
  struct DragParameters
  {
    /** A name of drag_laws(). */
    std::string law = "gidaspow";
    /** "exact", "ricklick-baran", "expression" or "none". */
    std::string scaling = "exact";
    /** The formula of "expression"; the default is "exact" for Ergun's law. */
    std::string expression = "s*(s*Cd - 7/3*(s-1))";

    /** Declares its entries in the section "Coupling". */
    void declare(dealii::ParameterHandler &prm);

    /**
     * Throws InputError if the expression in use does not parse, or gives a
     * negative value or none in a packed bed, at void fractions from 0.3 to
     * 0.7 and Reynolds numbers from 0 to 1000, for this @p scale [-] and original @p
     * diameter [m].
     */
    void check(const double scale, const double diameter) const;
  };

  /**
   * The drag on the simulated spheres of a bed: law, scaling, fluid and
   * diameters together. Const, and cheap enough for every sphere in every step.
   */
  class Drag
  {
  public:
    /** @p diameter of the original spheres [m], @p scale at least 1 [-]. */
    Drag(const DragParameters  &parameters,
         const FluidProperties &fluid,
         const double           diameter,
         const double           scale);

    /**
     * beta_p [kg/s] of one simulated sphere in F = beta_p (u - v), at the void
     * fraction @p alpha [-] and the interstitial slip |u - v| [m/s]. Finite at
     * rest. @p size: the diameter of this sphere over that of the constructor [-].
     * Throws std::runtime_error for a void fraction outside (0, 1] by
     * more than a filter's overshoot of 0.01, and for a drag that is negative
     * or not a number.
     */
    double beta(const double alpha, const double slip, const double size = 1.) const;

    /** Re_s = rho |u - v| d_s / mu [-] of the simulated sphere. */
    double reynolds(const double slip) const;

    const DragLaw &law() const;

    const FluidProperties &
    fluid() const
    {
      return around;
    }

  private:
    enum class Form
    {
      exact,
      ricklick_baran,
      expression,
      none
    };

    double drag_number(const double alpha, const double reynolds) const;

    const DragLaw                           *drag_law;
    FluidProperties                          around;
    Form                                     form;
    double                                   scale;
    double                                   reynolds_per_slip;
    double                                   beta_per_drag_number;
    std::shared_ptr<const ScalingExpression> expression;
  };
} // namespace graupel

#endif
