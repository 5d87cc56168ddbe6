// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_closures_bed_correlations_h
#define graupel_closures_bed_correlations_h

#include <graupel/closures/fluid_properties.h>

#include <vector>

namespace graupel
{
  /**
   * Pressure gradient G [Pa/m] (positive: the loss along the flow) of a bed of
   * spheres of diameter @p diameter [m] with void fraction @p alpha [-] at the
   * superficial velocity V >= 0 [m/s]:
   *
   *   G = a V + b V^2,  a = 150 (1 - alpha)^2 mu / (alpha^3 d^2),
   *                     b = 1.75 (1 - alpha) rho / (alpha^3 d).
   *
   * Source: Ergun, Chem. Eng. Prog. 48 (1952) 89; Ricklick & Baran (2014),
   * eqs. 6 and 7.
   */
  double ergun_pressure_gradient(const FluidProperties &fluid,
                                 const double           diameter,
                                 const double           alpha,
                                 const double           superficial_velocity);

  /** The gradient above times the @p length [m] of the bed [Pa]. */
  double ergun_pressure_drop(const FluidProperties &fluid,
                             const double           diameter,
                             const double           alpha,
                             const double           superficial_velocity,
                             const double           length);

  /**
   * Superficial velocity [m/s] at which the gradient above is @p gradient
   * >= 0 [Pa/m]: the positive root, V = 2 G / (a + sqrt(a^2 + 4 b G)).
   */
  double ergun_superficial_velocity(const FluidProperties &fluid,
                                    const double           diameter,
                                    const double           alpha,
                                    const double           gradient);

  /**
   * Superficial velocity [m/s] at the onset of fluidisation, where Ergun's
   * gradient carries the weight less the buoyancy of the spheres,
   * G = (1 - alpha) (rho_p - rho) g. Densities in [kg/m^3], @p gravity in
   * [m/s^2]; 0 for spheres that float.
   */
  double ergun_onset_velocity(const FluidProperties &fluid,
                              const double           diameter,
                              const double           alpha,
                              const double           particle_density,
                              const double           gravity = 9.81);

  /** Flow area [m^2] and void fraction [-] of one of several channels side by side. */
  struct Channel
  {
    double area;
    double alpha;
  };

  /**
   * The pressure gradient G [Pa/m] that channels of different void fraction
   * share at the mean superficial velocity V [m/s]: sum A_i V_i(G) = V sum A_i,
   * each V_i by Ergun. With annuli that get looser towards the wall it tells
   * how much of a bed's deviation from Ergun is channelling. To about 14
   * digits; between the gradients of the loosest and of the densest channel.
   * Throws std::invalid_argument without channels, and for a
   * channel without area or with a void fraction outside (0, 1].
   */
  double parallel_channels_pressure_gradient(const FluidProperties      &fluid,
                                             const double                diameter,
                                             const std::vector<Channel> &channels,
                                             const double superficial_velocity);

  /**
   * Void fraction [-] of a random bed of equal spheres at the distance
   * @p z = y / d from the wall of its vessel, over their diameter:
   *
   *   2.14 z^2 - 2.53 z + 1                                         z <= 0.637,
   *   eps_b + 0.29 e^{-0.6 z} cos(2.3 pi (z - 0.16)) + 0.15 e^{-0.9 z}  beyond,
   *
   * with the void fraction @p bulk far from walls. The branches meet where
   * bulk is about 0.36; else there is a jump. The coefficients are still to be
   * compared with the printed paper.
   * Source: de Klerk, AIChE J. 49 (2003) 2022, doi:10.1002/aic.690490812.
   */
  double de_klerk_void_fraction(const double z, const double bulk);

  /**
   * Vertical stress [Pa] in a bed at @p depth [m] below its top in a cylinder of
   * diameter D = @p diameter [m], which the wall helps to carry:
   *
   *   w D / (4 mu K) (1 - exp(-4 mu K depth / D)),
   *
   * with the weight of the bed per volume w = @p specific_weight [N/m^3], and
   * the friction of the wall times the ratio of the stresses across and along
   * the axis mu K = @p wall_friction [-]; w depth if that is 0.
   * Source: Janssen, Z. Ver. Dtsch. Ing. 39 (1895) 1045.
   */
  double janssen_stress(const double specific_weight,
                        const double diameter,
                        const double wall_friction,
                        const double depth);
} // namespace graupel

#endif
